// The first level of the cascade for lines and points: the borders of what they cover, as lines
// with bands, inside all of which a sample is required and outside one of which it is forbidden.

#include <algorithm>
#include <cmath>

#include "oracle/internal/primitive_coverage.h"
#include "oracle/internal/triangle_filter.h"

namespace rastercheck::oracle {
namespace {

bool is_point(const TriangleSetup& primitive) {
  return primitive.scene->source().primitive == cases::Primitive::points;
}

/// The vertices' columns where the contract places them or, if it leaves that open, as given.
std::array<RingVector3, 3> columns_of(const TriangleSetup& primitive) {
  return primitive.shape == Shape::placed ? primitive.placed_columns_of_all() : primitive.columns;
}

/// The four sides of the square around a vertex: size w ± 2 (u w − X) and likewise for v.
std::array<Line, 4> sides_of_square(const RingVector3& column, const Ring& size) {
  const Ring& w = column[2];
  const Ring two_w = Ring(2) * w;
  const auto side = [&](const Ring& at, int sign) { return size * w - Ring(2 * sign) * at; };
  return {Line{two_w, Ring(0), side(column[0], 1)}, Line{-two_w, Ring(0), side(column[0], -1)},
          Line{Ring(0), two_w, side(column[1], 1)}, Line{Ring(0), -two_w, side(column[1], -1)}};
}

/// Twice the middle's functional, whose value is twice the distance from it times |d| (or along
/// the minor axis times d's longer part), and the direction d.
struct Middle {
  Line twice;
  std::array<Ring, 2> direction;
};

Middle middle_of(const std::array<RingVector3, 3>& at) {
  const RingVector3 row = at[0].cross(at[1]);
  const Ring two(2);
  return {{two * row[0], two * row[1], two * row[2]}, direction_of(at[0], at[1])};
}

/// |d| in double, and how far it may be off.
struct NearLength {
  double value = 0;
  double error = 0;
};

NearLength length_of(const std::array<Ring, 2>& direction) {
  const double length = std::hypot(near_double(direction[0]), near_double(direction[1]));
  return {length, length * 0x1p-40};
}

/// Whether all planes and sides leave the whole of a line, so that they decide no sample.
bool is_whole(const TriangleSetup& line) {
  if (line.shape != Shape::exact) return true;  // nothing is promised of others
  return sign_of(line.columns[0][2]) > 0 && sign_of(line.columns[1][2]) > 0 && !is_cut(line);
}

}  // namespace

void TriangleFilter::add_primitive_lines() {
  const TriangleSetup& primitive = *triangle_;
  if (primitive.is_left_out || has_no_area(*primitive.scene)) return;
  inner_ = primitive.scene->target_pixels();
  const Ring moved = primitive.shape == Shape::cut ? primitive.reach : Ring(0);
  const std::array<RingVector3, 3> at = columns_of(primitive);
  const Ring size = primitive.primitive_size();
  bool is_filtered = true;
  const auto add_moved = [&](const Line& line) {
    is_filtered = is_filtered && add(line, band_of(line, moved));
  };
  if (is_point(primitive)) {
    if (is_dropped(primitive)) return;
    for (const Line& side : sides_of_square(at[0], size)) add_moved(side);
  } else {
    is_filtered = add_lines_of_line(at, size, moved);
  }
  if (!is_filtered) lines_.clear();
}

/// False if the line's borders cannot be given in double.
bool TriangleFilter::add_lines_of_line(const std::array<RingVector3, 3>& at, const Ring& width,
                                       const Ring& moved) {
  const TriangleSetup& line = *triangle_;
  const ProjectiveMap& map = line.shape == Shape::placed ? line.corner(0) : line.ideal;
  if (map.orientation() == 0) return false;
  const cases::LineMode mode = line.scene->source().line_mode;
  const bool is_bresenham = mode == cases::LineMode::bresenham;
  const Middle middle = middle_of(at);
  const Ring along = magnitude(middle.direction[major_axis(middle.direction)]);
  // The value of the side's functional on the middle, and how much of that is uncertain.
  Ring limit = width * along;
  Ring margin(0);
  Ring beyond_ends = moved;
  if (mode == cases::LineMode::rectangular) {
    const NearLength length = length_of(middle.direction);
    if (!std::isfinite(length.value)) return false;
    limit = width * Ring(length.value);
    margin = width * Ring(length.error);
  } else if (is_bresenham) {
    // Pixels that are replicated for the width, and those that the line meets beside its middle.
    limit = (width + Ring(4) * line.scene->units_per_pixel()) * along;
    beyond_ends = width + Ring(4) * line.scene->units_per_pixel();
  }
  const bool is_all = is_whole(line);
  if (is_bresenham || !is_all) inner_ = {0, 0, 0, 0};  // such pixels are never required here
  bool is_filtered = true;
  for (const int sign : {1, -1}) {
    const Ring turn(sign);
    const Line side{turn * middle.twice.a, turn * middle.twice.b, limit + turn * middle.twice.c};
    is_filtered = is_filtered && add(side, margin + band_of(side, moved));
  }
  // Where a part of one of Bresenham's lines is clipped away, it says more than its ends.
  if (is_bresenham && !is_all) return is_filtered;
  for (std::size_t end = 0; end < 2; ++end) {
    is_filtered = is_filtered && add(map.edge(end), band_of(map.edge(end), beyond_ends));
  }
  return is_filtered;
}

}  // namespace rastercheck::oracle
