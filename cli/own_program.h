#pragma once

namespace rastercheck::cli {

/// This program's executable, to start more processes of it.
inline constexpr const char* kOwnProgram = "/proc/self/exe";

}  // namespace rastercheck::cli
