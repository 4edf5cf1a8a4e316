#include "rasterizer/internal/sample_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rastercheck::rasterizer {
namespace {

/// True if `value` is a multiple of 1/256 and at most 2^15 in size. For such values 2 at − shift is
/// a multiple of 2^-8 below 2^18, which needs 26 bits, and its product with another such value
/// needs 49 bits.
bool is_coarse(float value) { return std::abs(value) <= 0x1p15F && lowest_bit(value) >= -8; }

AxisFrame axis_frame(float origin, float size, float other_size, const PixelRange& pixels,
                     int samples) {
  AxisFrame axis;
  axis.origin = origin;
  axis.size = size;
  axis.direction = size > 0 ? 1 : -1;
  axis.scale = axis.direction * std::abs(double{other_size});
  axis.shift = 2 * double{origin} + double{size};
  axis.is_exact = is_coarse(origin) && is_coarse(size) && is_coarse(other_size);
  // Twice a sample's position is an odd number of pixels if the centre is the only sample, and
  // otherwise a multiple of 1/8.
  const int position_grain = samples == 1 ? 0 : -3;
  if (axis.is_exact) {
    axis.grain = std::min(position_grain, lowest_bit(axis.shift)) + lowest_bit(axis.scale);
  } else {
    // The shift, the difference and the product have a relative rounding error of 2^-53 each.
    axis.error = std::abs(axis.scale) * 0x1p-51 * (std::abs(axis.shift) + 2.0 * pixels.end);
  }
  const double ends = std::max(std::abs(axis.at(pixels.begin)), std::abs(axis.at(pixels.end)));
  axis.greatest = ends * (1 + 0x1p-50) + axis.error;
  return axis;
}

}  // namespace

int lowest_bit(double value) {
  constexpr int kFractionBits = 52;
  if (value == 0) return std::numeric_limits<int>::max() / 4;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << kFractionBits) - 1);
  const int exponent = std::ilogb(value);
  return fraction == 0 ? exponent : exponent - kFractionBits + std::countr_zero(fraction);
}

SampleFrame sample_frame(const State& state, const DrawBounds& bounds, int samples) {
  const Viewport& viewport = state.viewport;
  SampleFrame frame;
  frame.u =
      axis_frame(viewport.origin.x, viewport.size.x, viewport.size.y, bounds.columns, samples);
  frame.v = axis_frame(viewport.origin.y, viewport.size.y, viewport.size.x, bounds.rows, samples);
  if (state.convention == Convention::d3d) {
    frame.v.scale = -frame.v.scale;
    frame.v.direction = -frame.v.direction;
  }
  frame.t = std::abs(double{viewport.size.x} * double{viewport.size.y});
  return frame;
}

ExactCoordinate exact_at(const AxisFrame& axis, double position) {
  if (axis.is_exact) return {{2 * position - axis.shift, 0, 0}, 1, axis.scale};
  return {{2 * position, -2 * double{axis.origin}, -double{axis.size}}, 3, axis.scale};
}

}  // namespace rastercheck::rasterizer
