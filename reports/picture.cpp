// Relief. With the range [n, f] of the depths in the picture, a depth d stands for a height
//
//   h(d) = kRelief · E · (f − d) / (f − n)     pixels, nearest highest,
//
// where E is the larger side of the drawn rectangle. If the pixels left and right are both drawn,
// the slope is half the difference of their heights. At an outline, it is the difference to the one
// neighbour that is drawn. The normal is (−dh/dx, −dh/dy, 1), the light comes from the upper left,
// and a surface that faces the viewer has its full colour. Only + − · / and square roots are used,
// so the doubles are the same on every machine.

#include "reports/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "reports/internal/canvas.h"

namespace rastercheck::reports {
namespace {

using Triple = std::array<double, 3>;

constexpr Color kNoNumber{255, 0, 255};

// The colours of the corners of the colour plane, as (attribute 0, attribute 1). They are muted,
// and also differ in lightness.
constexpr Triple kLowLow{52, 92, 132};      // blue
constexpr Triple kHighLow{226, 150, 104};   // apricot
constexpr Triple kLowHigh{124, 178, 158};   // sage
constexpr Triple kHighHigh{246, 222, 168};  // sand

constexpr double kRelief = 0.6;
/// If the range of depths is below this share of the larger depth, the relief is flat: float32
/// would have fewer than 64 steps in that range, and the relief would show their rounding.
constexpr double kFlat = 0x1p-18;
/// The limit for slopes, in pixels per pixel. Without it, cliffs at outlines within the picture
/// would be black.
constexpr double kSteepest = 3;
constexpr Triple kLight{-0.45, -0.55, 0.7};  // columns, rows, towards the viewer
constexpr double kAmbient = 0.5;
constexpr double kBrightest = 1.12;

/// The least and the greatest finite value; empty until a value is added.
struct ShownRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double extent() const { return high > low ? high - low : 0; }
  /// The position of a value in the range, 0…1; the middle if the range is a single value.
  double share(double value) const { return extent() > 0 ? (value - low) / extent() : 0.5; }
};

/// The fragment that each pixel shows, [row][column] with row 0 on top.
class Pixels {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  Pixels(const cases::Case& c, const cases::Fragments& drawn)
      : width_(c.framebuffer.width),
        height_(c.framebuffer.height),
        drawn_(&drawn),
        fragments_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kNone) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (drawn.x[i] >= width_ || drawn.y[i] >= height_) continue;
      std::size_t& shown = slot(drawn.x[i], row_of(drawn.y[i], height_, c.rules));
      if (shown == kNone || goes_before(i, shown)) shown = i;
    }
  }

  std::size_t at(int column, int row) const {
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return kNone;
    return fragments_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(column)];
  }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  std::size_t& slot(int column, int row) {
    return fragments_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(column)];
  }

  /// Orders by sample, then by depth; NaN comes last.
  bool goes_before(std::size_t a, std::size_t b) const {
    if (drawn_->sample[a] != drawn_->sample[b]) return drawn_->sample[a] < drawn_->sample[b];
    if (std::isnan(drawn_->depth[b])) return !std::isnan(drawn_->depth[a]);
    return drawn_->depth[a] < drawn_->depth[b];
  }

  int width_;
  int height_;
  const cases::Fragments* drawn_;
  std::vector<std::size_t> fragments_;
};

