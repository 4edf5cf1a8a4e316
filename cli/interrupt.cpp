#include "cli/interrupt.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>

namespace rastercheck::cli {
namespace {

// What a signal handler may touch: lock-free, and there before and after any watch.
std::atomic<bool> interrupted{false};
std::atomic<const std::string*> message_of_watch{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<const std::string*>::is_always_lock_free);

/// A terminal that is gone takes nothing: what is printed there has nobody to read it, and is no
/// reason to end otherwise.
void forget_terminal() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct termios settings {};
    const bool is_terminal = ::tcgetattr(stream, &settings) == 0 || errno == EIO;
    if (is_terminal) ::dup2(nowhere, stream);
  }
  ::close(nowhere);
}

extern "C" void note_interrupt(int signal) {
  const int before = errno;
  if (signal == SIGHUP) forget_terminal();
  const std::string* message = message_of_watch;
  if (!interrupted.exchange(true) && message != nullptr) {
    const ssize_t ignored = ::write(STDERR_FILENO, message->data(), message->size());
    static_cast<void>(ignored);  // there is nobody to tell
  }
  errno = before;
}

/// Watches a signal; what it did before.
struct sigaction watch(int signal) {
  struct sigaction before {};
  ::sigaction(signal, nullptr, &before);
  if (signal == SIGHUP && before.sa_handler == SIG_IGN) return before;
  struct sigaction action {};
  action.sa_handler = &note_interrupt;
  // The second of a kind has its usual effect; calls that were interrupted go on.
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  ::sigaction(signal, &action, nullptr);
  return before;
}

}  // namespace

InterruptWatch::InterruptWatch(const std::string& message) {
  interrupted = false;
  message_of_watch = new std::string(message);
  std::transform(kSignals.begin(), kSignals.end(), before_.begin(), &watch);
}

InterruptWatch::~InterruptWatch() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &before_[i], nullptr);
  }
  delete message_of_watch.exchange(nullptr);
}

bool is_interrupted() { return interrupted; }

}  // namespace rastercheck::cli
