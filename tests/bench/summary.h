#pragma once

// The properties that two pictures of a scene must share before their times are compared.

#include <cmath>
#include <cstddef>
#include <span>

namespace rastercheck::bench {

struct Summary {
  double covered = 0;  ///< number of pixels nearer than the cleared depth, 1
  double red = 0;      ///< mean of the first attribute over these pixels
  double green = 0;    ///< mean of the second attribute
  double depth = 0;
};

/// Summarizes depths [pixel] and colours [pixel][`channels`].
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

/// True if both pictures show the same scene. Rasterizers differ at edges if one snaps vertices and
/// the other does not, and a pixel there may show a surface behind. This concerns less than a
/// hundredth of the pixels of any scene here, on a grid of 2^-8 pixels. Faults concern more pixels:
/// an edge given to the wrong triangle, another depth test, or rows upside down.
inline bool show_the_same(const Summary& a, const Summary& b, double covered_tolerance) {
  constexpr double kTolerance = 0.01;
  return std::abs(a.covered - b.covered) <= covered_tolerance * b.covered &&
         std::abs(a.red - b.red) <= kTolerance && std::abs(a.green - b.green) <= kTolerance &&
         std::abs(a.depth - b.depth) <= kTolerance;
}

}  // namespace rastercheck::bench
