#pragma once

// Colours for errors, on a logarithmic scale. Scales that are seen side by side have different
// colours, so that readers do not mistake a small error on one scale for a large error on another.

#include <span>
#include <string>
#include <string_view>

#include "reports/image.h"

namespace rastercheck::reports {

/// A range of errors and its colours: the first colour stands for errors of 2^least_exponent and
/// below, the last for errors of 2^greatest_exponent and above.
struct ErrorScale {
  std::string_view unit;  ///< plural, such as "scale ULP"
  int least_exponent = 0;
  int greatest_exponent = 0;
  /// From dark to light, at equal distances. The colours also differ for readers who cannot tell
  /// red from green, and in print without colours.
  std::span<const Color> ramp;
  Color violated;                            ///< not on the ramp
  std::span<const std::string_view> labels;  ///< from end to end, at equal distances
};

/// From 1/64 to 1024 scale ULP, in blue to yellow, for rounding errors.
const ErrorScale& ulp_scale();
/// From 1/16 to 256 texels of a texture, in violet to sand, for visible errors.
const ErrorScale& texel_scale();
/// The same range and colours for errors of colours, in steps of 1/255.
const ErrorScale& level_scale();

/// The colour at a position on the ramp, 0…1.
Color ramp_color(const ErrorScale& scale, double share);

/// The colour of an error, given in the scale's unit; NaN counts as violated.
Color error_color(const ErrorScale& scale, float error);

/// The ramp with its labels and its unit, as an SVG element. The page supplies the colours of the
/// text (--ink, --muted).
std::string legend_svg(const ErrorScale& scale);

}  // namespace rastercheck::reports
