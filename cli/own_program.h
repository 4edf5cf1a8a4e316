#pragma once

namespace rastercheck::cli {

/// This program's file, for processes of its own.
inline constexpr const char* kOwnProgram = "/proc/self/exe";

}  // namespace rastercheck::cli
