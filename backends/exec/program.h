#pragma once

// A program that answers draws on its standard input and output (docs/exec-protocol.md).

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/exec/messages.h"
#include "cases/child_process.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// Memory that this process and a program both map; it only grows.
class GrowingMemory {
 public:
  static Result<GrowingMemory> create();
  GrowingMemory(GrowingMemory&& other) noexcept;
  GrowingMemory& operator=(GrowingMemory&&) = delete;
  GrowingMemory(const GrowingMemory&) = delete;
  GrowingMemory& operator=(const GrowingMemory&) = delete;
  ~GrowingMemory();

  int file() const { return file_.number(); }
  std::uint64_t size() const { return size_; }
  std::byte* data() const { return data_; }
  /// Grows to at least `size` bytes.
  Result<void> grow(std::uint64_t size);

 private:
  explicit GrowingMemory(cases::Descriptor file) : file_(std::move(file)) {}

  cases::Descriptor file_;
  std::byte* data_ = nullptr;
  std::uint64_t size_ = 0;
};

/// A program that has said hello. Once a call fails, the program is of no more use: it has ended,
/// or must be ended, because nobody knows where its next answer begins. Waits for answers without a
/// time limit, because the process that waits for this one has a time limit and then kills the
/// whole process group.
class Program {
 public:
  /// Starts a command and exchanges hellos. Errors have no file; their failure is `crash`.
  static Result<Program> start(const std::vector<std::string>& command);

  const ProgramHello& hello() const { return hello_; }

  struct Answer {
    AnswerHeader header;
    /// Valid until the next call.
    std::string_view arrays;
  };
  /// Sends a draw of a case and returns the answer.
  Result<Answer> draw(DrawMessage message, const cases::Case& c);

 private:
  Program(cases::ChildProcess process, cases::Descriptor to, cases::Descriptor from,
          GrowingMemory memory)
      : process_(std::move(process)),
        to_(std::move(to)),
        from_(std::move(from)),
        memory_(std::move(memory)) {}

  Result<void> send(std::string_view bytes, std::string_view doing);
  Result<std::string> line(std::string_view doing);
  Result<std::string_view> arrays(std::uint64_t bytes);
  /// Reads at least one byte.
  Result<void> read_more(std::size_t most, std::string_view doing);
  Error loss(std::string_view doing);

  cases::ChildProcess process_;
  cases::Descriptor to_;
  cases::Descriptor from_;
  GrowingMemory memory_;
  ProgramHello hello_;
  std::string read_;  ///< bytes that were read; those up to used_ have been used
  std::size_t used_ = 0;
};

}  // namespace rastercheck::backends
