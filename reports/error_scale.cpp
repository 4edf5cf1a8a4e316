#include "reports/error_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/internal/log2.h"

namespace rastercheck::reports {
namespace {

constexpr std::array<Color, 6> kBlueToYellow{Color{27, 26, 84},   Color{40, 72, 138},
                                             Color{46, 116, 142}, Color{76, 156, 126},
                                             Color{158, 196, 92}, Color{252, 232, 84}};
constexpr std::array<Color, 6> kVioletToSand{Color{34, 20, 66},   Color{92, 28, 110},
                                             Color{154, 44, 106}, Color{212, 80, 82},
                                             Color{246, 148, 66}, Color{255, 236, 170}};
constexpr Color kRed{235, 0, 50};
constexpr Color kCyan{0, 214, 230};

/// A label for every second octave.
constexpr std::array<std::string_view, 9> kUlpLabels{"1/64", "1/16", "1/4", "1",   "4",
                                                     "16",   "64",   "256", "1024"};
constexpr std::array<std::string_view, 7> kTexelLabels{"1/16", "1/4", "1", "4", "16", "64", "256"};

}  // namespace

const ErrorScale& ulp_scale() {
  static constexpr ErrorScale kScale{"scale ULP", -6, 10, kBlueToYellow, kRed, kUlpLabels};
  return kScale;
}

const ErrorScale& texel_scale() {
  static constexpr ErrorScale kScale{"texels", -4, 8, kVioletToSand, kCyan, kTexelLabels};
  return kScale;
}

const ErrorScale& level_scale() {
  static constexpr ErrorScale kScale{"levels of 255", -4, 8, kVioletToSand, kCyan, kTexelLabels};
  return kScale;
}

Color ramp_color(const ErrorScale& scale, double share) {
  const std::size_t last = scale.ramp.size() - 1;
  const double position = std::clamp(share, 0.0, 1.0) * static_cast<double>(last);
  const std::size_t below = std::min(static_cast<std::size_t>(position), last - 1);
  const double beyond = position - static_cast<double>(below);
  Color color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = scale.ramp[below][i];
    const double high = scale.ramp[below + 1][i];
    color[i] = static_cast<std::uint8_t>(std::lround(low + (high - low) * beyond));
  }
  return color;
}

Color error_color(const ErrorScale& scale, float error) {
  if (std::isnan(error)) return scale.violated;
  if (!(error > 0)) return ramp_color(scale, 0);
  if (std::isinf(error)) return ramp_color(scale, 1);
  const double octaves = scale.greatest_exponent - scale.least_exponent;
  return ramp_color(scale, (drawn_log2(error) - scale.least_exponent) / octaves);
}

std::string legend_svg(const ErrorScale& scale) {
  // In units of the view box: a bar with its labels below.
  constexpr double kWidth = 320;
  constexpr double kMargin = 14;
  constexpr double kBar = kWidth - 2 * kMargin;
  std::string svg = fmt::format(
      "<svg class=\"legend\" viewBox=\"0 0 {} 40\" role=\"img\" aria-label=\"Colours from {} to {} "
      "{}\">\n",
      kWidth, scale.labels.front(), scale.labels.back(), scale.unit);
  // Steps rather than a gradient, which would need a name that is unique on the page.
  constexpr int kSteps = 73;
  for (int i = 0; i < kSteps; ++i) {
    const Color color = ramp_color(scale, static_cast<double>(i) / (kSteps - 1));
    svg += fmt::format(
        "<rect x=\"{:.2f}\" y=\"0\" width=\"{:.2f}\" height=\"10\" "
        "shape-rendering=\"crispEdges\" "
        "style=\"fill:#{:02x}{:02x}{:02x}\"/>\n",
        kMargin + kBar * i / kSteps, kBar / kSteps + 0.5, color[0], color[1], color[2]);
  }
  for (std::size_t i = 0; i < scale.labels.size(); ++i) {
    const double x =
        kMargin + kBar * static_cast<double>(i) / static_cast<double>(scale.labels.size() - 1);
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"10\" x2=\"{0:.1f}\" y2=\"14\"/>\n"
        "<text x=\"{0:.1f}\" y=\"24\" class=\"axis\" text-anchor=\"middle\">{1}</text>\n",
        x, scale.labels[i]);
  }
  return svg + fmt::format(
                   "<text x=\"{}\" y=\"37\" class=\"axis\" text-anchor=\"middle\">error in {}, "
                   "logarithmic</text>\n</svg>\n",
                   kWidth / 2, scale.unit);
}

}  // namespace rastercheck::reports
