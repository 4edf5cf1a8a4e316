#pragma once

namespace rastercheck::cli {

/// Exit codes, stable for scripts (README, Commands). If several apply, the order of precedence is
/// 70, 2, 4, 1, 3, 5.
enum class ExitCode : int {
  ok = 0,
  violated = 1,
  usage = 2,  ///< wrong usage or unreadable input: one line gives file, place and reason
  regression = 3,
  backend_unavailable = 4,
  nothing_checked = 5,
  internal = 70,
  /// By a signal, with no violation so far, or with one that could not be written.
  interrupted = 130,
};

}  // namespace rastercheck::cli
