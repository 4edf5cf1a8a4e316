#pragma once

// Messages between two processes: bytes in memory that both see, and a socket that rings. A message
// longer than the memory goes in parts, one after the other.
//
// Either end may be at the mercy of broken code: what the other one wrote is copied before it is
// looked at, and believed in nothing.

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
  /// New memory of `size` bytes, all 0, that has no name.
  static Result<SharedMemory> create(std::size_t size);
  /// That of another process; fails where it has fewer bytes.
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
  /// Bytes of the memory that a channel needs.
  static std::size_t memory_size();

  Channel(SharedMemory memory, cases::Descriptor bell)
      : memory_(std::move(memory)), bell_(std::move(bell)) {}

  /// Waits until bell() can be read from; false where that is not going to be.
  using Wait = std::function<bool()>;

  /// A socket.
  int bell() const { return bell_.number(); }
  /// Shared, for the other end.
  int memory() const { return memory_.file(); }

  /// Says that work goes on, without a message.
  void beat() const;
  /// How often either end has.
  std::uint64_t beats() const;

  /// False where the other end is gone, or `wait` says so.
  bool send(std::string_view message, const Wait& wait) const;
  /// The next message, of `most` bytes at most; nothing where there is none.
  std::optional<std::string> receive(std::uint64_t most, const Wait& wait) const;

 private:
  bool ring() const;
  bool hear(const Wait& wait) const;

  SharedMemory memory_;
  cases::Descriptor bell_;
};

}  // namespace rastercheck::backends
