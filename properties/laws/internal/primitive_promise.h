#pragma once

// What laws about lines and points ask of a backend (Law::is_promised).

#include <string_view>

#include "backends/backend.h"

namespace rastercheck::properties {

/// True if the backend draws lines, or points.
bool draws_lines(backends::Backend& backend);
bool draws_points(backends::Backend& backend);

inline constexpr std::string_view kDrawsNoLines = "the backend draws no lines";
inline constexpr std::string_view kDrawsNoPoints = "the backend draws no points";

}  // namespace rastercheck::properties
