#include "backends/internal/channel.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace rastercheck::backends {
namespace {

/// Precedes the bytes of each part.
struct PartHeader {
  std::uint64_t size = 0;  ///< bytes of this part
  std::uint64_t rest = 0;  ///< bytes of the message in later parts
};

/// Enough for most drawings, and little compared with the rest of a process's memory.
constexpr std::size_t kPartSize = std::size_t{4} << 20;

tl::unexpected<Error> channel_failure(const std::string& what) {
  return tl::unexpected(Error{what, "", std::strerror(errno)});
}

}  // namespace

Result<SharedMemory> SharedMemory::create(std::size_t size) {
  cases::Descriptor file(::memfd_create("rastercheck", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!file.is_open()) return channel_failure("memfd_create");
  if (::ftruncate(file.number(), static_cast<off_t>(size)) != 0)
    return channel_failure("ftruncate");
  // Without the seals, the other end could shrink the memory while this one reads it.
  if (::fcntl(file.number(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
    return channel_failure("fcntl");
  }
  return open(std::move(file), size);
}

Result<SharedMemory> SharedMemory::open(cases::Descriptor file, std::size_t size) {
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return channel_failure("fstat");
  if (status.st_size < static_cast<off_t>(size)) {
    return tl::unexpected(Error{"shared memory", "", "is not that of a channel"});
  }
  void* const data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file.number(), 0);
  if (data == MAP_FAILED) return channel_failure("mmap");
  return SharedMemory(std::move(file), static_cast<std::byte*>(data), size);
}

SharedMemory::SharedMemory(SharedMemory&& other) noexcept
    : file_(std::move(other.file_)),
      data_(std::exchange(other.data_, nullptr)),
      size_(other.size_) {}

SharedMemory::~SharedMemory() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

/// The counter of beats is stored after the part.
std::size_t Channel::memory_size() {
  return sizeof(PartHeader) + kPartSize + sizeof(std::uint64_t);
}

namespace {

std::atomic_ref<std::uint64_t> beats_of(const SharedMemory& memory) {
  std::byte* const at = memory.data() + sizeof(PartHeader) + kPartSize;
  return std::atomic_ref(*reinterpret_cast<std::uint64_t*>(at));
}

}  // namespace

void Channel::beat() const { ++beats_of(memory_); }
std::uint64_t Channel::beats() const { return beats_of(memory_); }

bool Channel::ring() const {
  const char stroke = 0;
  for (;;) {
    const ssize_t sent = ::send(bell_.number(), &stroke, 1, MSG_NOSIGNAL);
    if (sent == 1) return true;
    if (sent < 0 && errno != EINTR) return false;
  }
}

bool Channel::hear(const Wait& wait) const {
  if (wait && !wait()) return false;
  char stroke = 0;
  for (;;) {
    const ssize_t count = ::read(bell_.number(), &stroke, 1);
    if (count == 1) return true;
    if (count == 0 || errno != EINTR) return false;
  }
}

bool Channel::send(std::string_view message, const Wait& wait) const {
  for (;;) {
    const std::string_view part = message.substr(0, kPartSize);
    message.remove_prefix(part.size());
    const PartHeader header{part.size(), message.size()};
    std::memcpy(memory_.data(), &header, sizeof header);
    std::memcpy(memory_.data() + sizeof header, part.data(), part.size());
    if (!ring()) return false;
    if (message.empty()) return true;
    if (!hear(wait)) return false;  // waits until the other end has taken the part
  }
}

std::optional<std::string> Channel::receive(std::uint64_t most, const Wait& wait) const {
  std::string message;
  for (;;) {
    if (!hear(wait)) return std::nullopt;
    PartHeader header;
    std::memcpy(&header, memory_.data(), sizeof header);
    if (header.size > kPartSize || header.size > most - message.size()) return std::nullopt;
    const auto* const part = memory_.data() + sizeof header;
    message.append(reinterpret_cast<const char*>(part), header.size);
    if (header.rest == 0) return message;
    // Parts without bytes could make this loop run forever.
    if (header.size == 0 || !ring()) return std::nullopt;
  }
}

}  // namespace rastercheck::backends
