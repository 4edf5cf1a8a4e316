#include "oracle/internal/primitive_coverage.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "oracle/internal/diamond_exit.h"
#include "oracle/internal/membership.h"

namespace rastercheck::oracle {
namespace {

using records::Reason;
using records::SampleVerdict;
using records::Verdict;
using Columns = std::array<RingVector3, 3>;

/// The values, at the vertices and times w, of the functionals that are zero on the viewport's
/// sides and positive between them.
std::array<std::array<Ring, 3>, 4> values_at_sides(const TriangleSetup& primitive) {
  const Point& lo = primitive.scene->viewport_lo();
  const Point& hi = primitive.scene->viewport_hi();
  std::array<std::array<Ring, 3>, 4> all;
  for (std::size_t i = 0; i < 3; ++i) {
    const RingVector3& column = primitive.columns[i];
    all[0][i] = column[0] - lo.u * column[2];
    all[1][i] = hi.u * column[2] - column[0];
    all[2][i] = column[1] - lo.v * column[2];
    all[3][i] = hi.v * column[2] - column[1];
  }
  return all;
}

// --- Points --------------------------------------------------------------------------------------

/// True if a point's vertex lies beyond a clip plane, a clip distance or a side of the viewport, or
/// behind the eye. On a plane it is inside.
bool is_dropped(const TriangleSetup& point) {
  if (sign_of(point.columns[0][2]) <= 0) return true;
  const auto is_beyond = [](const std::array<Ring, 3>& values) { return sign_of(values[0]) < 0; };
  const auto planes = point.clip_values();
  const auto sides = values_at_sides(point);
  return std::any_of(planes.begin(), planes.end(), is_beyond) ||
         std::any_of(sides.begin(), sides.end(), is_beyond);
}

/// Whether p lies in the square around a vertex.
Membership in_square(const RingVector3& column, const Ring& size, const Point& p,
                     const Scene& scene) {
  const Ring& w = column[2];
  const Ring two(2);
  Membership all;
  for (const int sign : {1, -1}) {
    const Ring s(sign);
    // size/2 + sign (u − x) >= 0, times 2 w
    all &= side(sign_of(size * w + two * s * (p.u * w - column[0])), sign, 0, scene);
    all &= side(sign_of(size * w + two * s * (p.v * w - column[1])), 0, sign, scene);
  }
  return all;
}

SampleVerdict verdict_of(const Membership& all) {
  if (!all.possible) return {Verdict::forbidden, Reason::outside};
  if (!all.sure) return {Verdict::permitted, all.tie ? Reason::tie : Reason::snapping};
  return {Verdict::required, all.tie ? Reason::tie : Reason::inside};
}

/// What is so in some, or in every one, of several readings.
void take_reading(Membership& over_all, const Membership& one) {
  over_all.possible = over_all.possible || one.possible;
  over_all.sure = over_all.sure && one.sure;
  over_all.tie = over_all.tie || one.tie;
}

/// Over all positions up to `moved` away along each axis. A position between two others, along an
/// axis, covers what both cover.
Membership over_moves(const RingVector3& column, const Ring& moved, const Ring& size,
                      const Point& p, const Scene& scene) {
  Membership over_all{.possible = false, .sure = true};
  for (const int along_u : {-1, 1}) {
    for (const int along_v : {-1, 1}) {
      RingVector3 there = column;
      there[0] += Ring(along_u) * moved * column[2];
      there[1] += Ring(along_v) * moved * column[2];
      take_reading(over_all, in_square(there, size, p, scene));
    }
  }
  over_all.possible = in_square(column, size + Ring(2) * moved, p, scene).possible;
  return over_all;
}

/// Over the grid points that the vertex may be placed on and, unless the contract has vertices on
/// the grid, what lies between them.
Membership over_grid_points(const TriangleSetup& point, const Point& p) {
  const Scene& scene = *point.scene;
  const SnappedVertex& vertex = *point.snapped[0];
  const double unit = scene.grid_unit();
  const Ring size = point.primitive_size();
  const bool are_all = scene.contract().is_on_grid && vertex.placements() <= kMostPlacements;
  const std::vector<RingVector3> columns = placed_columns(vertex, unit, !are_all);
  Membership over_all{.possible = false, .sure = true};
  for (const RingVector3& column : columns) {
    take_reading(over_all, in_square(column, size, p, scene));
  }
  if (are_all) return over_all;
  const auto is_between = [&](const Ring& at, const GridRange& range) {
    const Ring twice = Ring(2) * at;
    return twice >= Ring(2) * window_of(range.first, unit) - size &&
           twice <= Ring(2) * window_of(range.last, unit) + size;
  };
  over_all.possible = is_between(p.u, vertex.x) && is_between(p.v, vertex.y);
  return over_all;
}

SampleVerdict decide_point_primitive(const TriangleSetup& point, const Point& p) {
  if (is_dropped(point)) return {Verdict::forbidden, Reason::clipped};
  const Scene& scene = *point.scene;
  const Ring size = point.primitive_size();
  if (point.shape == Shape::exact) {
    return verdict_of(in_square(point.columns[0], size, p, scene));
  }
  if (point.shape == Shape::placed) {
    return verdict_of(in_square(point.placed_columns_of_all()[0], size, p, scene));
  }
  if (point.is_whole) return verdict_of(over_grid_points(point, p));
  return verdict_of(over_moves(point.columns[0], point.reach, size, p, scene));
}

// --- Lines ---------------------------------------------------------------------------------------

/// What a line covers before anything is clipped, as a set of samples: a rectangle or a
/// parallelogram.
class LineBody {
 public:
  /// `width` in window units.
  LineBody(const Columns& at, const ProjectiveMap& map, const Ring& width, cases::LineMode mode)
      : map_(&map), width_(width), is_rectangular_(mode == cases::LineMode::rectangular) {
    const RingVector3 row = at[0].cross(at[1]);
    middle_ = {row[0], row[1], row[2]};
    const auto direction = direction_of(at[0], at[1]);
    along_ = magnitude(direction[major_axis(direction)]);
    square_of_length_ = direction[0] * direction[0] + direction[1] * direction[1];
  }

