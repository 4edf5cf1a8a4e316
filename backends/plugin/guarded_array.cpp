#include "backends/plugin/guarded_array.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace rastercheck::backends {
namespace {

/// Fills the accessible memory before the beginning of an array.
constexpr std::byte kFront{0xa5};

std::size_t page_size() { return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)); }

/// The addresses of an array, for use in a signal handler.
struct Guarded {
  const char* name = nullptr;  ///< nullptr if the entry is unused
  std::uintptr_t pages = 0;    ///< start of the inaccessible page before the array
  std::uintptr_t begin = 0;
  std::uintptr_t end = 0;  ///< end of the array and also of accessible memory
};
/// The arrays of the current plugin. A plugin has eleven for draws, six for queries and ten for
/// pictures.
std::array<Guarded, 32> all_guarded;

/// Forgets the array with these pages. Arrays of several calls may have the same name.
void forget(std::uintptr_t pages) {
  for (Guarded& one : all_guarded) {
    if (one.pages == pages) one = {};
  }
}

void remember(const Guarded& array) {
  const auto place = std::find_if(all_guarded.begin(), all_guarded.end(),
                                  [](const Guarded& one) { return one.name == nullptr; });
  if (place != all_guarded.end()) *place = array;
}

/// A number of bytes, written as "1 byte" or "2 bytes".
struct Bytes {
  std::uintptr_t count = 0;
};

/// Composes a line of text without allocating memory.
class SignalLine {
 public:
  SignalLine& operator<<(std::string_view text) {
    const std::size_t count = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), count, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += count;
    return *this;
  }
  SignalLine& operator<<(std::uintptr_t number) { return append(number, 10); }
  SignalLine& append(std::uintptr_t number, int base) {
    std::array<char, 24> digits{};
    char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number, base).ptr;
    return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
  }
  void write() const {
    const ssize_t written = ::write(STDERR_FILENO, text_.data(), size_);
    static_cast<void>(written);  // Nothing can be done if this fails.
  }

 private:
  std::array<char, 256> text_{};
  std::size_t size_ = 0;
};

SignalLine& operator<<(SignalLine& line, Bytes bytes) {
  return line << bytes.count << (bytes.count == 1 ? " byte" : " bytes");
}

/// Describes an access to an address in an array or next to it.
void describe(SignalLine& line, const Guarded& array, std::uintptr_t address) {
  if (address < array.begin) {
    line << "the plugin touched " << array.name << " before its beginning, by "
         << Bytes{array.begin - address};
  } else if (address < array.end) {
    line << "the plugin wrote to " << array.name << ", which it may only read";
  } else {
    line << "the plugin touched " << array.name << " beyond its end, by "
         << Bytes{address - array.end + 1};
  }
}

/// Reports which array was accessed, then lets the signal have its usual effect.
void report(int signal, siginfo_t* info, void* /*context*/) {
  if (info->si_code <= 0) {  // a process sent the signal, so returning would not raise it again
    ::raise(signal);
    return;
  }
  SignalLine line;
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  const auto at =
      std::find_if(all_guarded.begin(), all_guarded.end(), [address](const Guarded& one) {
        return one.name != nullptr && one.pages <= address && address < one.end + page_size();
      });
  if (info->si_code == SI_KERNEL) {
    line << "the plugin touched an invalid address";
  } else if (at != all_guarded.end()) {
    describe(line, *at, address);
  } else {
    line << "the plugin touched address 0x";
    line.append(address, 16) << ", which is in none of its arrays";
  }
  (line << "\n").write();
}

}  // namespace

void report_wrong_accesses() {
  // The handler needs a stack of its own, since the current one may be exhausted.
  static std::array<std::byte, 65536> stack;
  stack_t alternative{};
  alternative.ss_sp = stack.data();
  alternative.ss_size = stack.size();
  ::sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_sigaction = &report;
  // Handles the signal only once: the access is then repeated and ends the process as if without a
  // handler.
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGSEGV, &action, nullptr);
  ::sigaction(SIGBUS, &action, nullptr);
}

GuardedArray::~GuardedArray() { release(); }

void GuardedArray::release() {
  if (pages_ != nullptr) {
    std::byte* const all = pages_ - page_size();
    forget(reinterpret_cast<std::uintptr_t>(all));
    ::munmap(all, touchable_ + 2 * page_size());
  }
  pages_ = nullptr;
  data_ = nullptr;
  size_ = 0;
}

Result<void> GuardedArray::protect(int access) const {
  if (::mprotect(pages_, touchable_, access) == 0) return {};
  return tl::unexpected(Error{"mprotect", "", std::strerror(errno)});
}

Result<void> GuardedArray::resize(std::size_t size) {
  if (size != size_) {
    release();
    const std::size_t page = page_size();
    touchable_ = (size + page - 1) / page * page;
    void* const all = size == 0 ? nullptr
                                : ::mmap(nullptr, touchable_ + 2 * page, PROT_NONE,
                                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (all == MAP_FAILED) return tl::unexpected(Error{"mmap", "", std::strerror(errno)});
    if (all == nullptr) return {};
    pages_ = static_cast<std::byte*>(all) + page;
    size_ = size;
    data_ = pages_ + (touchable_ - size);
    const auto begin = reinterpret_cast<std::uintptr_t>(data_);
    remember({name_, reinterpret_cast<std::uintptr_t>(all), begin, begin + size});
  }
  if (size == 0) return {};
  if (Result<void> open = protect(PROT_READ | PROT_WRITE); !open) return open;
  std::fill(pages_, data_, kFront);
  return {};
}

Result<void> GuardedArray::assign(std::span<const std::byte> bytes) {
  if (Result<void> sized = resize(bytes.size()); !sized || bytes.empty()) return sized;
  std::copy(bytes.begin(), bytes.end(), data_);
  return protect(PROT_READ);
}

bool GuardedArray::is_front_whole() const {
  return std::all_of(pages_, data_, [](std::byte b) { return b == kFront; });
}

}  // namespace rastercheck::backends
