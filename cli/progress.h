#pragma once

#include <cstdint>
#include <mutex>

namespace rastercheck::cli {

/// A progress bar on standard error, if that is a terminal; otherwise nothing. Any thread may
/// report progress.
class ProgressBar {
 public:
  /// `quiet`: never shows a bar. A dumb terminal, or CI being set, has the same effect.
  explicit ProgressBar(bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// "[###...] 3 of 10 cases".
  void show(std::uint64_t done, std::uint64_t all, const char* what);
  /// Removes the bar from the screen. Must be called before anything else is printed; the
  /// destructor calls it as well.
  void erase();

 private:
  std::mutex mutex_;
  bool is_shown_;
  bool has_drawn_ = false;
};

}  // namespace rastercheck::cli
