#include "oracle/internal/coverage.h"

#include <algorithm>
#include <limits>

#include "oracle/internal/conservative.h"
#include "oracle/internal/membership.h"
#include "oracle/internal/primitive_coverage.h"

namespace rastercheck::oracle {
namespace {

using records::Reason;
using records::SampleVerdict;
using records::Verdict;

Membership inside_edges(const ProjectiveMap& map, const Point& p, const Scene& scene) {
  if (map.orientation() == 0) return kOutside;
  Membership all;
  for (std::size_t i = 0; i < 3; ++i) all &= side(map.edge(i), p, scene);
  return all;
}

/// Turns what is required into what is permitted if the contract lets the triangle be missing.
SampleVerdict if_drawn(const TriangleSetup& triangle, const SampleVerdict& decision) {
  if (!triangle.may_be_left_out || decision.verdict != Verdict::required) return decision;
  return {Verdict::permitted, Reason::not_promised};
}

SampleVerdict decide_exact(const TriangleSetup& triangle, const Point& p) {
  const Scene& scene = *triangle.scene;
  if (triangle.ideal.orientation() == 0) return {Verdict::forbidden, Reason::degenerate};
  if (scene.is_culled(triangle.ideal.orientation())) return {Verdict::forbidden, Reason::culled};

  Membership all = inside_edges(triangle.ideal, p, scene);
  if (!all.possible) return {Verdict::forbidden, Reason::outside};
  if (triangle.is_cut_by_planes) {
    for (const ClipFunctional& functional : triangle.clip_functionals()) {
      all &= side(functional, p, scene);
    }
  }
  if (!all.possible) return {Verdict::forbidden, Reason::clipped};
  if (!all.sure) return {Verdict::permitted, Reason::tie};
  return {Verdict::required, all.tie ? Reason::tie : Reason::inside};
}

/// Says whether culling keeps a placement.
Membership kept_by_culling(const TriangleSetup& triangle, int orientation_when_placed) {
  const Scene& scene = *triangle.scene;
  const auto kept = [&scene](int orientation) -> Membership {
    if (orientation == 0) return {.possible = true, .sure = false};  // neither front nor back face
    const bool drawn = !scene.is_culled(orientation);
    return {.possible = drawn, .sure = drawn};
  };
  switch (scene.contract().basis) {
    case cases::Basis::ideal:
      return kept(triangle.ideal.orientation());
    case cases::Basis::snapped:
      return kept(orientation_when_placed);
    case cases::Basis::unspecified:
      break;
  }
  if (!scene.culls_anything()) return {};
  const Membership by_ideal = kept(triangle.ideal.orientation());
  const Membership by_snapped = kept(orientation_when_placed);
  return {.possible = by_ideal.possible || by_snapped.possible,
          .sure = by_ideal.sure && by_snapped.sure};
}

/// True if p lies outside the closed convex hull of the points at which the vertices may be placed.
/// This holds iff, for some line through p and one of the points, all points lie on one closed side
/// of the line, and the points on the line itself lie on one side of p.
bool is_outside_hull(const Point& p, const Placements& placements) {
  std::vector<std::array<double, 2>> points;
  for (const auto& of_vertex : placements.points) {
    points.insert(points.end(), of_vertex.begin(), of_vertex.end());
  }
  const NearPoint near = near_point(p);
  const auto is_beside = [&p](const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return sign_of((Ring(a[0]) - p.u) * (Ring(b[0]) - p.u) +
                   (Ring(a[1]) - p.v) * (Ring(b[1]) - p.v)) > 0;
  };
  const auto separates = [&](const std::array<double, 2>& pivot, int direction) {
    return std::all_of(points.begin(), points.end(), [&](const std::array<double, 2>& q) {
      const int across = direction * turn_of(pivot, q, p, near);
      return across > 0 || (across == 0 && is_beside(pivot, q));
    });
  };
  return std::any_of(points.begin(), points.end(), [&separates](const auto& pivot) {
    return separates(pivot, 1) || separates(pivot, -1);
  });
}

/// Decides by the distance from the exact edges (TriangleSetup::edge_bands), which settles nearly
/// every sample; empty for the rest.
std::optional<SampleVerdict> decide_by_distance(const TriangleSetup& triangle, const Point& p) {
  const int orientation = triangle.ideal.orientation();
  if (orientation == 0) return std::nullopt;
  bool is_deep = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const int where = side_within(triangle.ideal.edge(i), triangle.reach, p);
    if (where < 0) return SampleVerdict{Verdict::forbidden, Reason::outside};
    is_deep = is_deep && where > 0;
  }
  if (!is_deep) return std::nullopt;
  const bool is_drawn = kept_by_culling(triangle, orientation).sure;
  return is_drawn ? SampleVerdict{Verdict::required, Reason::inside}
                  : SampleVerdict{Verdict::forbidden, Reason::culled};
}

/// Combines the answers of all placements for a point, including facing.
Membership over_placements(const TriangleSetup& triangle, const Placements& placements,
                           const Point& p) {
  const Scene& scene = *triangle.scene;
  const NearPoint near = near_point(p);
  // [edge][orientation > 0][first end · count + second end]: each pair of ends is evaluated once.
  std::array<std::array<std::vector<Membership>, 2>, 3> sides;
  for (std::size_t edge = 0; edge < 3; ++edge) {
    for (const auto& a : placements.points[(edge + 1) % 3]) {
      for (const auto& b : placements.points[(edge + 2) % 3]) {
        const int turn = turn_of(a, b, p, near);
        const int sign_a = (a[1] > b[1]) - (a[1] < b[1]);
        const int sign_b = (b[0] > a[0]) - (b[0] < a[0]);
        sides[edge][0].push_back(side(-turn, -sign_a, -sign_b, scene));
        sides[edge][1].push_back(side(turn, sign_a, sign_b, scene));
      }
    }
  }
  const std::array<std::size_t, 3> count{placements.points[0].size(), placements.points[1].size(),
                                         placements.points[2].size()};
  Membership all{.possible = false, .sure = true};
  auto orientation = placements.orientations.begin();
  for (std::size_t i = 0; i < count[0]; ++i) {
    for (std::size_t j = 0; j < count[1]; ++j) {
      for (std::size_t k = 0; k < count[2]; ++k, ++orientation) {
        Membership one = kOutside;
        if (*orientation != 0) {
          const std::size_t is_front = *orientation > 0 ? 1 : 0;
          one = sides[0][is_front][j * count[2] + k];
          one &= sides[1][is_front][k * count[0] + i];
          one &= sides[2][is_front][i * count[1] + j];
          all.tie = all.tie || one.tie;
          if (one.possible) one &= kept_by_culling(triangle, *orientation);
        }
        all.possible = all.possible || one.possible;
        all.sure = all.sure && one.sure;
      }
    }
  }
  return all;
}

/// Decides by the examined placements. If only the extreme placements were examined, they still
/// prove that a sample is required or forbidden. An edge function is affine in every vertex
/// coordinate, so its least value occurs at an extreme placement, and a point covered in any
/// placement lies in the hull of the points. The determinant is affine in every coordinate, too, so
/// if no extreme placement turns the other way, no placement between them does.
SampleVerdict decide_by_placements(const TriangleSetup& triangle, const Placements& placements,
                                   const Membership& over_them, const Point& p) {
  const std::vector<int>& turns = placements.orientations;
  const bool turn_alike =
      std::all_of(turns.begin(), turns.end(), [&turns](int turn) { return turn == turns.front(); });
  if (over_them.sure && !over_them.tie && turn_alike) return {Verdict::required, Reason::inside};
  if (is_outside_hull(p, placements)) return {Verdict::forbidden, Reason::outside};
  const bool may_be_drawn = std::any_of(turns.begin(), turns.end(), [&triangle](int turn) {
    return turn != 0 && kept_by_culling(triangle, turn).possible;
  });
  if (!may_be_drawn) return {Verdict::forbidden, Reason::culled};
  if (!placements.are_all) return {Verdict::permitted, Reason::snapping};
  if (!over_them.possible) return {Verdict::forbidden, Reason::outside};
  return {over_them.sure ? Verdict::required : Verdict::permitted,
          over_them.sure ? Reason::tie : Reason::snapping};
}

SampleVerdict decide_placed(const TriangleSetup& triangle, const Point& p) {
  const bool several = triangle.corner_count() > 1;
  if (several) {
    if (const auto decision = decide_by_distance(triangle, p)) return *decision;
  }
  const Placements& placements = triangle.placements();
  const Membership over_all = over_placements(triangle, placements, p);
  if (several) return decide_by_placements(triangle, placements, over_all, p);
  if (!over_all.possible) return {Verdict::forbidden, Reason::outside};
  if (over_all.sure) return {Verdict::required, over_all.tie ? Reason::tie : Reason::inside};
  const bool only_ties = triangle.ideal.orientation() != 0;
  return {Verdict::permitted, only_ties ? Reason::tie : Reason::snapping};
}

/// The answer of an edge with two snapped ends, over all candidates of the ends. If the edge is
/// turned (TriangleSetup::SnappedEdge), its line is not the polygon's boundary. The exact edge then
/// answers with an error of `reach`, because any corner may move that far.
Membership snapped_edge_side(const TriangleSetup& triangle, std::size_t edge, const Point& p) {
  Membership over_all{.possible = false, .sure = true};
  for (const TriangleSetup::SnappedEdge& snapped : triangle.snapped_edge(edge)) {
    Membership one;
    if (snapped.is_turned) {
      const int where = side_within(triangle.ideal.edge(edge), triangle.reach, p);
      one = {.possible = where >= 0, .sure = where > 0};
    } else {
      one = side(snapped.line, p, *triangle.scene);
    }
    over_all.possible = over_all.possible || one.possible;
    over_all.sure = over_all.sure && one.sure;
    over_all.tie = over_all.tie || one.tie;
  }
  return over_all;
}

/// True if p lies in the closed ideal triangle and inside all its clip functionals.
bool is_in_clipped_triangle(const TriangleSetup& triangle, const Point& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (triangle.ideal.edge(i).sign_at(p) < 0) return false;
  }
  return std::all_of(
      triangle.clip_functionals().begin(), triangle.clip_functionals().end(),
      [&p](const ClipFunctional& functional) { return functional.line.sign_at(p) >= 0; });
}

