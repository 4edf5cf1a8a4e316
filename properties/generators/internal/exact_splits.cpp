#include "properties/generators/internal/exact_splits.h"

#include <cmath>
#include <utility>

namespace rastercheck::properties {
namespace {

/// The least power of two that is at least |value|; 1 for 0.
double power_above(double value) {
  const double magnitude = std::abs(value);
  if (magnitude == 0) return 1;
  double power = 1;
  while (power < magnitude) power *= 2;
  while (power / 2 >= magnitude) power /= 2;
  return power;
}

/// The nearest multiple of `grain`, a power of two far above 2^-52 |value|.
double on_grain(double value, double grain) {
  const double far = 0x3p51 * grain;
  return (value + far) - far;
}

/// Returns total − part if a float holds the difference exactly.
std::optional<float> rest_of(double total, double part) {
  const double rest = total - part;
  const auto rounded = static_cast<float>(rest);
  if (double{rounded} != rest || total - rest != part) return std::nullopt;
  return rounded;
}

/// Returns one of two parts of `total`: almost all of it; a number of either sign, usually far
/// larger; or a number between about −1 and 2 times the size of `total`.
float random_part(Draw& draw, double total) {
  const double size = power_above(total);
  switch (draw.between(0, 3)) {
    case 0:
    case 1: {  // `total` to within a few floats, so the rest is tiny
      const int steps = draw.between(-3, 3);
      return stepped(to_float(total), steps);
    }
    case 2: {  // far larger than `total`, so the rest is about its opposite
      const int exponent = draw.between(1, 12);
      const double share = double{draw.uniform(-1, 1)} * power_of_two(exponent);
      return to_float(on_grain(share * size, size * 0x1p-10));
    }
    default: {
      const double share = double{draw.uniform(-1, 2)};
      return to_float(on_grain(share * size, size * 0x1p-22));
    }
  }
}

}  // namespace

Ray ray_through(const cases::Case& c, const WindowPoint& p) {
  const double width{c.viewport.width};
  const double height{c.viewport.height};
  const double side = c.rules == cases::Rules::d3d ? -1 : 1;
  const double sign = width * height < 0 ? -1 : 1;
  const double weight = sign * width * height;
  const double size = power_above(weight);
  const double unit = size > weight ? size / 2 : size;
  return {sign * (2 * (p.u - double{c.viewport.x}) - width) * height / unit,
          sign * side * (2 * (p.v - double{c.viewport.y}) - height) * width / unit, weight / unit};
}

std::optional<std::array<float, 2>> split_in_two(Draw& draw, double total) {
  const float part = random_part(draw, total);
  const bool is_first = draw.one_in(2);
  const auto rest = rest_of(total, double{part});
  if (!rest) return std::nullopt;
  if (is_first) return std::array{part, *rest};
  return std::array{*rest, part};
}

std::optional<std::array<float, 3>> split_in_three(Draw& draw, double total) {
  const double size = power_above(total);
  const double share = double{draw.uniform(-1, 1)};
  const float part = to_float(on_grain(share * size, size * 0x1p-20));
  const auto others = split_in_two(draw, total - double{part});
  if (!others || total - (total - double{part}) != double{part}) return std::nullopt;
  std::array<float, 3> parts{part, (*others)[0], (*others)[1]};
  const int first = draw.between(0, 2);
  std::swap(parts[0], parts[static_cast<std::size_t>(first)]);
  return parts;
}

std::optional<std::array<float, 3>> split_off_opposites(Draw& draw, double total) {
  const float rest = to_float(total);
  if (double{rest} != total) return std::nullopt;
  const int exponent = draw.between(-56, -24);
  const double mantissa = 1 + double{draw.unit()};
  const float tiny = to_float(mantissa * power_of_two(exponent) * power_above(total));
  std::array<float, 3> parts{rest, tiny, -tiny};
  const int first = draw.between(0, 2);
  std::swap(parts[0], parts[static_cast<std::size_t>(first)]);
  if (draw.one_in(2)) std::swap(parts[1], parts[2]);
  return parts;
}

void nudge_smallest(Draw& draw, std::span<float* const> numbers) {
  float* smallest = nullptr;
  for (float* number : numbers) {
    if (*number == 0) continue;
    if (smallest == nullptr || std::abs(*number) < std::abs(*smallest)) smallest = number;
  }
  const int steps = draw.one_in(2) ? 1 : -1;
  if (smallest != nullptr) *smallest = stepped(*smallest, steps);
}

}  // namespace rastercheck::properties
