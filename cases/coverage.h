#pragma once

// The coverage that a Case asks for and a Contract promises: the triangle that samples are judged
// against, and the rule by which a triangle owns a sample on an edge (RULES §2, §3).

#include <bit>
#include <cstddef>
#include <optional>

namespace rastercheck::cases {

/// How a window coordinate becomes a grid coordinate. All but `unspecified` name one grid
/// coordinate: the nearest, where halves go to the even, the greater (`half_up`) or the lesser
/// (`half_down`) one; or the next in one direction. `unspecified` allows either neighbour, or only
/// the coordinate itself if it lies on the grid.
enum class Rounding { nearest_even, half_up, unspecified, half_down, floor, ceil, toward_zero };

inline constexpr int kMaxSubpixelBits = 16;
/// The most grid points per pixel along an axis.
inline constexpr int kMaxGridSteps = 1 << kMaxSubpixelBits;

/// The subpixel grid that window positions are rounded to.
struct Snapping {
  int subpixel_bits = 8;  ///< 0…16
  Rounding rounding = Rounding::nearest_even;
  /// How far the position may be off before rounding, in grid units; >= 0.
  float position_error = 0;
  /// The rounding along window y, if it is another one than along x. Neither may be `unspecified`
  /// then.
  std::optional<Rounding> rounding_of_y = {};
  /// An odd number. The grid has odd_steps · 2^subpixel_bits points per pixel, so a grid of 1/12
  /// pixel has 3 and 2 bits. At most kMaxGridSteps points.
  int odd_steps = 1;
  bool operator==(const Snapping&) const = default;

  bool is_unspecified() const { return rounding == Rounding::unspecified; }
  Rounding rounding_along(std::size_t axis) const {
    return axis == 1 ? rounding_of_y.value_or(rounding) : rounding;
  }
  /// Grid points per pixel.
  int steps() const { return odd_steps << subpixel_bits; }
  /// The largest distance between a position that has no error and its grid point, in grid units.
  double rounding_reach() const {
    const auto is_nearest = [](Rounding one) {
      return one == Rounding::nearest_even || one == Rounding::half_up ||
             one == Rounding::half_down;
    };
    return is_nearest(rounding) && is_nearest(rounding_along(1)) ? 0.5 : 1;
  }
};
/// The grid of 1/steps pixel, with the roundings and the error of `like`.
inline Snapping with_steps(Snapping like, int steps) {
  like.subpixel_bits = std::countr_zero(static_cast<unsigned>(steps));
  like.odd_steps = steps >> like.subpixel_bits;
  return like;
}
/// The largest position error in grid units, inclusive; 256 pixels on an 8-bit grid.
inline constexpr float kMaxPositionError = 65536;

/// Empty: the mathematical triangle. Else the triangle of the snapped positions.
using Coverage = std::optional<Snapping>;

/// The positions that attributes and facing come from.
enum class Basis { ideal, snapped, unspecified };

/// The depths that depth tests compare: the float32 of the fragment, the float64 before rounding to
/// that, or a depth rounded to a step of 1/(2^n − 1). A case asks for float32, unorm16 or unorm24.
enum class DepthFormat { float32, float64, unorm16, unorm24, unorm32 };

/// The bits of a unorm format; 0 for floats.
constexpr int unorm_bits(DepthFormat format) {
  switch (format) {
    case DepthFormat::unorm16:
      return 16;
    case DepthFormat::unorm24:
      return 24;
    case DepthFormat::unorm32:
      return 32;
    case DepthFormat::float32:
    case DepthFormat::float64:
      break;
  }
  return 0;
}

/// Which edges own a sample that lies exactly on them, as displayed. A rule that names two sides
/// asks first whether the edge is on the first side and, if it is parallel to that axis, whether it
/// is on the second: `top_left` means left edges, and top edges that are horizontal, while
/// `top_then_left` means top edges, and left edges that are vertical. `all`: every edge. `none`: no
/// edge. The last three occur in contracts only.
enum class TieRule {
  top_left,     ///< left, then top
  bottom_left,  ///< left, then bottom
  top_right,    ///< right, then top
  bottom_right,
  top_then_left,
  top_then_right,
  bottom_then_left,
  bottom_then_right,
  all,
  none,
  unspecified
};

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
///   inner   forbidden unless S lies in T; required if S grown by `error` does. The viewport's
///   sides
///           are not moved: of them S itself must keep clear.
///
/// A pixel whose square does not meet the viewport is never covered. Values of samples outside T
/// are those of the triangle's planes; where these have 1/w <= 0, any value is right.
struct Conservative {
  ConservativeKind kind = ConservativeKind::outer;
  float error = 0;   ///< in pixels; >= 0
  float growth = 0;  ///< in pixels; >= 0, and 0 for inner coverage
  ConservativeCorners corners = ConservativeCorners::square;  ///< square for inner coverage
  /// True if a triangle without area covers the pixels that it touches, as above, if culling is off
  /// and its indices differ. If culling is on, or if indices are equal, it may cover them. If
  /// false, triangles without area cover nothing, and triangles that lose their area when vertices
  /// are snapped may cover nothing. Outer coverage only.
  bool covers_degenerates = false;
  bool operator==(const Conservative&) const = default;
};
/// The largest error, and the largest growth, in pixels.
inline constexpr float kMaxConservativeReach = 16384;

}  // namespace rastercheck::cases