/// True if p is, along both axes, within the tolerance of a vertex with w ≠ 0.
bool is_beside_a_vertex(const TriangleSetup& triangle, const Point& p) {
  return std::any_of(triangle.columns.begin(), triangle.columns.end(),
                     [&](const RingVector3& column) {
                       const Ring w = magnitude(column[2]);
                       const Ring most = triangle.tolerance * w;
                       const auto is_near = [&](const Ring& at, const Ring& of_vertex) {
                         return magnitude(at * column[2] - of_vertex) <= most;
                       };
                       return sign_of(w) > 0 && is_near(p.u, column[0]) && is_near(p.v, column[1]);
                     });
}

/// Decides for a cut triangle without area. The new vertices that clipping makes may give it some
/// area, but only near the line through its vertices and, if all w > 0, not beyond the outermost of
/// them.
SampleVerdict decide_cut_degenerate(const TriangleSetup& triangle, const Point& p, Reason cut) {
  const SampleVerdict open{Verdict::permitted, cut};
  const SampleVerdict never{Verdict::forbidden, Reason::degenerate};
  if (!triangle.has_nonpositive_w) {
    const auto misses = [](const FieldRange& range, const Ring& at) {
      return Field(at) < range.lo || Field(at) > range.hi;
    };
    if (misses(triangle.extent(0), p.u) || misses(triangle.extent(1), p.v)) return never;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Line& line = triangle.ideal.edge(i);
    if (line.is_constant()) continue;
    // All rows of adj(M) are multiples of one line, so the first that is not constant decides.
    return side_within(line, triangle.tolerance, p) == 0 ? open : never;
  }
  return is_beside_a_vertex(triangle, p) ? open : never;  // all vertices are one point
}

