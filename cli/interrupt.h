#pragma once

#include <string>

namespace rastercheck::cli {

/// As long as it lives, the first SIGINT (Ctrl-C) or SIGTERM does not end the process: it prints
/// `message` on standard error, and is_interrupted() says so from then on. The second one ends the
/// process as if nobody watched. One at a time.
class InterruptWatch {
 public:
  explicit InterruptWatch(const std::string& message);
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  ~InterruptWatch();
};

/// Whether a signal has come since the last watch began. From any thread.
bool is_interrupted();

}  // namespace rastercheck::cli
