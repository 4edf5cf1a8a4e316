#include "rasterizer/internal/grid_position.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

/// N in double, with an error bound. The three products are exact, as 24 + 24 <= 53 bits. Each of
/// the two sums has an error of at most 2^-53 times the sum of the magnitudes. Twice this bound
/// also covers the rounding of the magnitudes.
struct Approximate {
  double value = 0;
  double error = 0;
};

Approximate approximate_numerator(const GridAxis& axis, float coordinate, float w) {
  const double along = axis.slope * coordinate;
  const double origin = axis.origin * w;
  const double size = axis.size * w;
  return {along + origin + size, 0x1p-51 * (std::abs(along) + std::abs(origin) + std::abs(size))};
}

/// The sign of N − bound · w.
int compare(const GridAxis& axis, float coordinate, float w, double bound) {
  const Approximate n = approximate_numerator(axis, coordinate, w);
  const double difference = n.value - bound * w;
  if (std::abs(difference) > n.error + 0x1p-51 * std::abs(bound * w)) {
    return difference > 0 ? 1 : -1;
  }
  ExactSum sum;
  add_window_numerator(sum, axis, coordinate, w, 1);
  sum.add_product(-bound, w);
  return sum.sign();
}

bool is_within(const GridAxis& axis, float coordinate, float w) {
  constexpr double kTwice = 2.0 * kGuardBand;
  return compare(axis, coordinate, w, kTwice) <= 0 && compare(axis, coordinate, w, -kTwice) >= 0;
}

/// The sign of N 2^b − k w, where 2^b = 2 half_units.
int compare_exactly(const GridAxis& axis, float coordinate, float w, double half_units, double k) {
  ExactSum sum;
  add_window_numerator(sum, axis, coordinate, w, 2 * half_units);
  sum.add_product(-k, w);
  return sum.sign();
}

/// The grid point that a position is rounded to, in units of 2^-b pixels.
std::int64_t rounded_point(const GridAxis& axis, const Snapping& snapping, float coordinate,
                           float w) {
  // Grid units per unit of N / w, which is twice the position in pixels.
  const double half_units = std::ldexp(1.0, snapping.subpixel_bits - 1);
  Approximate n = approximate_numerator(axis, coordinate, w);
  if (n.error * half_units > 0.125 * double{w}) {  // the terms cancel
    ExactSum sum;
    add_window_numerator(sum, axis, coordinate, w, 1);
    n.value = sum.nearest();
    n.error = 0x1p-51 * std::abs(n.value);
  }
  const double position = n.value / w * half_units;
  // The division also rounds, by less than 2^-20, because positions are below 2^32.
  const double error = n.error / w * half_units + 0x1p-20;
  if (snapping.rounding == Rounding::floor) {
    const double nearest = std::round(position);
    const bool is_close = std::abs(position - nearest) <= error;
    if (!is_close) return static_cast<std::int64_t>(std::floor(position));
    const bool is_below = compare_exactly(axis, coordinate, w, half_units, 2 * nearest) < 0;
    return static_cast<std::int64_t>(nearest) - (is_below ? 1 : 0);
  }
  const double below = std::floor(position);
  const double rest = position - below;
  const auto point = static_cast<std::int64_t>(below);
  if (rest < 0.5 - error) return point;
  if (rest > 0.5 + error) return point + 1;

  const int side = compare_exactly(axis, coordinate, w, half_units, 2 * below + 1);
  if (side == 0) return tie_point(snapping.rounding, point);
  return side > 0 ? point + 1 : point;
}

std::int64_t snapped(const Grid& grid, const GridAxis& axis, float coordinate, float w) {
  return rounded_point(axis, grid.snapping, coordinate, w)
         << (grid.unit_bits - grid.snapping.subpixel_bits);
}

}  // namespace

int unit_bits(const Snapping& snapping) {
  constexpr int kPatternBits = 4;
  return std::max(snapping.subpixel_bits, kPatternBits);
}

std::int64_t tie_point(Rounding rounding, std::int64_t below) {
  return rounding == Rounding::nearest_even && below % 2 == 0 ? below : below + 1;
}

std::array<GridAxis, 2> window_axes(const State& state) {
  const auto& [origin, size, min_depth, max_depth] = state.viewport;
  const double up = state.convention == Convention::d3d ? -1 : 1;
  return {GridAxis{size.x, 2 * double{origin.x}, size.x},
          GridAxis{up * size.y, 2 * double{origin.y}, size.y}};
}

Grid grid_of(const State& state) {
  Grid grid;
  grid.snapping = *state.snapping;
  grid.unit_bits = unit_bits(grid.snapping);
  const auto [x, y] = window_axes(state);
  grid.x = x;
  grid.y = y;
  return grid;
}

void add_window_numerator(ExactSum& sum, const GridAxis& axis, float coordinate, float w,
                          double factor) {
  // A product of two floats is exact in double; a product with a third factor need not be.
  const auto add = [&sum, factor](double a, double b) {
    const double product = a * b;
    sum.add_product(product, factor);
  };
  add(axis.slope, coordinate);
  add(axis.origin, w);
  add(axis.size, w);
}

bool is_within_guard_band(const Grid& grid, const glm::vec4& position) {
  return position.w > 0 && is_within(grid.x, position.x, position.w) &&
         is_within(grid.y, position.y, position.w);
}

GridPoint snapped(const Grid& grid, const glm::vec4& position) {
  return {snapped(grid, grid.x, position.x, position.w),
          snapped(grid, grid.y, position.y, position.w)};
}

}  // namespace rastercheck::rasterizer