/// Decides for a triangle of Shape::cut. Clipping makes new vertices, which are snapped too, so a
/// cut edge and the clip edge may be off by the tolerance along each axis. If a polygon's corners
/// move by at most t per axis, every inner point farther than t per axis from the boundary stays
/// inside, and no point farther than t from the polygon becomes covered.
SampleVerdict decide_cut(const TriangleSetup& triangle, const Point& p) {
  const Reason cut = reason_of_cut(triangle);
  if (triangle.ideal.orientation() == 0) return decide_cut_degenerate(triangle, p, cut);
  const CutFacing facing = facing_of_cut(triangle);
  if (facing == CutFacing::culled) return {Verdict::forbidden, Reason::culled};

  Membership snapped_edges;
  bool near_cut = facing == CutFacing::open;
  for (std::size_t i = 0; i < 3; ++i) {
    if (triangle.is_clipped[(i + 1) % 3] || triangle.is_clipped[(i + 2) % 3]) {
      const int where = side_within(triangle.ideal.edge(i), triangle.tolerance, p);
      if (where < 0) return {Verdict::forbidden, Reason::outside};
      near_cut = near_cut || where == 0;
    } else {
      snapped_edges &= snapped_edge_side(triangle, i, p);
    }
  }
  if (!snapped_edges.possible) return {Verdict::forbidden, Reason::outside};
  for (const ClipFunctional& functional : triangle.clip_functionals()) {
    if (!functional.is_violated) continue;
    const int where = side_within(functional.outer, triangle.tolerance, p);
    if (where < 0) return {Verdict::forbidden, Reason::clipped};
    const bool is_near = where == 0 || (triangle.promise.clip_error > 0 &&
                                        side_within(functional.inner, triangle.tolerance, p) <= 0);
    near_cut = near_cut || is_near;
  }

  // The moved lines may meet far beyond a sharp or moved corner, where nothing is drawn.
  if (!is_in_clipped_triangle(triangle, p) &&
      triangle.clipped_to_triangle(box_around(p, triangle.reach)).is_empty()) {
    return {Verdict::forbidden, Reason::outside};
  }
  if (!near_cut && snapped_edges.sure) {
    return {Verdict::required, snapped_edges.tie ? Reason::tie : Reason::inside};
  }
  return {Verdict::permitted, near_cut ? cut : Reason::snapping};
}

