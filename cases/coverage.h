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

/// Which pixels conservative coverage takes. `outer`: at least every pixel that the triangle
/// touches. `inner`: at most the pixels that lie in the triangle.
enum class ConservativeKind { outer, inner };

/// How an outer coverage grows. `square`: a pixel is tested with its square grown to all sides.
/// `edges`: each edge is shifted outwards "in X and Y equally", by g (|A| + |B|) of its functional,
/// and the shifted edges may meet far beyond an acute corner, as in Vulkan.
enum class ConservativeCorners { square, edges };

/// Conservative coverage: whole pixels are covered, with all their samples (RULES §11). S is a
/// pixel's open square, and T is the triangle inside all clip planes, clip distances and the
/// viewport.
///
///   outer   required if S grown by `growth` meets T; if it only touches T's border, either answer
///           is right. Forbidden if S grown by growth + error misses T.
///   inner   forbidden unless S lies in T; required if S grown by `error` does. The viewport's sides
///           are not moved: of them S itself must keep clear.
///
/// A pixel whose square does not meet the viewport is never covered. Values of samples outside T are
/// those of the triangle's planes; where these have 1/w <= 0, any value is right.
struct Conservative {
  ConservativeKind kind = ConservativeKind::outer;
  float error = 0;   ///< in pixels; >= 0
  float growth = 0;  ///< in pixels; >= 0, and 0 for inner coverage
  ConservativeCorners corners = ConservativeCorners::square;  ///< square for inner coverage
  /// True if a triangle without area covers the pixels that it touches, as above, if culling is off
  /// and its indices differ. If culling is on, or if indices are equal, it may cover them. If false,
  /// triangles without area cover nothing, and triangles that lose their area when vertices are
  /// snapped may cover nothing. Outer coverage only.
  bool covers_degenerates = false;
  bool operator==(const Conservative&) const = default;
};
/// The largest error, and the largest growth, in pixels.
inline constexpr float kMaxConservativeReach = 16384;

}  // namespace rastercheck::cases
