#include "oracle/internal/snapping.h"

#include <cmath>
#include <optional>

namespace rastercheck::oracle {
namespace {

const Field& one_half() {
  static const Field kHalf(1, 2);
  return kHalf;
}

long nearest_even(const Field& value) {
  const long below = floor_to_long(value);
  const Field rest = value - Field(below);
  if (rest < one_half()) return below;
  if (rest > one_half()) return below + 1;
  return below % 2 == 0 ? below : below + 1;
}

}  // namespace

Ring candidate_radius(const cases::Snapping& snapping) {
  const Ring rounding(snapping.rounding == cases::Rounding::unspecified ? 1.0 : 0.5);
  return rounding + exact_ring(snapping.position_error);
}

GridRange candidates(const Field& coordinate, const cases::Snapping& snapping) {
  const Field in_units = coordinate * power_of_two(snapping.subpixel_bits);
  const Field radius(candidate_radius(snapping));
  if (snapping.rounding == cases::Rounding::unspecified) {
    return {floor_to_long(in_units - radius) + 1, ceil_to_long(in_units + radius) - 1};
  }
  if (snapping.position_error > 0) {
    return {ceil_to_long(in_units - radius), floor_to_long(in_units + radius)};
  }
  const long rounded = snapping.rounding == cases::Rounding::nearest_even
                           ? nearest_even(in_units)
                           : floor_to_long(in_units + one_half());
  return {rounded, rounded};
}

Ring pixels_of(long coordinate, int subpixel_bits) {
  // Below 2^53 (a guard band of 2^15 pixels at 16 bits), so this is exact.
  return {std::ldexp(static_cast<double>(coordinate), -subpixel_bits)};
}

namespace {

/// The floor of all numbers within `slack` of `value`; empty if their floors differ.
std::optional<long> certain_floor(double value, double slack) {
  const double below = std::floor(value - slack);
  if (below != std::floor(value + slack) || !(std::abs(below) < 0x1p62)) return std::nullopt;
  return static_cast<long>(below);
}

/// candidates() of numerator/w, w > 0, computed in doubles; empty if doubles leave the range
/// uncertain.
std::optional<GridRange> near_candidates(const Ring& numerator, const Ring& w,
                                         const cases::Snapping& snapping) {
  const double near_numerator = near_double(numerator);
  const double near_w = near_double(w);
  if (!has_normal_products(near_numerator, numerator) || !has_normal_products(near_w, w)) {
    return std::nullopt;
  }
  const double in_units = std::ldexp(near_numerator / near_w, snapping.subpixel_bits);
  const double radius = near_double(candidate_radius(snapping));
  // The numerator and w are off by 2^-51 relative each; the quotient, the radius and their sum add
  // as much again.
  const double slack = (std::abs(in_units) + radius) * 0x1p-48;
  const bool is_single =
      snapping.rounding != cases::Rounding::unspecified && snapping.position_error == 0;
  if (is_single) {
    // Ties are never certain here. For all other numbers, both roundings to nearest are the floor
    // of the number plus a half.
    const std::optional<long> rounded = certain_floor(in_units + 0.5, slack);
    if (!rounded) return std::nullopt;
    return GridRange{*rounded, *rounded};
  }
  const std::optional<long> below = certain_floor(in_units - radius, slack);
  const std::optional<long> last = certain_floor(in_units + radius, slack);
  if (!below || !last) return std::nullopt;
  // Neither end is an integer, so it does not matter whether the range is closed.
  return GridRange{*below + 1, *last};
}

GridRange candidates_of(const Ring& numerator, const Ring& w, const cases::Snapping& snapping) {
  const std::optional<GridRange> near = near_candidates(numerator, w, snapping);
  return near ? *near : candidates(quotient(numerator, w), snapping);
}

}  // namespace

SnappedVertex snap(const RingVector3& window_column, const cases::Snapping& snapping) {
  const Ring& w = window_column[2];
  return {candidates_of(window_column[0], w, snapping),
          candidates_of(window_column[1], w, snapping), w};
}

std::vector<std::array<double, 2>> placed_points(const SnappedVertex& vertex, int subpixel_bits,
                                                 bool corners_only) {
  const auto step = [corners_only](const GridRange& range) {
    return corners_only ? std::max(range.count() - 1, 1L) : 1L;
  };
  std::vector<std::array<double, 2>> points;
  for (long y = vertex.y.first; y <= vertex.y.last; y += step(vertex.y)) {
    for (long x = vertex.x.first; x <= vertex.x.last; x += step(vertex.x)) {
      points.push_back({std::ldexp(static_cast<double>(x), -subpixel_bits),
                        std::ldexp(static_cast<double>(y), -subpixel_bits)});
    }
  }
  return points;
}

std::vector<RingVector3> placed_columns(const SnappedVertex& vertex, int subpixel_bits,
                                        bool corners_only) {
  std::vector<RingVector3> columns;
  for (const auto& [x, y] : placed_points(vertex, subpixel_bits, corners_only)) {
    columns.emplace_back(Ring(x) * vertex.w, Ring(y) * vertex.w, vertex.w);
  }
  return columns;
}

}  // namespace rastercheck::oracle