/// sign(value) · value² / (a² + b²): orders signed distances without a root.
Field signed_square_distance(const Line& line, const Ring& value) {
  const Field square = quotient(value * value, line.a * line.a + line.b * line.b);
  return sign_of(value) < 0 ? -square : square;
}

}  // namespace

std::optional<CoverageBoundary> coverage_boundary(const TriangleSetup& triangle) {
  if (!triangle.is_triangle()) return std::nullopt;
  if (triangle.is_left_out) return CoverageBoundary{&triangle.ideal, false, false};
  if (!triangle.promise.is_made || triangle.may_be_left_out) return std::nullopt;
  if (triangle.scene->contract().conservative) {
    if (!decisive_distance(triangle)) return std::nullopt;
    const bool is_drawn = conservative_facing(triangle) == Facing::drawn;
    return CoverageBoundary{&triangle.ideal, is_drawn, true};
  }
  const int orientation = triangle.ideal.orientation();
  if (triangle.shape == Shape::exact) {
    const bool is_drawn = orientation != 0 && !triangle.scene->is_culled(orientation);
    return CoverageBoundary{&triangle.ideal, is_drawn, false};
  }
  if (triangle.shape == Shape::cut) return std::nullopt;
  if (triangle.corner_count() > 1) {
    if (orientation == 0) return std::nullopt;
    const bool is_drawn = kept_by_culling(triangle, orientation).sure;
    // A culled triangle may be drawn if it is placed the other way round.
    const bool is_open = !is_drawn && triangle.scene->contract().basis != cases::Basis::ideal &&
                         !triangle.has_certain_orientation();
    if (is_open) return std::nullopt;
    return CoverageBoundary{&triangle.ideal, is_drawn, true};
  }
  const ProjectiveMap& placed = triangle.corner(0);
  const Membership kept = kept_by_culling(triangle, placed.orientation());
  if (placed.orientation() != 0 && kept.possible && !kept.sure) return std::nullopt;
  return CoverageBoundary{&placed, placed.orientation() != 0 && kept.sure, false};
}

CutFacing facing_of_cut(const TriangleSetup& triangle) {
  const Scene& scene = *triangle.scene;
  // If the moved corners may turn the polygon round, the facing computed from them is open.
  const bool is_open =
      scene.culls_anything() && triangle.may_turn && scene.contract().basis != cases::Basis::ideal;
  if (is_open) return CutFacing::open;
  return scene.is_culled(triangle.ideal.orientation()) ? CutFacing::culled : CutFacing::drawn;
}

SampleVerdict decide_point(const TriangleSetup& triangle, const Point& p) {
  if (!triangle.promise.is_made) return {Verdict::permitted, Reason::not_promised};
  if (triangle.is_left_out) return {Verdict::forbidden, Reason::clipped};
  if (!triangle.is_triangle()) return decide_primitive(triangle, p);
  if (triangle.scene->contract().conservative) {
    const Scene& scene = *triangle.scene;
    const auto pixel = [&scene](const Ring& at) {
      return static_cast<int>(floor_to_long(quotient(at, scene.units_per_pixel())));
    };
    return if_drawn(triangle, decide_conservatively(triangle, pixel(p.u), pixel(p.v)));
  }
  switch (triangle.shape) {
    case Shape::exact:
      return if_drawn(triangle, decide_exact(triangle, p));
    case Shape::placed:
      return if_drawn(triangle, decide_placed(triangle, p));
    case Shape::cut:
      break;
  }
  return if_drawn(triangle, decide_cut(triangle, p));
}

