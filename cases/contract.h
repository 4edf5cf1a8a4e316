#pragma once

// What a backend promises about coverage and attributes (RULES §3). A Contract decides verdicts.

#include <optional>

namespace rastercheck::cases {

/// How a window position becomes a grid point. `nearest_even` and `half_up` (towards +x, +y) name
/// one; `unspecified` is either neighbour, and the position itself where it lies on the grid.
enum class Rounding { nearest_even, half_up, unspecified };

/// The subpixel grid that window positions are rounded to.
struct Snapping {
  int subpixel_bits = 8;  ///< grid of 2^-subpixel_bits pixels, 0…16
  Rounding rounding = Rounding::nearest_even;
  /// How far the position may be off before it is rounded, in grid units; >= 0.
  float position_error = 0;
  bool operator==(const Snapping&) const = default;
};
inline constexpr int kMaxSubpixelBits = 16;
/// Grid units, inclusive; 256 pixels on an 8-bit grid.
inline constexpr float kMaxPositionError = 65536;

/// No value: the mathematical triangle. A value: the triangle of the snapped positions.
using Coverage = std::optional<Snapping>;

/// The positions that attributes and facing come from.
enum class Basis { ideal, snapped, unspecified };

/// Which edges own a sample that lies exactly on them.
enum class TieRule { top_left, bottom_left, unspecified };

struct Contract {
  Coverage coverage;
  Basis basis = Basis::ideal;
  TieRule tie_rule = TieRule::top_left;
  /// A vertex whose window position is farther than this from the window origin in x or y, in
  /// pixels, may be clipped. Only where `coverage` is snapped. D3D: 2^15.
  float guard_band = 32768;
  /// How far an edge that was cut by a clip plane, and the clip edge itself, may be off, in grid
  /// units per axis. Only where `coverage` is snapped.
  float clip_tolerance = 1;
  bool operator==(const Contract&) const = default;

  /// Whether it leaves more than one answer open, so that values are ranges.
  bool is_unspecified() const {
    return basis == Basis::unspecified ||
           (coverage &&
            (coverage->rounding == Rounding::unspecified || coverage->position_error > 0));
  }
};

}  // namespace rastercheck::cases
