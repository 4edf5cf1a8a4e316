#pragma once

#include <array>
#include <csignal>
#include <string>

namespace rastercheck::cli {

/// As long as it lives, the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (a terminal that is closed)
/// does not end the process: it prints `message` on standard error, and is_interrupted() says so
/// from then on. The second of a kind ends the process as if nobody watched. A SIGHUP that is
/// ignored, as nohup has it, stays ignored; after another, what is printed on a terminal goes
/// nowhere. One at a time.
///
/// With `grace`, in seconds: so long after the first signal the process is ended wherever it is,
/// with exit code 130 and `last_words`. All that matters has to be in files by then.
class InterruptWatch {
 public:
  explicit InterruptWatch(const std::string& message, unsigned grace = 0,
                          const std::string& last_words = "");
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  ~InterruptWatch();

  /// Takes the limit back: what is left is short, and better not cut.
  static void let_it_end();

 private:
  static constexpr std::array<int, 4> kSignals{SIGINT, SIGTERM, SIGHUP, SIGALRM};
  std::array<struct sigaction, kSignals.size()> before_{};  ///< what they did, in that order
};

/// Whether a signal has come since the last watch began. From any thread.
bool is_interrupted();

}  // namespace rastercheck::cli
