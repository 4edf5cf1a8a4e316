#pragma once

#include <array>
#include <csignal>
#include <string>

namespace rastercheck::cli {

/// While this object lives, the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (terminal closed) does not
/// end the process: it prints `message` on standard error, and is_interrupted() is true from then
/// on. A second signal of the same kind ends the process as usual. A SIGHUP that is ignored, as
/// under nohup, stays ignored; after any other SIGHUP, output to a terminal is discarded. Only one
/// watch may exist at a time.
///
/// With `grace`, the process ends that many seconds after the first signal, wherever it is, with
/// exit code 130 and `last_words`. Everything that matters must be in files by then.
class InterruptWatch {
 public:
  explicit InterruptWatch(const std::string& message, unsigned grace = 0,
                          const std::string& last_words = "");
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  ~InterruptWatch();

  /// Cancels the time limit, when the remaining work is short and must not be cut.
  static void let_it_end();

 private:
  static constexpr std::array<int, 4> kSignals{SIGINT, SIGTERM, SIGHUP, SIGALRM};
  std::array<struct sigaction, kSignals.size()>
      before_{};  ///< the previous actions, in the order of kSignals
};

/// True if a signal has come since the last watch began. May be called on any thread.
bool is_interrupted();

}  // namespace rastercheck::cli
