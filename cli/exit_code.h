#pragma once

namespace rastercheck::cli {

/// Exit codes, stable for scripts (docs/commands.md). If several apply, the order of precedence is
/// 70, 2, 4, 1, 3, 130, 5.
enum class ExitCode : int {
  ok = 0,
  violated = 1,
  usage = 2,  ///< wrong usage or unreadable input: one line gives file, place and reason
  regression = 3,
  backend_unavailable = 4,
  nothing_checked = 5,
  internal = 70,
  /// A signal ended the command before it found a violation, or before it could write one; or a run
  /// that is compared with a baseline ended before its last case.
  interrupted = 130,
};

}  // namespace rastercheck::cli
