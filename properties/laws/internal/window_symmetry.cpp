#include "properties/laws/internal/window_symmetry.h"

#include <algorithm>
#include <cmath>

#include "properties/exact_sum.h"

namespace rastercheck::properties {
namespace {

PixelSpan clamped_span(std::int64_t begin, std::int64_t extent, int size) {
  const auto hold = [size](std::int64_t at) {
    return static_cast<int>(std::clamp(at, std::int64_t{0}, std::int64_t{size}));
  };
  return {hold(begin), hold(begin + extent)};
}

float without_last_bits(float value) {
  // Sums with 1.5 · 2^13 are rounded to multiples of 2^-10.
  constexpr float kBeyond = 0x1.8p13F;
  const float sum = value + kBeyond;
  return sum - kBeyond;
}

}  // namespace

std::optional<WindowSide> side_of(float begin, float size) {
  const std::optional<double> end = exact_sum(double{begin}, double{size});
  if (!end || size == 0) return std::nullopt;
  if (size < 0) return WindowSide{*end, -double{size}, double{begin}, true};
  return WindowSide{double{begin}, double{size}, *end, false};
}

bool is_at_samples(oracle::WindowAxis axis, double at, const cases::FramebufferSize& size) {
  const bool is_x = axis == oracle::WindowAxis::x;
  const int pixels = is_x ? size.width : size.height;
  const auto pattern = cases::standard_pattern(size.samples);
  return std::any_of(pattern.begin(), pattern.end(), [&](const cases::SamplePosition& position) {
    const auto pixel = exact_sum(at, -static_cast<double>(is_x ? position.x : position.y) / 16);
    return pixel && *pixel >= 0 && *pixel < pixels && std::floor(*pixel) == *pixel;
  });
}

std::optional<std::vector<std::uint8_t>> carried_samples(
    int samples, cases::SamplePosition (*carry)(const cases::SamplePosition&)) {
  const auto pattern = cases::standard_pattern(samples);
  std::vector<std::uint8_t> carried;
  for (const cases::SamplePosition& position : pattern) {
    const auto found = std::find(pattern.begin(), pattern.end(), carry(position));
    if (found == pattern.end()) return std::nullopt;
    carried.push_back(static_cast<std::uint8_t>(found - pattern.begin()));
  }
  return carried;
}

std::uint8_t carried_back(const std::vector<std::uint8_t>& carried, std::uint8_t sample) {
  const auto found = std::find(carried.begin(), carried.end(), sample);
  return found == carried.end() ? sample : static_cast<std::uint8_t>(found - carried.begin());
}

PixelSpan scissor_columns(const cases::Case& c) {
  const int size = c.framebuffer.width;
  if (!c.scissor) return {0, size};
  return clamped_span(c.scissor->x, c.scissor->width, size);
}

PixelSpan scissor_rows(const cases::Case& c) {
  const int size = c.framebuffer.height;
  if (!c.scissor) return {0, size};
  return clamped_span(c.scissor->y, c.scissor->height, size);
}

cases::Scissor rectangle(const PixelSpan& columns, const PixelSpan& rows) {
  return {columns.first, rows.first, std::max(columns.last - columns.first, 0),
          std::max(rows.last - rows.first, 0)};
}

bool keeps_even_points(const cases::Snapping& grid, int pixels) {
  const bool has_even_points = grid.rounding == cases::Rounding::nearest_even ||
                               grid.rounding_along(1) == cases::Rounding::nearest_even;
  return !has_even_points || grid.subpixel_bits > 0 || pixels % 2 == 0;
}

bool is_symmetric(const cases::Snapping& grid) {
  const auto is_alike = [&grid](std::size_t axis) {
    const cases::Rounding rounding = grid.rounding_along(axis);
    return rounding == cases::Rounding::nearest_even || rounding == cases::Rounding::unspecified;
  };
  return is_alike(0) && is_alike(1);
}

bool is_the_same_everywhere(const cases::Snapping& grid) {
  return grid.rounding_along(0) != cases::Rounding::toward_zero &&
         grid.rounding_along(1) != cases::Rounding::toward_zero;
}

cases::Contract with_origin_away(cases::Contract contract, int pixels) {
  contract.guard_band = std::max(contract.guard_band - static_cast<float>(pixels), 0.0F);
  return contract;
}

void move_centroids_to_samples(cases::Case& c) {
  for (cases::Attribute& attribute : c.attributes) {
    if (attribute.location == cases::Location::centroid) {
      attribute.location = cases::Location::sample;
    }
  }
}

void shorten_viewport(cases::Case& c) {
  for (float* number : {&c.viewport.x, &c.viewport.y, &c.viewport.width, &c.viewport.height}) {
    *number = without_last_bits(*number);
  }
}

}  // namespace rastercheck::properties