  Membership at(const Point& p, const Scene& scene) const {
    const Ring across = middle_.at(p);
    const int beside = sign_of(across);
    // The long sides' inward normals point from the sample to the middle.
    Membership all = side(sign_of(distance_inside(across, Ring(0))), -beside * sign_of(middle_.a),
                          -beside * sign_of(middle_.b), scene);
    for (std::size_t i = 0; i < 2; ++i) all &= side(map_->edge(i), p, scene);
    return all;
  }

  /// The same if no point of the line moves by more than `reach` (moved_line_reach()).
  Membership within(const Point& p, const Ring& reach) const {
    const Ring across = middle_.at(p);
    const Ring twice = Ring(2) * reach;
    Membership all{.possible = sign_of(distance_inside(across, twice)) >= 0,
                   .sure = width_ > twice && sign_of(distance_inside(across, -twice)) > 0};
    for (std::size_t i = 0; i < 2; ++i) {
      const int where = side_within(map_->edge(i), reach, p);
      all &= {.possible = where >= 0, .sure = where > 0};
    }
    return all;
  }

 private:
  /// Positive if a sample is nearer to the middle than (width + more)/2, zero if as near. `across`
  /// is the middle's functional there: the distance from it times |d| or, along the other axis,
  /// times the major part of d.
  Ring distance_inside(const Ring& across, const Ring& more) const {
    const Ring width = width_ + more;
    const Ring twice = Ring(2) * magnitude(across);
    if (!is_rectangular_) return width * along_ - twice;
    return width * width * square_of_length_ - twice * twice;
  }

