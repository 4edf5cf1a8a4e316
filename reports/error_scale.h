#pragma once

// Colours for errors, on a logarithmic scale. Two scales that are seen side by side have colours of
// their own, so that what is nearly right and what is far off are not taken for each other.

#include <span>
#include <string>
#include <string_view>

#include "reports/image.h"

namespace rastercheck::reports {

/// From 2^least_exponent and less, the first colour, to 2^greatest_exponent and more, the last.
struct ErrorScale {
  std::string_view unit;  ///< in the plural, as "scale ULP"
  int least_exponent = 0;
  int greatest_exponent = 0;
  /// Dark to light, at equal distances: apart for readers who do not tell red from green, and on
  /// paper without colours.
  std::span<const Color> ramp;
  Color violated;                            ///< not on the ramp
  std::span<const std::string_view> labels;  ///< from end to end at equal distances
};

/// 1/64…1024 scale ULP, from blue to yellow: of what is off by roundings.
const ErrorScale& ulp_scale();
/// 1/16…256 of a texture's texels, from violet to sand: of what is seen to be off.
const ErrorScale& texel_scale();
/// The same of the 255 levels of a colour.
const ErrorScale& level_scale();

/// The colour at a share of the ramp, 0…1.
Color ramp_color(const ErrorScale& scale, double share);

/// The colour of an error in the scale's unit; what is no number is violated.
Color error_color(const ErrorScale& scale, float error);

/// The ramp with its labels and its unit, as an SVG element. Colours of text come from the page
/// (--ink, --muted).
std::string legend_svg(const ErrorScale& scale);

}  // namespace rastercheck::reports
