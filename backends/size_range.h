#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace rastercheck::backends {

/// The widths of lines, or sizes of points, that a driver draws as asked; it clamps and rounds
/// others. In pixels, bounds are inclusive.
struct SizeRange {
  float least = 1;
  float greatest = 1;
  float granularity = 0;  ///< the step from each size to the next; 0: there are all

  /// True for least + n · granularity, rounded to float32, with an integer n.
  bool has(float size) const {
    const bool is_within = size >= least && size <= greatest;
    if (!is_within) return false;
    if (!(granularity > 0)) return true;
    const double step = double{granularity};
    const double n = std::round((double{size} - double{least}) / step);
    return static_cast<float>(double{least} + n * step) == size;
  }
  /// For readers: "1 to 255 in steps of 0.125".
  std::string in_words() const {
    if (!(greatest > least)) return fmt::format("{}", least);
    return fmt::format("{} to {}{}", least, greatest,
                       granularity > 0 ? fmt::format(" in steps of {}", granularity) : "");
  }
};

}  // namespace rastercheck::backends
