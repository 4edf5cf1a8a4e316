#pragma once

// An inner bound, in doubles, of the values that a centroid may have under OpenGL and Vulkan. These
// rules name no place for a centroid and permit every value that the triangle has somewhere in the
// pixel. The part of the pixel that the triangle covers is convex and the value is continuous on
// it, so every value between those at its corners is permitted.
//
// The filter cuts the pixel, in doubles, by every line that bounds this part. Each line is first
// moved inwards by more than the sum of all possible errors: the errors of the line's values at the
// two corners between which a new corner lies, and the rounding of the new corner in this cut and
// the following ones. So every corner is certain to lie inside.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "cases/case.h"
#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/triangle_setup.h"

namespace rastercheck::oracle {

class CentroidFilter {
 public:
  /// Makes the filter for `map`, which is the triangle's only map or, if the contract allows
  /// several, the exact triangle's. `edges` are the map's edges, relative to the corner of `box`,
  /// which must hold all pixels that will be asked for. Empty if doubles are too inaccurate.
  static std::optional<CentroidFilter> make(const TriangleSetup& triangle, const ProjectiveMap& map,
                                            const std::array<FilterLine, 3>& edges,
                                            const PixelBox& box);

  /// True if the triangle certainly has the computed value somewhere in pixel (x, y).
  bool holds(int x, int y, const ValueFilter& value, double computed);

 private:
  /// Counts the triangle's edges, the viewport's sides, and the planes that may cut the triangle:
  /// two depth planes and cases::kMaxClipDistances others. Each line adds one corner to the pixel's
  /// four.
  static constexpr std::size_t kMostLines = 3 + 4 + 2 + cases::kMaxClipDistances;
  using Corners = std::array<std::array<double, 2>, 4 + kMostLines>;

  CentroidFilter(const std::array<FilterLine, 3>& edges, const PixelBox& box)
      : edges_(edges), box_(box) {}
  void cut_pixel(int x, int y);

  std::array<FilterLine, 3> edges_;
  PixelBox box_;
  std::vector<FilterLine> lines_;  ///< inside: the line's value is above its band

  // Cache of the last pixel, because several samples and attributes ask for the same pixel.
  std::optional<std::array<int, 2>> pixel_;
  std::size_t count_ = 0;                                        ///< number of the pixel's corners
  std::array<std::array<double, 3>, 4 + kMostLines> weights_{};  ///< [corner]: E_i
};

}  // namespace rastercheck::oracle
