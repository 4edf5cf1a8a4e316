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

namespace {

using cases::Rounding;

bool is_to_nearest(Rounding rounding) {
  return rounding == Rounding::nearest_even || rounding == Rounding::half_up ||
         rounding == Rounding::half_down;
}

/// The grid coordinate of a position in grid units, by a rounding that names one.
long rounded(const Field& value, Rounding rounding) {
  switch (rounding) {
    case Rounding::nearest_even:
      return nearest_even(value);
    case Rounding::half_up:
      return floor_to_long(value + one_half());
    case Rounding::half_down:
      return ceil_to_long(value - one_half());
    case Rounding::ceil:
      return ceil_to_long(value);
    case Rounding::toward_zero:
      return sign_of(value) < 0 ? ceil_to_long(value) : floor_to_long(value);
    case Rounding::floor:
    case Rounding::unspecified:
      break;
  }
  return floor_to_long(value);
}

}  // namespace

Ring candidate_radius(const cases::Snapping& snapping) {
  return Ring(snapping.rounding_reach()) + exact_ring(snapping.position_error);
}

GridRange candidates(const Field& coordinate, const cases::Snapping& snapping, std::size_t axis) {
  const Rounding rounding = snapping.rounding_along(axis);
  const Field in_units = coordinate * Field(snapping.steps());
  const Field error(exact_ring(snapping.position_error));
  if (rounding == Rounding::unspecified) {
    const Field radius = Field(1) + error;
    return {floor_to_long(in_units - radius) + 1, ceil_to_long(in_units + radius) - 1};
  }
  if (snapping.position_error > 0 && is_to_nearest(rounding)) {
    const Field radius = one_half() + error;
    return {ceil_to_long(in_units - radius), floor_to_long(in_units + radius)};
  }
  return {rounded(in_units - error, rounding), rounded(in_units + error, rounding)};
}

Ring window_of(long coordinate, double unit) { return {static_cast<double>(coordinate) * unit}; }

namespace {

/// The floor of all numbers within `slack` of `value`; empty if their floors differ.
std::optional<long> certain_floor(double value, double slack) {
  const double below = std::floor(value - slack);
  if (below != std::floor(value + slack) || !(std::abs(below) < 0x1p62)) return std::nullopt;
  return static_cast<long>(below);
}

/// rounded() of all numbers within `slack` of `value`; empty if doubles leave it uncertain, as they
/// do for halves and for grid points.
std::optional<long> certain_rounded(double value, double slack, Rounding rounding) {
  // All roundings to the nearest are the floor of the number plus a half.
  if (is_to_nearest(rounding)) return certain_floor(value + 0.5, slack);
  const std::optional<long> below = certain_floor(value, slack);
  if (!below) return std::nullopt;
  // The number is no integer, so it lies between `below` and the next one.
  const bool goes_up =
      rounding == Rounding::ceil || (rounding == Rounding::toward_zero && *below < 0);
  return goes_up ? *below + 1 : *below;
}

/// candidates() of numerator/w, w > 0, computed in doubles; empty if doubles leave the range
/// uncertain.
std::optional<GridRange> near_candidates(const Ring& numerator, const Ring& w,
                                         const cases::Snapping& snapping, std::size_t axis) {
  const double near_numerator = near_double(numerator);
  const double near_w = near_double(w);
  if (!has_normal_products(near_numerator, numerator) || !has_normal_products(near_w, w)) {
    return std::nullopt;
  }
  const Rounding rounding = snapping.rounding_along(axis);
  const double in_units = near_numerator / near_w * snapping.steps();
  const double error{snapping.position_error};
  // The numerator and w are off by 2^-51 relative each; the quotient, the product, the error and
  // the sum add as much again.
  const double slack = (std::abs(in_units) + error + 1) * 0x1p-48;
  const bool is_range = rounding == Rounding::unspecified || (error > 0 && is_to_nearest(rounding));
  if (!is_range) {
    const std::optional<long> first = certain_rounded(in_units - error, slack, rounding);
    const std::optional<long> last = certain_rounded(in_units + error, slack, rounding);
    if (!first || !last) return std::nullopt;
    return GridRange{*first, *last};
  }
  const double radius = error + (rounding == Rounding::unspecified ? 1 : 0.5);
  const std::optional<long> below = certain_floor(in_units - radius, slack);
  const std::optional<long> last = certain_floor(in_units + radius, slack);
  if (!below || !last) return std::nullopt;
  // Neither end is an integer, so it does not matter whether the range is closed.
  return GridRange{*below + 1, *last};
}

GridRange candidates_of(const Ring& numerator, const Ring& w, const cases::Snapping& snapping,
                        std::size_t axis) {
  const std::optional<GridRange> near = near_candidates(numerator, w, snapping, axis);
  return near ? *near : candidates(quotient(numerator, w), snapping, axis);
}

}  // namespace

SnappedVertex snap(const RingVector3& window_column, const cases::Snapping& snapping,
                   const Ring& units_per_pixel) {
  const Ring& w = window_column[2];
  const Ring per_pixel = units_per_pixel * w;
  return {candidates_of(window_column[0], per_pixel, snapping, 0),
          candidates_of(window_column[1], per_pixel, snapping, 1), w};
}

std::vector<std::array<double, 2>> placed_points(const SnappedVertex& vertex, double unit,
                                                 bool corners_only) {
  const auto step = [corners_only](const GridRange& range) {
    return corners_only ? std::max(range.count() - 1, 1L) : 1L;
  };
  std::vector<std::array<double, 2>> points;
  for (long y = vertex.y.first; y <= vertex.y.last; y += step(vertex.y)) {
    for (long x = vertex.x.first; x <= vertex.x.last; x += step(vertex.x)) {
      points.push_back({static_cast<double>(x) * unit, static_cast<double>(y) * unit});
    }
  }
  return points;
}

std::vector<RingVector3> placed_columns(const SnappedVertex& vertex, double unit,
                                        bool corners_only) {
  std::vector<RingVector3> columns;
  for (const auto& [x, y] : placed_points(vertex, unit, corners_only)) {
    columns.emplace_back(Ring(x) * vertex.w, Ring(y) * vertex.w, vertex.w);
  }
  return columns;
}

}  // namespace rastercheck::oracle
