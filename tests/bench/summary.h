#pragma once

// What two pictures of a scene have to have in common for their times to be compared.

#include <cmath>
#include <cstddef>
#include <span>

namespace rastercheck::bench {

struct Summary {
  double covered = 0;  ///< pixels nearer than the cleared depth, 1
  double red = 0;      ///< the mean of the first attribute over these
  double green = 0;    ///< of the second
  double depth = 0;
};

/// Of depth [pixel] and colour [pixel][`channels`].
inline Summary summarize(std::span<const float> depth, std::span<const float> color,
                         std::size_t channels) {
  Summary sum;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] >= 1) continue;
    ++sum.covered;
    sum.red += color[channels * i];
    sum.green += color[channels * i + 1];
    sum.depth += depth[i];
  }
  if (sum.covered == 0) return sum;
  return {sum.covered, sum.red / sum.covered, sum.green / sum.covered, sum.depth / sum.covered};
}

/// Whether both come from the same scene. Rasterizers differ at edges, where one snaps vertices and
/// the other does not, and a pixel there may show what lies behind: less than a hundredth of the
/// pixels of any scene here, on a grid of 2^-8 pixels. A triangle's edges given to its neighbour,
/// another depth test, or rows upside down make more.
inline bool show_the_same(const Summary& a, const Summary& b, double covered_tolerance) {
  constexpr double kTolerance = 0.01;
  return std::abs(a.covered - b.covered) <= covered_tolerance * b.covered &&
         std::abs(a.red - b.red) <= kTolerance && std::abs(a.green - b.green) <= kTolerance &&
         std::abs(a.depth - b.depth) <= kTolerance;
}

}  // namespace rastercheck::bench
