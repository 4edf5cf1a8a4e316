#pragma once

// The first level's inner bound of a centroid where the rules name no place for it (OpenGL,
// Vulkan): every value is permitted that the triangle has somewhere in the pixel. A value between
// those at the corners of what the triangle covers of the pixel is one of them, as that is convex
// and the value continuous there.
//
// The pixel is cut in doubles, by each line moved inwards by more than all that may be wrong: the
// line's values at the two corners that a new one lies between, and the rounding of its position in
// this cut and those that follow. So every corner lies inside, certainly.

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
  /// Of a triangle's map, which is its one or, where the contract leaves several, the exact one;
  /// `edges` are its, about the corner of `box`, which holds all pixels that will be asked for.
  /// Nothing where doubles say too little of it.
  static std::optional<CentroidFilter> make(const TriangleSetup& triangle, const ProjectiveMap& map,
                                            const std::array<FilterLine, 3>& edges,
                                            const PixelBox& box);

  /// Whether a computed value certainly is one that the triangle has in pixel (x, y).
  bool holds(int x, int y, const ValueFilter& value, double computed);

 private:
  /// The triangle's edges, the viewport's sides, and all planes that cut it: two of depth and
  /// cases::kMaxClipDistances; each adds one corner to the pixel's four.
  static constexpr std::size_t kMostLines = 3 + 4 + 2 + cases::kMaxClipDistances;
  using Corners = std::array<std::array<double, 2>, 4 + kMostLines>;

  CentroidFilter(const std::array<FilterLine, 3>& edges, const PixelBox& box)
      : edges_(edges), box_(box) {}
  void cut_pixel(int x, int y);

  std::array<FilterLine, 3> edges_;
  PixelBox box_;
  std::vector<FilterLine> lines_;  ///< inside is above the band

  // The pixel asked for last: several samples and attributes ask for the same.
  std::optional<std::array<int, 2>> pixel_;
  std::size_t count_ = 0;                                        ///< of its corners
  std::array<std::array<double, 3>, 4 + kMostLines> weights_{};  ///< [corner]: E_i
};

}  // namespace rastercheck::oracle
