#pragma once

// The coverage that a Case asks for and a Contract promises: the triangle that samples are judged
// against, and the rule by which a triangle owns a sample on an edge (RULES §2, §3).

#include <optional>

namespace rastercheck::cases {

/// How a window position becomes a grid point. `nearest_even` and `half_up` (towards +x, +y) name
/// one grid point; `unspecified` allows either neighbour, or only the position itself if it lies on
/// the grid.
enum class Rounding { nearest_even, half_up, unspecified };

/// The subpixel grid that window positions are rounded to.
struct Snapping {
  int subpixel_bits = 8;  ///< grid of 2^-subpixel_bits pixels, 0…16
  Rounding rounding = Rounding::nearest_even;
  /// How far the position may be off before rounding, in grid units; >= 0.
  float position_error = 0;
  bool operator==(const Snapping&) const = default;
};
inline constexpr int kMaxSubpixelBits = 16;
/// The largest position error in grid units, inclusive; 256 pixels on an 8-bit grid.
inline constexpr float kMaxPositionError = 65536;

/// Empty: the mathematical triangle. Else the triangle of the snapped positions.
using Coverage = std::optional<Snapping>;

/// The positions that attributes and facing come from.
enum class Basis { ideal, snapped, unspecified };

/// The depths that depth tests compare: the float32 of the fragment, the float64 before rounding to
/// that, or a depth rounded to a step of 1/(2^n − 1).
enum class DepthFormat { float32, float64, unorm16, unorm24, unorm32 };

/// Which edges own a sample that lies exactly on them.
enum class TieRule { top_left, bottom_left, unspecified };

}  // namespace rastercheck::cases
