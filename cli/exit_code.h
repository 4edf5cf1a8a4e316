#pragma once

namespace rastercheck::cli {

/// Exit codes, stable for those who script them (CONTRACT, Commands). Where several apply the order
/// is 70, 2, 4, 1, 3, 5.
enum class ExitCode : int {
  ok = 0,
  violated = 1,
  usage = 2,  ///< wrong usage or unreadable input: one line says file, place and why
  regression = 3,
  backend_unavailable = 4,
  nothing_checked = 5,
  internal = 70,
  interrupted = 130,  ///< by a signal; nothing was violated until then, or it could not be written
};

}  // namespace rastercheck::cli
