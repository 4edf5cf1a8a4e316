#include "cli/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace rastercheck::cli {
namespace {

// What a signal handler may touch: lock-free, and there before and after any watch.
std::atomic<bool> interrupted{false};
std::atomic<const std::string*> message_of_watch{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<const std::string*>::is_always_lock_free);

extern "C" void note_interrupt(int /*signal*/) {
  const std::string* message = message_of_watch;
  if (!interrupted.exchange(true) && message != nullptr) {
    const ssize_t ignored = ::write(STDERR_FILENO, message->data(), message->size());
    static_cast<void>(ignored);  // there is nobody to tell
  }
}

void set_handler(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  // The second of a kind has its usual effect; calls that were interrupted go on.
  action.sa_flags = SA_RESTART | (handler == SIG_DFL ? 0 : static_cast<int>(SA_RESETHAND));
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptWatch::InterruptWatch(const std::string& message) {
  interrupted = false;
  message_of_watch = new std::string(message);
  set_handler(SIGINT, &note_interrupt);
  set_handler(SIGTERM, &note_interrupt);
}

InterruptWatch::~InterruptWatch() {
  set_handler(SIGINT, SIG_DFL);
  set_handler(SIGTERM, SIG_DFL);
  delete message_of_watch.exchange(nullptr);
}

bool is_interrupted() { return interrupted; }

}  // namespace rastercheck::cli
