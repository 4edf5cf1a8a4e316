#pragma once

#include <cstdint>
#include <mutex>

namespace rastercheck::cli {

/// A progress bar on standard error, where that is a terminal; otherwise nothing. The bar is gone
/// when the work is done. May be told of progress by any thread.
class ProgressBar {
 public:
  /// `quiet`: never a bar. Neither on a dumb terminal, nor where CI is set.
  explicit ProgressBar(bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// "[###...] 3 of 10 cases".
  void show(std::uint64_t done, std::uint64_t all, const char* what);

 private:
  std::mutex mutex_;
  bool is_shown_;
  bool has_drawn_ = false;
};

}  // namespace rastercheck::cli
