#include "oracle/internal/primitive_coverage.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "oracle/internal/diamond_line.h"
#include "oracle/internal/membership.h"

namespace rastercheck::oracle {
namespace {

using records::Reason;
using records::SampleVerdict;
using records::Verdict;
using Columns = std::array<RingVector3, 3>;

// --- Points --------------------------------------------------------------------------------------

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

/// `open`: why a sample may be open.
SampleVerdict verdict_of(const Membership& all, Reason open = Reason::tie) {
  if (!all.possible) return {Verdict::forbidden, Reason::outside};
  if (!all.sure) return {Verdict::permitted, open};
  return {Verdict::required, all.tie ? Reason::tie : Reason::inside};
}

/// Adds a reading of the contract to those seen so far; begin with `possible` false.
void take_reading(Membership& over_all, const Membership& one) {
  over_all.possible = over_all.possible || one.possible;
  over_all.sure = over_all.sure && one.sure;
  over_all.tie = over_all.tie || one.tie;
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

SampleVerdict decide_square(const TriangleSetup& point, const Point& p) {
  if (is_dropped(point)) return {Verdict::forbidden, Reason::clipped};
  const Scene& scene = *point.scene;
  const Ring size = point.primitive_size();
  if (point.shape == Shape::exact) {
    return verdict_of(in_square(point.columns[0], size, p, scene));
  }
  if (point.shape == Shape::placed) {
    return verdict_of(in_square(point.placed_columns_of_all()[0], size, p, scene));
  }
  return verdict_of(over_grid_points(point, p), Reason::snapping);
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
    Membership all;
    if (is_rectangular_) {
      all.possible = sign_of(distance_inside(across, twice)) >= 0;
      all.sure = width_ > twice && sign_of(distance_inside(across, -twice)) > 0;
    } else {
      // The distance from the nearer long side is that along the minor axis times along/|d|.
      const Ring inside = distance_inside(across, Ring(0));
      const bool is_far = inside * inside > twice * twice * square_of_length_;
      all.possible = sign_of(inside) >= 0 || !is_far;
      all.sure = sign_of(inside) > 0 && is_far;
    }
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

/// Whether what clip planes and the viewport's sides leave of an exact line has the sample's share.
Membership inside_planes(const TriangleSetup& line, const Point& p) {
  Membership all;
  for (const ClipFunctional& functional : line.clip_functionals()) {
    all &= side(functional, p, *line.scene);
  }
  for (const auto& values : values_at_sides(line)) {
    if (sign_of(line.ideal.combine(values).at(p)) < 0) return kOutside;
  }
  return all;
}

SampleVerdict decide_area(const TriangleSetup& line, const Point& p) {
  const Scene& scene = *line.scene;
  const bool is_exact = line.shape == Shape::exact;
  const Columns at = is_exact ? line.columns : line.placed_columns_of_all();
  const ProjectiveMap& map = is_exact ? line.ideal : line.corner(0);
  if (map.orientation() == 0) return {Verdict::forbidden, Reason::degenerate};
  Membership all = LineBody(at, map, line.primitive_size(), scene.source().line_mode).at(p, scene);
  if (!all.possible) return {Verdict::forbidden, Reason::outside};
  if (is_exact) all &= inside_planes(line, p);  // what is placed is not clipped
  if (!all.possible) return {Verdict::forbidden, Reason::clipped};
  return verdict_of(all);
}

/// Decides for a line of shape cut, all of whose points may move by `reach`.
SampleVerdict decide_moved_area(const TriangleSetup& line, const Point& p) {
  const LineBody body(line.columns, line.ideal, line.primitive_size(),
                      line.scene->source().line_mode);
  return verdict_of(body.within(p, line.reach), Reason::snapping);
}

}  // namespace

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

bool is_dropped(const TriangleSetup& point) {
  if (sign_of(point.columns[0][2]) <= 0) return true;
  const auto is_beyond = [](const std::array<Ring, 3>& values) { return sign_of(values[0]) < 0; };
  const auto planes = point.clip_values();
  const auto sides = values_at_sides(point);
  return std::any_of(planes.begin(), planes.end(), is_beyond) ||
         std::any_of(sides.begin(), sides.end(), is_beyond);
}

bool is_cut(const TriangleSetup& line) {
  const auto may_cut = [](const std::array<Ring, 3>& values) {
    return sign_of(values[0]) <= 0 || sign_of(values[1]) <= 0;
  };
  const auto planes = line.clip_values();
  const auto sides = values_at_sides(line);
  return std::any_of(planes.begin(), planes.end(), may_cut) ||
         std::any_of(sides.begin(), sides.end(), may_cut);
}

bool has_no_area(const Scene& scene) {
  return scene.viewport_lo().u == scene.viewport_hi().u ||
         scene.viewport_lo().v == scene.viewport_hi().v;
}

SampleVerdict decide_primitive(const TriangleSetup& primitive, const Point& p) {
  const Scene& scene = *primitive.scene;
  const cases::Case& source = scene.source();
  // Its sides would let everything pass.
  if (has_no_area(scene)) return {Verdict::forbidden, Reason::viewport};
  if (source.primitive == cases::Primitive::points) return decide_square(primitive, p);
  if (source.line_mode == cases::LineMode::bresenham) {
    const auto pixel = [&scene](const Ring& at) {
      return static_cast<int>(floor_to_long(quotient(at, scene.units_per_pixel())));
    };
    return primitive.diamond_line().decide(pixel(p.u), pixel(p.v));
  }
  return primitive.shape == Shape::cut ? decide_moved_area(primitive, p)
                                       : decide_area(primitive, p);
}

}  // namespace rastercheck::oracle