namespace {

/// Decides for a triangle that may be drawn slightly beyond the viewport's sides, or not quite up
/// to them.
SampleVerdict decide_beside(const TriangleSetup& triangle, int x, int y, int sample) {
  const Scene& scene = *triangle.scene;
  const Point p = scene.sample_point(x, y, sample);
  const ViewportSide side = scene.viewport_side(p);
  const bool is_open = scene.is_within(triangle.side_reach, p);
  const bool is_outside = side == ViewportSide::outside && !is_open;
  if (is_outside || !scene.target_pixels().holds(x, y)) {
    return {Verdict::forbidden, Reason::viewport};
  }
  const SampleVerdict decision = decide_point(triangle, p);
  const bool is_certain = side == ViewportSide::inside && !is_open;
  if (is_certain || decision.verdict != Verdict::required) return decision;
  const bool is_open_viewport = scene.contract().has_open_viewport();
  return {Verdict::permitted, is_open_viewport ? Reason::viewport : Reason::clip_edge};
}

}  // namespace

SampleVerdict decide(const TriangleSetup& triangle, int x, int y, int sample) {
  const Scene& scene = *triangle.scene;
  if (!triangle.promise.is_made) {
    return scene.target_pixels().holds(x, y)
               ? SampleVerdict{Verdict::permitted, Reason::not_promised}
               : SampleVerdict{Verdict::forbidden, Reason::viewport};
  }
  if (!triangle.is_triangle()) {
    return scene.target_pixels().holds(x, y)
               ? decide_point(triangle, scene.sample_point(x, y, sample))
               : SampleVerdict{Verdict::forbidden, Reason::viewport};
  }
  if (scene.contract().conservative) {
    return triangle.is_left_out ? SampleVerdict{Verdict::forbidden, Reason::clipped}
                                : if_drawn(triangle, decide_conservatively(triangle, x, y));
  }
  if (triangle.has_open_sides) return decide_beside(triangle, x, y, sample);
  if (!scene.pixels().holds(x, y)) return {Verdict::forbidden, Reason::viewport};
  const Point p = scene.sample_point(x, y, sample);
  const ViewportSide side = scene.viewport_side(p);
  if (side == ViewportSide::outside) return {Verdict::forbidden, Reason::viewport};
  const SampleVerdict decision = decide_point(triangle, p);
  if (side == ViewportSide::far_border && decision.verdict == Verdict::required) {
    return {Verdict::permitted, Reason::clip_edge};
  }
  return decision;
}

std::optional<records::Enclosure> boundary_distance(const TriangleSetup& triangle, const Point& p) {
  if (!triangle.is_triangle()) return std::nullopt;
  const ProjectiveMap& map = triangle.corner_count() == 1 ? triangle.corner(0) : triangle.ideal;
  if (map.orientation() == 0) return std::nullopt;

  std::vector<Line> boundaries{map.edge(0), map.edge(1), map.edge(2)};
  for (const ClipFunctional& functional : triangle.clip_functionals()) {
    if (triangle.shape == Shape::exact || functional.is_violated) {
      boundaries.push_back(functional.line);
    }
  }
  const Point& lo = triangle.scene->viewport_lo();
  const Point& hi = triangle.scene->viewport_hi();
  boundaries.push_back({Ring(1), Ring(0), -lo.u});
  boundaries.push_back({Ring(-1), Ring(0), hi.u});
  boundaries.push_back({Ring(0), Ring(1), -lo.v});
  boundaries.push_back({Ring(0), Ring(-1), hi.v});

  std::optional<Field> least;
  for (const Line& boundary : boundaries) {
    const Ring value = boundary.at(p);
    if (boundary.is_constant()) {
      // The whole triangle lies equally far beyond a clip plane, so no point is near the inside.
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      if (sign_of(value) < 0) return records::Enclosure{-kInfinity, -kInfinity};
      continue;
    }
    const Field square = signed_square_distance(boundary, value);
    if (!least || square < *least) least = square;
  }
  const Field units(triangle.scene->units_per_pixel());
  const records::Enclosure distance = enclose_sqrt(magnitude(*least) / (units * units));
  if (sign_of(*least) < 0) return records::Enclosure{-distance.hi, -distance.lo};
  return distance;
}

}  // namespace rastercheck::oracle
