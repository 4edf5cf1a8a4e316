#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// A draw and a triangle as the kernels see them (group_kernels.h, tile_kernels.h): numbers only, as
// vectors need them. The kernels evaluate values in double and at samples, without user clip
// distances. Coverage is either exact, in a viewport on a grid of 1/256 pixel (sample_frame.h),
// where U and V of samples are exact; or it is that of snapped vertices, if values also come from
// the snapped vertices.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "rasterizer/internal/depth_bias.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/grid_position.h"

namespace rastercheck::rasterizer {

/// Maximum subpixel bits in the kernels. Coordinates within the guard band are then below 2^25. A
/// line a x + b y + c between such points is below 2^53 at the samples of a target, and so are the
/// sums of its terms.
inline constexpr int kMostKernelBits = 10;

struct KernelSetting {
  std::size_t samples = 1;
  /// [sample]: U of column x is u_first + x u_step, exactly; V of row y likewise.
  std::array<double, DrawBounds::kMaxSamples> u_first{};
  std::array<double, DrawBounds::kMaxSamples> v_first{};
  double u_step = 0;
  double v_step = 0;
  /// The least and greatest offset of a sample in its pixel.
  double least_offset = 0;
  double greatest_offset = 0;
  double t = 0;
  double u_greatest = 0;
  double v_greatest = 0;
  /// True if vertices are rounded to a grid (grid_position.h). U and V are then in grid units, and
  /// T = 1.
  bool snaps = false;
  Grid grid;
  double units = 1;  ///< grid units per pixel
  /// Each term of an edge is a multiple of the lowest bit of its coefficient times the term's
  /// grain.
  double u_grain = 0;
  double v_grain = 0;
  double t_grain = 0;
  /// An edge owns the samples on its line if a · u_owner > 0, or if a = 0 and b · v_owner > 0.
  double u_owner = 0;
  double v_owner = 0;
  /// Window position of an NDC position x: middle + half · x.
  double u_middle = 0;
  double u_half = 0;
  double v_middle = 0;
  double v_half = 0;
  /// For conservative coverage with one sample per pixel, its centre: 1 if an edge decides at the
  /// pixel's corner where it is greatest (outer), −1 where it is least (inner). 0: samples are
  /// covered. The corners are half a pixel from the centre, `u_reach` in U and `v_reach` in V.
  double corner_sign = 0;
  double u_reach = 0;
  double v_reach = 0;
  PixelBox bounds;
  int tile_columns = 0;
  bool culls_positive = false;  ///< true if positive determinants (on the grid: areas) are culled
  bool culls_negative = false;
  bool clips_depth = false;
  double near_w = 0;  ///< the near plane keeps z + near_w · w >= 0
  double depth_low = 0;
  double depth_span = 0;
  double depth_least = 0;
  double depth_greatest = 0;
  double depth_steps = 0;  ///< depth_store.h
  BiasTerms bias;
  bool tests_depth = false;
  std::size_t provoking = 0;
  std::size_t attributes = 0;
  std::array<Interpolation, kMaxAttributes> interpolation{};
  bool has_smooth = false;
  bool has_affine = false;
  bool all_smooth = false;
  bool is_plain = false;  ///< float32 depth is tested, and attributes exist and are all smooth
  /// True if small triangles yield covered samples instead of fragments (LaneFate::covered).
  bool makes_cells = false;
};

/// Makes the kernels' setting; empty if the kernels cannot draw as the state asks. `tile_columns`
/// is the number of tiles in a row of the framebuffer.
std::optional<KernelSetting> kernel_setting(const DrawSetting& setting, int tile_columns);

/// Indices into the numbers of a triangle's planes for depth and values: a, b, c of plane.h for
/// each.
struct TrianglePlanes {
  static constexpr std::size_t kSum = 0;  ///< Σ E_i; 1 if no value is divided
  static constexpr std::size_t kDepth = 3;
  static constexpr std::size_t kValues = 6;  ///< one plane per attribute

  static constexpr std::size_t count(std::size_t attributes) { return kValues + 3 * attributes; }
};

/// Indices into the numbers of a triangle.
struct TriangleNumbers {
  /// A triangle's samples lie in the intersection of six half-planes: those of its edges, those of
  /// the depth planes that cut it (clip_functionals.h), and the half-plane where the denominator is
  /// large enough for double.
  static constexpr std::size_t kHalfPlanes = 6;
  static constexpr std::size_t kNear = 3;
  static constexpr std::size_t kFar = 4;
  static constexpr std::size_t kDenominator = 5;  ///< TrianglePlanes::kSum
  static constexpr std::size_t kA = 0;            ///< one per half-plane
  static constexpr std::size_t kB = kHalfPlanes;
  static constexpr std::size_t kC = 2 * kHalfPlanes;  ///< c times T
  /// A sample is surely inside if a U + (b V + c) is above this limit: the band or, if nothing is
  /// rounded, the number just below the least value inside.
  static constexpr std::size_t kSure = 3 * kHalfPlanes;
  /// A sample is surely outside unless a U + (b V + c) is above this limit.
  static constexpr std::size_t kPossible = 4 * kHalfPlanes;
  /// The first index of the TrianglePlanes; their kSum is filled in only if makes_cells.
  static constexpr std::size_t kPlanes = 5 * kHalfPlanes;
  static constexpr std::size_t kDepth = kPlanes + TrianglePlanes::kDepth;
  static constexpr std::size_t kValues = kPlanes + TrianglePlanes::kValues;

  static constexpr std::size_t count(std::size_t attributes) {
    return kPlanes + TrianglePlanes::count(attributes);
  }
  static constexpr std::size_t kMost = kPlanes + TrianglePlanes::count(kMaxAttributes);
};

}  // namespace rastercheck::rasterizer
