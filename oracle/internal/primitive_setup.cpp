// What is set up of lines and points alone (triangle_setup.h).

#include <cmath>
#include <optional>

#include "oracle/internal/diamond_line.h"
#include "oracle/internal/triangle_setup.h"

namespace rastercheck::oracle {

ProjectiveMap TriangleSetup::map_of(const std::array<RingVector3, 3>& at) const {
  const cases::Case& source = scene->source();
  switch (source.primitive) {
    case cases::Primitive::triangles:
      return ProjectiveMap(at);
    case cases::Primitive::lines:
      return ProjectiveMap::of_line(at[0], at[1],
                                    source.line_mode == cases::LineMode::parallelogram);
    case cases::Primitive::points:
      break;
  }
  return ProjectiveMap::of_point(at[0]);
}

Ring TriangleSetup::primitive_size() const {
  const cases::Case& source = scene->source();
  const bool is_line = source.primitive == cases::Primitive::lines;
  return exact_ring(is_line ? source.line_width : source.point_size) * scene->units_per_pixel();
}

namespace {

/// How far any point that a line covers may move, at most, if its ends move by up to `reach` along
/// each axis. `width` is the line's, `length` at most the distance between its ends.
///
/// Let ρ = √2 reach be the largest move of an end, and û, û' the directions before and after. As
/// |û' − û| <= 2 |e| / (L + L') for a difference e of the two ends' moves (Dunkl & Williams 1964,
/// in an inner product space), |e| <= 2ρ and L' >= L − 2ρ, it is at most 2ρ/(L − ρ). A point of the
/// line is a mean of its ends and at most width/2 beside it, so it moves by at most
/// ρ + width ρ/(L − ρ). Covered samples are those of a convex set each of whose points moves by no
/// more than that.
///
/// Empty if nothing bounds it, because the ends may meet.
std::optional<double> moved_line_reach(double reach, double width, double length) {
  const double end = reach * 1.4142136;  // more than √2
  if (!(length > 2 * end)) return std::nullopt;
  // The factor is more than the roundings above and here.
  return (end + width * end / (length - end)) * (1 + 0x1p-40);
}

}  // namespace

/// moved_line_reach() for ends that move by up to `vertex_reach`; empty if nothing bounds it, or if
/// the line is one of Bresenham's, whose pixels may change altogether.
std::optional<Ring> TriangleSetup::reach_of_line(double vertex_reach) const {
  const cases::LineMode mode = scene->source().line_mode;
  if (mode == cases::LineMode::bresenham) return std::nullopt;
  const auto& [w, u, v] = near_positions();
  const double du = std::abs(u[1] - u[0]);
  const double dv = std::abs(v[1] - v[0]);
  // More than these differences are off, of positions that are known to within 2^-48 relative.
  const double off = (std::abs(u[0]) + std::abs(u[1]) + std::abs(v[0]) + std::abs(v[1])) * 0x1p-46;
  const double width = primitive_size().to_interval().second;
  std::optional<double> moved = moved_line_reach(vertex_reach, width, std::hypot(du, dv) - 4 * off);
  if (!moved) return std::nullopt;
  // If either axis may be the major one, a parallelogram may be either of two.
  const bool may_turn_over = std::abs(du - dv) <= 4 * vertex_reach + 2 * off;
  if (mode == cases::LineMode::parallelogram && may_turn_over) *moved += width;
  return Ring(*moved);
}

const DiamondLine& TriangleSetup::diamond_line() const {
  if (!diamond_line_) diamond_line_ = std::make_shared<const DiamondLine>(*this);
  return *diamond_line_;
}

std::array<RingVector3, 3> TriangleSetup::placed_columns_of_all() const {
  std::array<RingVector3, 3> all;
  for (std::size_t i = 0; i < 3; ++i) {
    all[i] = placed_columns(*snapped[i], scene->grid_unit(), true).front();
  }
  return all;
}

}  // namespace rastercheck::oracle
