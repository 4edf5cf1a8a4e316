#include "oracle/internal/snapping.h"

#include <cmath>

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

SnappedVertex snap(const RingVector3& window_column, const cases::Snapping& snapping) {
  const Ring& w = window_column[2];
  return {candidates(quotient(window_column[0], w), snapping),
          candidates(quotient(window_column[1], w), snapping), w};
}

std::vector<RingVector3> placed_columns(const SnappedVertex& vertex, int subpixel_bits,
                                        bool corners_only) {
  const auto step = [corners_only](const GridRange& range) {
    return corners_only ? std::max(range.count() - 1, 1L) : 1L;
  };
  std::vector<RingVector3> columns;
  for (long y = vertex.y.first; y <= vertex.y.last; y += step(vertex.y)) {
    for (long x = vertex.x.first; x <= vertex.x.last; x += step(vertex.x)) {
      columns.emplace_back(pixels_of(x, subpixel_bits) * vertex.w,
                           pixels_of(y, subpixel_bits) * vertex.w, vertex.w);
    }
  }
  return columns;
}

std::vector<ProjectiveMap> placed_maps(const std::array<std::vector<RingVector3>, 3>& columns) {
  std::vector<ProjectiveMap> maps;
  maps.reserve(columns[0].size() * columns[1].size() * columns[2].size());
  for (const RingVector3& first : columns[0]) {
    for (const RingVector3& second : columns[1]) {
      for (const RingVector3& third : columns[2]) {
        maps.emplace_back(std::array{first, second, third});
      }
    }
  }
  return maps;
}

}  // namespace rastercheck::oracle