  const ProjectiveMap* map_;
  Ring width_;
  bool is_rectangular_;
  Line middle_;
  Ring along_;             ///< the longer part of the direction d
  Ring square_of_length_;  ///< |d|²
};

/// Whether what clip planes and the viewport's sides leave of a line has the sample's share.
Membership inside_planes(const TriangleSetup& line, const ProjectiveMap& map, const Point& p) {
  Membership all;
  for (const ClipFunctional& functional : line.clip_functionals()) {
    all &= side(functional, p, *line.scene);
  }
  for (const auto& values : values_at_sides(line)) {
    if (sign_of(map.combine(values).at(p)) < 0) return kOutside;
  }
  return all;
}

SampleVerdict decide_area(const TriangleSetup& line, const Columns& at, const ProjectiveMap& map,
                          const Point& p) {
  if (map.orientation() == 0) return {Verdict::forbidden, Reason::degenerate};
  const Scene& scene = *line.scene;
  Membership all = LineBody(at, map, line.primitive_size(), scene.source().line_mode).at(p, scene);
  if (!all.possible) return {Verdict::forbidden, Reason::outside};
  all &= inside_planes(line, map, p);
  if (!all.possible) return {Verdict::forbidden, Reason::clipped};
  return verdict_of(all);
}

/// Decides for a line of shape cut, all of whose points may move by `reach`.
SampleVerdict decide_moved_area(const TriangleSetup& line, const Point& p) {
  if (line.ideal.orientation() == 0) return {Verdict::permitted, Reason::snapping};
  const LineBody body(line.columns, line.ideal, line.primitive_size(),
                      line.scene->source().line_mode);
  Membership all = body.within(p, line.reach);
  if (!all.possible) return {Verdict::forbidden, Reason::outside};
  for (const ClipFunctional& functional : line.clip_functionals()) {
    if (!functional.is_violated) continue;
    if (side_within(functional.outer, line.reach, p) < 0) {
      return {Verdict::forbidden, Reason::clipped};
    }
    all.sure = all.sure && side_within(functional.inner, line.reach, p) > 0;
  }
  for (const auto& values : values_at_sides(line)) {
    const int where = side_within(line.ideal.combine(values), line.reach, p);
    if (where < 0) return {Verdict::forbidden, Reason::clipped};
    all.sure = all.sure && where > 0;
  }
  if (all.sure) return {Verdict::required, Reason::inside};
  return {Verdict::permitted, line.is_whole ? Reason::snapping : reason_of_cut(line)};
}

// --- Bresenham's lines ---------------------------------------------------------------------------

/// The part of a line between s = `from` and s = `to`, in shares of the clip-space line.
struct Part {
  Field from{0};
  Field to{1};
};

/// The part of a line that is inside all planes and in front of the eye; empty if there is none.
/// Values of a plane are linear in s, from the first vertex to the second.
std::optional<Part> visible_part(const TriangleSetup& line) {
  Part part;
  bool is_seen = true;
  const auto cut = [&](const Ring& at_first, const Ring& at_second) {
    const int first = sign_of(at_first);
    const int second = sign_of(at_second);
    if (first < 0 && second < 0) is_seen = false;
    if (first >= 0 && second >= 0) return;
    const Field where = quotient(at_first, at_first - at_second);
    if (first < 0) {
      part.from = std::max(part.from, where);
    } else {
      part.to = std::min(part.to, where);
    }
  };
  for (const auto& values : line.clip_values()) cut(values[0], values[1]);
  for (const auto& values : values_at_sides(line)) cut(values[0], values[1]);
  cut(line.columns[0][2], line.columns[1][2]);
  if (!is_seen || part.to < part.from) return std::nullopt;
  return part;
}

/// The window position of a share of the line, in pixels; empty at the eye.
std::optional<ExactPosition> position_at(const TriangleSetup& line, const Columns& at,
                                         const Field& s) {
  const auto mixed = [&](const Ring& a, const Ring& b) {
    return Field((Field(1) - s) * Field(a) + s * Field(b));
  };
  const Field w = mixed(at[0][2], at[1][2]);
  if (sign_of(w) <= 0) return std::nullopt;
  const Field units(line.scene->units_per_pixel());
  return ExactPosition{mixed(at[0][0], at[1][0]) / (w * units),
                       mixed(at[0][1], at[1][1]) / (w * units)};
}

/// True if the diamond-exit rule selects a pixel of a line drawn with its ends at these columns.
bool selects(const TriangleSetup& line, const Columns& at, int x, int y) {
  const std::optional<Part> part = visible_part(line);
  if (!part) return false;
  std::optional<ExactPosition> from = position_at(line, at, part->from);
  std::optional<ExactPosition> to = position_at(line, at, part->to);
  if (!from || !to) return false;
  const std::size_t minor = 1 - major_axis(direction_of(at[0], at[1]));
  const cases::Case& source = line.scene->source();
  // The nearest integer, at least 1; halves are rounded up.
  const long width = std::max(1L, floor_to_long(exact_field(source.line_width) + Field(1, 2)));
  const Field shift(static_cast<int>(width - 1), 2);
  (*from)[minor] -= shift;
  (*to)[minor] -= shift;
  const bool is_d3d = source.rules == cases::Rules::d3d;
  for (int k = 0; k < width; ++k) {
    const int there_x = minor == 0 ? x - k : x;
    const int there_y = minor == 1 ? y - k : y;
    if (exits_diamond(*from, *to, there_x, there_y, is_d3d)) return true;
  }
  return false;
}

/// Bresenham's line of a few placements: a pixel that each of them selects is required.
SampleVerdict decide_bresenham(const TriangleSetup& line, int x, int y) {
  constexpr SampleVerdict kSelected{Verdict::required, Reason::inside};
  constexpr SampleVerdict kNot{Verdict::forbidden, Reason::outside};
  if (line.shape == Shape::exact) return selects(line, line.columns, x, y) ? kSelected : kNot;
  if (line.shape == Shape::placed) {
    return selects(line, line.placed_columns_of_all(), x, y) ? kSelected : kNot;
  }
  return {Verdict::permitted, line.is_whole ? Reason::snapping : reason_of_cut(line)};
}

}  // namespace

SampleVerdict decide_primitive(const TriangleSetup& primitive, const Point& p) {
  const Scene& scene = *primitive.scene;
  const cases::Case& source = scene.source();
  if (source.primitive == cases::Primitive::points) return decide_point_primitive(primitive, p);
  if (source.line_mode == cases::LineMode::bresenham) {
    const auto pixel = [&scene](const Ring& at) {
      return static_cast<int>(floor_to_long(quotient(at, scene.units_per_pixel())));
    };
    return decide_bresenham(primitive, pixel(p.u), pixel(p.v));
  }
  if (primitive.shape == Shape::exact) {
    return decide_area(primitive, primitive.columns, primitive.ideal, p);
  }
  if (primitive.shape == Shape::placed) {
    return decide_area(primitive, primitive.placed_columns_of_all(), primitive.corner(0), p);
  }
  return decide_moved_area(primitive, p);
}

}  // namespace rastercheck::oracle
