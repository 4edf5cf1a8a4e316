#include "cli/interrupt.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>

#include "cli/exit_code.h"

namespace rastercheck::cli {
namespace {

// State that a signal handler may use: lock-free, and alive before and after any watch.
std::atomic<bool> interrupted{false};
std::atomic<unsigned> grace_of_watch{0};
std::atomic<const std::string*> message_of_watch{nullptr};
std::atomic<const std::string*> last_words_of_watch{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<unsigned>::is_always_lock_free);
static_assert(std::atomic<const std::string*>::is_always_lock_free);

/// Redirects output to a closed terminal to /dev/null: nobody can read it, and failing to write it
/// must not change how the program ends.
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

void tell(const std::string* message) {
  if (message == nullptr) return;
  const ssize_t ignored = ::write(STDERR_FILENO, message->data(), message->size());
  static_cast<void>(ignored);  // a failure could not be reported either
}

extern "C" void note_interrupt(int signal) {
  const int before = errno;
  if (signal == SIGHUP) forget_terminal();
  if (!interrupted.exchange(true)) {
    tell(message_of_watch);
    ::alarm(grace_of_watch);  // 0: none
  }
  errno = before;
}

extern "C" void end_at_once(int /*signal*/) {
  tell(last_words_of_watch);
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

/// Installs the handler for a signal and returns the previous action.
struct sigaction watch(int signal) {
  struct sigaction before {};
  ::sigaction(signal, nullptr, &before);
  if (signal == SIGHUP && before.sa_handler == SIG_IGN) return before;
  struct sigaction action {};
  action.sa_handler = signal == SIGALRM ? &end_at_once : &note_interrupt;
  // The second signal of a kind has its usual effect; interrupted system calls restart.
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  ::sigaction(signal, &action, nullptr);
  return before;
}

}  // namespace

InterruptWatch::InterruptWatch(const std::string& message, unsigned grace,
                               const std::string& last_words) {
  interrupted = false;
  grace_of_watch = grace;
  message_of_watch = new std::string(message);
  last_words_of_watch = new std::string(last_words);
  std::transform(kSignals.begin(), kSignals.end(), before_.begin(), &watch);
}

InterruptWatch::~InterruptWatch() {
  // Restores the alarm's action last: a signal that comes meanwhile may set the alarm.
  for (std::size_t i = 0; i + 1 < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &before_[i], nullptr);
  }
  let_it_end();
  ::sigaction(kSignals.back(), &before_.back(), nullptr);
  delete message_of_watch.exchange(nullptr);
  delete last_words_of_watch.exchange(nullptr);
}

void InterruptWatch::let_it_end() { ::alarm(0); }

bool is_interrupted() { return interrupted; }

}  // namespace rastercheck::cli
