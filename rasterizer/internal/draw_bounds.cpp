#include "rasterizer/internal/draw_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "rasterizer/internal/exact_sum.h"

namespace rastercheck::rasterizer {
namespace {

/// Clamps `value` to the range. `value` must be whole, infinite or NaN; NaN gives range.begin.
int held_to(const PixelRange& range, double value) {
  if (!(value > range.begin)) return range.begin;
  if (value >= range.end) return range.end;
  return static_cast<int>(value);
}

/// `origin + size`, rounded up to a double. So comparing a double with the result (<, >=) gives the
/// same answer as comparing it with the exact sum.
double far_side(double origin, double size) {
  const TwoSum sum(origin, size);
  return sum.error > 0 ? std::nextafter(sum.sum, std::numeric_limits<double>::infinity()) : sum.sum;
}

/// The exact sum of two floats' doubles.
struct Side {
  Side(double origin, double size) : sum(origin, size) {}

  // The sum is a whole number just where the rounded sum is and no error is left; an error never
  // carries it across a whole number that the rounded sum is not.
  double floor() const {
    const double below = std::floor(sum.sum);
    return below == sum.sum && sum.error < 0 ? below - 1 : below;
  }
  double ceil() const {
    const double above = std::ceil(sum.sum);
    return above == sum.sum && sum.error > 0 ? above + 1 : above;
  }
  TwoSum sum;
};

/// The pixels i of `range` whose open square (i, i + 1) meets the viewport along an axis, and those
/// that lie in it.
void set_pixels(const PixelRange& range, float origin, float size, PixelRange& met,
                PixelRange& whole) {
  const Side first(origin, 0);
  const Side second(origin, size);
  const Side& low = size < 0 ? second : first;
  const Side& high = size < 0 ? first : second;
  met = {held_to(range, low.floor()), held_to(range, high.ceil())};
  whole = {held_to(range, low.ceil()), held_to(range, high.floor())};
}

PixelRange scissored(int target, int origin, int size) {
  const std::int64_t end = std::int64_t{origin} + size;
  return {std::clamp(origin, 0, target),
          static_cast<int>(std::clamp(end, std::int64_t{0}, std::int64_t{target}))};
}

}  // namespace

PixelRange intersection(const PixelRange& a, const PixelRange& b) {
  return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
}

PixelRange pixels_from_to(const PixelRange& range, double offset, double low, double high) {
  return {held_to(range, std::ceil(low - offset)), held_to(range, std::ceil(high - offset))};
}

PixelRange pixels_from_through(const PixelRange& range, double offset, double low, double high) {
  return {held_to(range, std::ceil(low - offset)), held_to(range, std::floor(high - offset) + 1)};
}

DrawBounds draw_bounds(const State& state, const TargetSize& size) {
  DrawBounds bounds;
  bounds.columns = scissored(size.width, state.scissor.origin.x, state.scissor.size.x);
  bounds.rows = scissored(size.height, state.scissor.origin.y, state.scissor.size.y);

  if (state.primitive != Primitive::triangles) {  // the viewport cuts what they are around
    bounds.sample_columns.fill(bounds.columns);
    bounds.sample_rows.fill(bounds.rows);
    return bounds;
  }
  if (state.conservative != Conservative::off) {
    const auto& [origin, extent, min_depth, max_depth] = state.viewport;
    PixelRange columns;
    PixelRange rows;
    set_pixels(bounds.columns, origin.x, extent.x, columns, bounds.whole_columns);
    set_pixels(bounds.rows, origin.y, extent.y, rows, bounds.whole_rows);
    const bool is_outer = state.conservative == Conservative::outer;
    bounds.sample_columns.fill(is_outer ? columns : bounds.whole_columns);
    bounds.sample_rows.fill(is_outer ? rows : bounds.whole_rows);
    return bounds;
  }
  const double x0 = state.viewport.origin.x;
  const double y0 = state.viewport.origin.y;
  const double x1 = far_side(x0, state.viewport.size.x);
  const double y1 = far_side(y0, state.viewport.size.y);
  const std::span<const SampleOffset> pattern = standard_pattern(size.samples);
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    bounds.sample_columns[i] =
        pixels_from_to(bounds.columns, pattern[i].x, std::min(x0, x1), std::max(x0, x1));
    bounds.sample_rows[i] =
        pixels_from_to(bounds.rows, pattern[i].y, std::min(y0, y1), std::max(y0, y1));
  }
  return bounds;
}

DrawBounds draw_bounds_of_window(const State& state, const TargetSize& size) {
  State whole = state;
  whole.scissor = {{0, 0}, {kMaxSize, kMaxSize}};
  return draw_bounds(whole, size);
}

}  // namespace rastercheck::rasterizer