bool is_number(const cases::Fragments& drawn, std::size_t fragment) {
  const std::span<const float> values = drawn.attributes_of(fragment);
  return std::isfinite(drawn.depth[fragment]) &&
         std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

/// The ranges that scale the colours and the relief of a picture.
struct Scales {
  ShownRange first;   ///< range of attribute 0, or of depth if there are no attributes
  ShownRange second;  ///< range of attribute 1
  ShownRange depth;
  ShownRange columns;
  ShownRange rows;
};

double first_value(const cases::Fragments& drawn, std::size_t fragment) {
  return drawn.attribute_count > 0 ? drawn.attributes_of(fragment)[0] : drawn.depth[fragment];
}

double second_value(const cases::Fragments& drawn, std::size_t fragment) {
  return drawn.attribute_count > 1 ? drawn.attributes_of(fragment)[1] : 0;
}

Scales scales_of(const Pixels& pixels, const cases::Fragments& drawn) {
  Scales scales;
  for (int row = 0; row < pixels.height(); ++row) {
    for (int column = 0; column < pixels.width(); ++column) {
      const std::size_t fragment = pixels.at(column, row);
      if (fragment == Pixels::kNone || !is_number(drawn, fragment)) continue;
      scales.first.include(first_value(drawn, fragment));
      scales.second.include(second_value(drawn, fragment));
      scales.depth.include(drawn.depth[fragment]);
      scales.columns.include(column);
      scales.rows.include(row);
    }
  }
  return scales;
}

/// Pixels of height per unit of depth. Negative, as the nearest depth is the highest.
double height_scale(const Scales& scales) {
  const double larger = std::max(std::abs(scales.depth.low), std::abs(scales.depth.high));
  if (scales.depth.extent() <= kFlat * larger) return 0;
  const double extent = std::max(scales.columns.extent(), scales.rows.extent()) + 1;
  return -kRelief * extent / scales.depth.extent();
}

/// The slope along one direction, from the depths before, at and after a pixel.
double slope(std::optional<double> before, double here, std::optional<double> after, double scale) {
  const double steps = (before ? 1 : 0) + (after ? 1 : 0);
  if (steps == 0) return 0;
  const double rise = (after.value_or(here) - before.value_or(here)) * scale / steps;
  return std::clamp(rise, -kSteepest, kSteepest);
}

double brightness(const Pixels& pixels, const cases::Fragments& drawn, int column, int row,
                  double scale) {
  const auto depth_at = [&](int x, int y) -> std::optional<double> {
    const std::size_t fragment = pixels.at(x, y);
    if (fragment == Pixels::kNone || !is_number(drawn, fragment)) return std::nullopt;
    return drawn.depth[fragment];
  };
  const double here = drawn.depth[pixels.at(column, row)];
  const double dx = slope(depth_at(column - 1, row), here, depth_at(column + 1, row), scale);
  const double dy = slope(depth_at(column, row - 1), here, depth_at(column, row + 1), scale);
  const double lit =
      (-dx * kLight[0] - dy * kLight[1] + kLight[2]) / std::sqrt(dx * dx + dy * dy + 1);
  return std::min(kAmbient + (1 - kAmbient) * std::max(lit, 0.0) / kLight[2], kBrightest);
}

std::uint8_t to_channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

/// The colour at (u, v) of the colour plane, both 0…1, multiplied by the light.
Color plane_color(double u, double v, double light) {
  Color color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = kLowLow[i] + (kHighLow[i] - kLowLow[i]) * u;
    const double high = kLowHigh[i] + (kHighHigh[i] - kLowHigh[i]) * u;
    color[i] = to_channel((low + (high - low) * v) * light);
  }
  return color;
}

}  // namespace

Image draw_picture(const cases::Case& c, const cases::Fragments& drawn) {
  const Pixels pixels(c, drawn);
  const Scales scales = scales_of(pixels, drawn);
  const double scale = height_scale(scales);
  Image image = Image::filled(pixels.width(), pixels.height(), kUndrawn);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const std::size_t fragment = pixels.at(column, row);
      if (fragment == Pixels::kNone) continue;
      if (!is_number(drawn, fragment)) {
        image.set(column, row, kNoNumber);
        continue;
      }
      const double u = scales.first.share(first_value(drawn, fragment));
      const double v = scales.second.share(second_value(drawn, fragment));
      image.set(column, row, plane_color(u, v, brightness(pixels, drawn, column, row, scale)));
    }
  }
  return image;
}

}  // namespace rastercheck::reports
