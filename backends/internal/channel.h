#pragma once

// Messages between two processes: bytes in memory that both map, and a socket to signal. A message
// longer than the memory is sent in parts, one after the other.
//
// Either end may run broken code. So each end copies what the other wrote before reading it, and
// trusts none of its content.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "cases/child_process.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// A mapping of shared memory.
class SharedMemory {
 public:
  /// Creates `size` bytes of new, nameless memory, all 0.
  static Result<SharedMemory> create(std::size_t size);
  /// Maps the memory of another process. Fails if that memory has fewer bytes.
  static Result<SharedMemory> open(cases::Descriptor file, std::size_t size);
  SharedMemory(SharedMemory&& other) noexcept;
  SharedMemory& operator=(SharedMemory&&) = delete;
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory();

  int file() const { return file_.number(); }
  std::byte* data() const { return data_; }

 private:
  SharedMemory(cases::Descriptor file, std::byte* data, std::size_t size)
      : file_(std::move(file)), data_(data), size_(size) {}

  cases::Descriptor file_;
  std::byte* data_;
  std::size_t size_;
};

class Channel {
 public:
  /// The number of bytes of memory that a channel needs.
  static std::size_t memory_size();

  Channel(SharedMemory memory, cases::Descriptor bell)
      : memory_(std::move(memory)), bell_(std::move(bell)) {}

  /// Waits until bell() can be read. Returns false if it never will be.
  using Wait = std::function<bool()>;

  /// The socket that carries signals.
  int bell() const { return bell_.number(); }
  /// The descriptor of the shared memory, to hand to the other end.
  int memory() const { return memory_.file(); }

  /// Signals, without a message, that work goes on.
  void beat() const;
  /// How many times either end has called beat().
  std::uint64_t beats() const;

  /// Sends a message. Returns false if the other end is gone or `wait` returns false.
  bool send(std::string_view message, const Wait& wait) const;
  /// Returns the next message, of at most `most` bytes; empty if none comes.
  std::optional<std::string> receive(std::uint64_t most, const Wait& wait) const;

 private:
  bool ring() const;
  bool hear(const Wait& wait) const;

  SharedMemory memory_;
  cases::Descriptor bell_;
};

}  // namespace rastercheck::backends
