#pragma once

// What the kernels of frames (group_kernels.h, tile_kernels.h) know of a draw, and of a triangle:
// numbers alone, as vectors want them. They draw values in double and at samples, no user clip
// distances, and exact coverage in a viewport on a grid of 1/256 pixel (sample_frame.h), where
// U and V of samples are exact, or that of snapped vertices where values are theirs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/grid_position.h"

namespace rastercheck::rasterizer {

/// With so many subpixel bits coordinates within the guard band are below 2^25, lines a x + b y + c
/// between them at samples of a target below 2^53, and so is every sum of their terms.
inline constexpr int kMostKernelBits = 10;

struct KernelSetting {
  std::size_t samples = 1;
  /// [sample]: U of column x is u_first + x u_step, without rounding; V of row y likewise.
  std::array<double, DrawBounds::kMaxSamples> u_first{};
  std::array<double, DrawBounds::kMaxSamples> v_first{};
  double u_step = 0;
  double v_step = 0;
  /// Where in their pixels the first and the last samples are.
  double least_offset = 0;
  double greatest_offset = 0;
  double t = 0;
  double u_greatest = 0;
  double v_greatest = 0;
  /// Vertices are rounded to a grid (grid_position.h), and U, V are in its units; T = 1.
  bool snaps = false;
  Grid grid;
  double units = 1;  ///< of a pixel
  /// The terms of an edge are multiples of these times a coefficient's lowest bit.
  double u_grain = 0;
  double v_grain = 0;
  double t_grain = 0;
  /// What a coefficient's sign is multiplied with to say whether the edge owns its samples.
  double u_owner = 0;
  double v_owner = 0;
  /// Window position of an NDC position: middle + half · it.
  double u_middle = 0;
  double u_half = 0;
  double v_middle = 0;
  double v_half = 0;
  PixelBox bounds;
  int tile_columns = 0;
  bool culls_positive = false;  ///< triangles with a positive determinant, or area on the grid
  bool culls_negative = false;
  bool clips_depth = false;
  double near_w = 0;  ///< the near plane keeps z + near_w · w >= 0
  double depth_low = 0;
  double depth_span = 0;
  double depth_least = 0;
  double depth_greatest = 0;
  bool tests_depth = false;
  std::size_t provoking = 0;
  std::size_t attributes = 0;
  std::array<Interpolation, kMaxAttributes> interpolation{};
  bool has_smooth = false;
  bool has_affine = false;
  bool all_smooth = false;
  bool is_plain = false;  ///< all attributes are smooth, of which there are some; depth is tested
  /// Whether small triangles are to become what they cover, not fragments (LaneFate::covered).
  bool makes_cells = false;
};

/// Nothing where the kernels do not draw what the state asks for. `tile_columns`: tiles in a row of
/// the framebuffer.
std::optional<KernelSetting> kernel_setting(const DrawSetting& setting, int tile_columns);

/// What depth and values of a triangle come from, by place. Planes are a, b, c (plane.h).
struct TrianglePlanes {
  static constexpr std::size_t kSum = 0;  ///< Σ E_i; 1 where no value is divided
  static constexpr std::size_t kDepth = 3;
  static constexpr std::size_t kValues = 6;  ///< of each attribute

  static constexpr std::size_t count(std::size_t attributes) { return kValues + 3 * attributes; }
};

/// The numbers of a triangle, by place.
struct TriangleNumbers {
  /// A triangle's samples are those within six half-planes: of its edges, of the depth planes that
  /// cut it (clip_functionals.h), and of the denominator where double is enough for that.
  static constexpr std::size_t kHalfPlanes = 6;
  static constexpr std::size_t kNear = 3;
  static constexpr std::size_t kFar = 4;
  static constexpr std::size_t kDenominator = 5;  ///< TrianglePlanes::kSum
  static constexpr std::size_t kA = 0;            ///< of each
  static constexpr std::size_t kB = kHalfPlanes;
  static constexpr std::size_t kC = 2 * kHalfPlanes;  ///< times T
  /// A sample is surely within where a U + (b V + c) is above this: its band, or, where nothing is
  /// rounded, what lies just below the least number that samples within may have.
  static constexpr std::size_t kSure = 3 * kHalfPlanes;
  /// A sample is surely beyond unless it is above this.
  static constexpr std::size_t kPossible = 4 * kHalfPlanes;
  /// TrianglePlanes; with makes_cells kSum as well.
  static constexpr std::size_t kPlanes = 5 * kHalfPlanes;
  static constexpr std::size_t kDepth = kPlanes + TrianglePlanes::kDepth;
  static constexpr std::size_t kValues = kPlanes + TrianglePlanes::kValues;

  static constexpr std::size_t count(std::size_t attributes) {
    return kPlanes + TrianglePlanes::count(attributes);
  }
  static constexpr std::size_t kMost = kPlanes + TrianglePlanes::count(kMaxAttributes);
};

}  // namespace rastercheck::rasterizer
