#include "oracle/internal/conservative.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "oracle/internal/convex_region.h"
#include "oracle/internal/coverage.h"

namespace rastercheck::oracle {
namespace {

using cases::Conservative;
using cases::ConservativeCorners;
using cases::ConservativeKind;
using records::Reason;
using records::SampleVerdict;
using records::Verdict;

constexpr SampleVerdict kMissed{Verdict::forbidden, Reason::outside};

/// In window units, as all lengths here.
Ring half_pixel(const Scene& scene) { return Ring(0.5) * scene.units_per_pixel(); }

/// The four sides of the viewport, grown by `grown`: positive inside.
std::array<Line, 4> viewport_sides(const Scene& scene, const Ring& grown) {
  const Point& lo = scene.viewport_lo();
  const Point& hi = scene.viewport_hi();
  return {Line{Ring(1), Ring(0), grown - lo.u}, Line{Ring(-1), Ring(0), grown + hi.u},
          Line{Ring(0), Ring(1), grown - lo.v}, Line{Ring(0), Ring(-1), grown + hi.v}};
}

/// Everything that the verdicts of a triangle's pixels have in common.
struct PixelTerms {
  explicit PixelTerms(const TriangleSetup& triangle)
      : asked(*triangle.scene->contract().conservative),
        half_pixel(oracle::half_pixel(*triangle.scene)),
        error(exact_ring(asked.error) * triangle.scene->units_per_pixel()),
        growth(exact_ring(asked.growth) * triangle.scene->units_per_pixel()),
        moved(triangle.shape == Shape::exact ? Ring(0) : triangle.reach) {}

  /// A pixel's closed square, grown to all sides; 1/2 pixel + grown must not be negative.
  ConvexRegion grown_square(const Point& center, const Ring& grown) const {
    return box_around(center, half_pixel + grown);
  }

  const Conservative& asked;
  Ring half_pixel;
  Ring error;
  Ring growth;
  Ring moved;  ///< ρ
};

/// True if the viewport has inner points in common with the square, the sides having moved outwards
/// by `moved`.
bool may_show(const Scene& scene, const Point& center, const Ring& moved) {
  const std::array<Line, 4> sides = viewport_sides(scene, moved);
  return std::all_of(sides.begin(), sides.end(), [&](const Line& side) {
    return sign_of(side.at(center) + half_pixel(scene)) > 0;
  });
}

/// Cuts the region. Returns false if it is left without an area; it must have one before.
bool cut_keeps_area(ConvexRegion& region, const Line& line) {
  if (line.is_constant()) return sign_of(line.c) >= 0;  // a clip distance of 0 everywhere is inside
  if (!region.rises_above(line)) return false;
  region.clip(line);
  return true;
}

/// True if the square of half-width `half_width` around a point lies in the closed half-plane.
bool holds_square(const Line& line, const Point& center, const Ring& half_width) {
  return line.at(center) >= band_of(line, half_width);
}

/// True if S(grown) surely meets T, with an area in common.
bool surely_meets(const TriangleSetup& triangle, const PixelTerms& terms, const Point& center) {
  const Ring grown = terms.growth - terms.moved;
  if (sign_of(terms.half_pixel + grown) <= 0) return false;
  ConvexRegion region = terms.grown_square(center, grown);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!cut_keeps_area(region, triangle.ideal.edge(i))) return false;
  }
  for (const ClipFunctional& functional : triangle.clip_functionals()) {
    if (functional.is_violated && !cut_keeps_area(region, functional.inner)) return false;
  }
  const Ring inwards = -(terms.moved + triangle.side_reach);
  const std::array<Line, 4> sides = viewport_sides(*triangle.scene, inwards);
  return std::all_of(sides.begin(), sides.end(),
                     [&region](const Line& side) { return cut_keeps_area(region, side); });
}

/// True if the closed S(growth + error) may touch T.
bool may_touch(const TriangleSetup& triangle, const PixelTerms& terms, const Point& center) {
  const Ring all = terms.growth + terms.error + terms.moved;
  const bool shifts_edges = terms.asked.corners == ConservativeCorners::edges;
  const Ring shift = shifts_edges ? all : Ring(0);
  ConvexRegion region = terms.grown_square(center, all - shift);
  const auto clip = [&](const Line& line) { region.clip_above(line, -band_of(line, shift)); };
  for (std::size_t i = 0; i < 3; ++i) clip(triangle.ideal.edge(i));
  for (const ClipFunctional& functional : triangle.clip_functionals()) {
    if (functional.is_violated) clip(functional.outer);
  }
  // Shifted edges and planes already hold everything that the growth may add beyond the viewport.
  const Ring outwards = terms.moved + triangle.side_reach;
  for (const Line& side : viewport_sides(*triangle.scene, outwards)) region.clip(side);
  return !region.is_empty();
}

/// With shifted edges, and vertices that may be placed at several points: true if, whichever points
/// are taken, the same edge keeps the triangle from the pixel. The greatest value of the shifted
/// edge in S(0), E'(c) + (1/2 + shift) (|A'| + |B'|), is a convex function of each coordinate of
/// the edge's ends. So it is greatest where the ends are at extreme points.
bool shifted_edges_miss(const TriangleSetup& triangle, const PixelTerms& terms,
                        const Point& center) {
  if (triangle.shape != Shape::placed || !triangle.has_certain_orientation()) return false;
  const Ring reach = terms.half_pixel + terms.growth + terms.error;
  const bool is_front = triangle.ideal.orientation() > 0;
  const Placements& placements = triangle.placements();
  for (std::size_t edge = 0; edge < 3; ++edge) {
    bool is_beyond = true;
    for (const auto& a : placements.points[(edge + 1) % 3]) {
      for (const auto& b : placements.points[(edge + 2) % 3]) {
        const auto& [from, to] = is_front ? std::pair(a, b) : std::pair(b, a);
        const Ring u(from[0]);
        const Ring v(from[1]);
        const Ring along_u = v - Ring(to[1]);
        const Ring along_v = Ring(to[0]) - u;
        const Line line{along_u, along_v, -(along_u * u + along_v * v)};
        is_beyond = is_beyond && sign_of(line.at(center) + band_of(line, reach)) < 0;
      }
    }
    const Line& unmoved = triangle.ideal.edge(edge);
    if (is_beyond && sign_of(unmoved.at(center) + band_of(unmoved, reach)) < 0) return true;
  }
  return false;
}

/// True if positions may be such that the triangle has no area.
bool may_be_flat(const TriangleSetup& triangle) {
  if (triangle.shape == Shape::exact) return false;
  return triangle.shape == Shape::cut ? triangle.may_turn : !triangle.has_certain_orientation();
}

bool has_repeated_index(const TriangleSetup& triangle) {
  const cases::Triangle& indices = triangle.indices;
  return indices[0] == indices[1] || indices[1] == indices[2] || indices[2] == indices[0];
}

/// The reason why a pixel is left open that is neither required nor forbidden.
Reason reason_of_open(const TriangleSetup& triangle, const PixelTerms& terms) {
  if (triangle.shape == Shape::cut) {
    return triangle.has_nonpositive_w ? Reason::nonpositive_w : Reason::clip_edge;
  }
  if (sign_of(terms.moved) > 0) return Reason::snapping;
  return sign_of(terms.error) > 0 ? Reason::conservative : Reason::tie;
}

SampleVerdict decide_outer(const TriangleSetup& triangle, const PixelTerms& terms,
                           const Point& center) {
  const bool has_moved_edges =
      terms.asked.corners == ConservativeCorners::edges && sign_of(terms.moved) > 0;
  const bool is_missed = has_moved_edges ? shifted_edges_miss(triangle, terms, center)
                                         : !may_touch(triangle, terms, center);
  if (is_missed) return kMissed;
  if (surely_meets(triangle, terms, center)) {
    if (!may_be_flat(triangle)) return {Verdict::required, Reason::inside};
    const bool is_kept = terms.asked.covers_degenerates && !has_repeated_index(triangle) &&
                         triangle.shape == Shape::placed && !triangle.scene->culls_anything();
    if (is_kept) return {Verdict::required, Reason::inside};
    return {Verdict::permitted, Reason::degenerate};
  }
  return {Verdict::permitted, reason_of_open(triangle, terms)};
}

SampleVerdict decide_inner(const TriangleSetup& triangle, const PixelTerms& terms,
                           const Point& center) {
  const Scene& scene = *triangle.scene;
  const auto lies_in_sides = [&](const Ring& moved) {
    const std::array<Line, 4> sides = viewport_sides(scene, moved);
    return std::all_of(sides.begin(), sides.end(), [&](const Line& side) {
      return holds_square(side, center, terms.half_pixel);
    });
  };
  const auto lies_in_triangle = [&](const Ring& half_width, Line ClipFunctional::*plane) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!holds_square(triangle.ideal.edge(i), center, half_width)) return false;
    }
    return std::all_of(triangle.clip_functionals().begin(), triangle.clip_functionals().end(),
                       [&](const ClipFunctional& functional) {
                         return !functional.is_violated ||
                                holds_square(functional.*plane, center, half_width);
                       });
  };
  // A point at least is left of the square that shrinks: without it, nothing could be forbidden.
  const Ring shrunk = std::max(terms.half_pixel - terms.moved, Ring(0));
  const bool is_pixel_shrunk = terms.moved <= terms.half_pixel;
  if (!lies_in_sides(triangle.side_reach)) {
    return {Verdict::forbidden, Reason::viewport};
  }
  if (is_pixel_shrunk ? !lies_in_triangle(shrunk, &ClipFunctional::outer)
                      : !may_touch(triangle, terms, center)) {
    return kMissed;
  }
  const bool is_sure =
      !may_be_flat(triangle) && lies_in_sides(-triangle.side_reach) &&
      lies_in_triangle(terms.half_pixel + terms.error + terms.moved, &ClipFunctional::inner);
  if (is_sure) return {Verdict::required, Reason::inside};
  return {Verdict::permitted, reason_of_open(triangle, terms)};
}

/// The set of weights (λ_0, λ_1) of a triangle without area, λ_2 being 1 − λ_0 − λ_1.
class WeightRegion {
 public:
  explicit WeightRegion(const TriangleSetup& triangle)
      : triangle_(&triangle),
        region_(Point{Ring(0), Ring(0)}, Point{Ring(1), Ring(1)}),
        w_(functional({triangle.columns[0][2], triangle.columns[1][2], triangle.columns[2][2]})) {
    region_.clip({Ring(-1), Ring(-1), Ring(1)});
  }

  /// Cuts by the functional Σ λ_i s_i >= 0.
  void cut(const std::array<Ring, 3>& s) {
    const Line line = functional(s);
    has_area_ = has_area_ && cut_keeps_area(region_, line);
    if (!has_area_) region_.clip(line);
  }
  /// Cuts by a half-plane of the window. Points on its border count as left out where the area is
  /// asked for.
  void cut(const Line& line) {
    std::array<Ring, 3> s;
    for (std::size_t i = 0; i < 3; ++i) {
      const RingVector3& column = triangle_->columns[i];
      s[i] = line.a * column[0] + line.b * column[1] + line.c * column[2];
    }
    const Line of_weights = functional(s);
    has_area_ = has_area_ && region_.rises_above(of_weights);
    region_.clip(of_weights);
  }

  /// True if weights with an area are left, and so some strictly inside all half-planes.
  bool has_area() const { return has_area_; }
  /// True if a point of the window is left: one with w > 0.
  bool has_points() const { return region_.rises_above(w_); }

 private:
  static Line functional(const std::array<Ring, 3>& s) { return {s[0] - s[2], s[1] - s[2], s[2]}; }

  const TriangleSetup* triangle_;
  ConvexRegion region_;
  Line w_;
  bool has_area_ = true;
};

/// A triangle without area, as its exact positions are.
SampleVerdict decide_degenerate(const TriangleSetup& triangle, const PixelTerms& terms,
                                const Point& center) {
  const SampleVerdict nothing{Verdict::forbidden, Reason::degenerate};
  const bool is_outer = terms.asked.kind == ConservativeKind::outer;
  const bool is_exact = triangle.shape == Shape::exact;
  if (is_exact && !(is_outer && terms.asked.covers_degenerates)) return nothing;
  const Scene& scene = *triangle.scene;
  const auto weights_in = [&](const Ring& grown, const Ring& sides_moved) {
    WeightRegion region(triangle);
    // Snapped triangles are cut by planes that may be off; leaving these out permits more.
    if (is_exact) {
      for (const std::array<Ring, 3>& values : triangle.clip_values()) region.cut(values);
    }
    const Ring width = terms.half_pixel + grown;
    region.cut(Line{Ring(1), Ring(0), width - center.u});
    region.cut(Line{Ring(-1), Ring(0), width + center.u});
    region.cut(Line{Ring(0), Ring(1), width - center.v});
    region.cut(Line{Ring(0), Ring(-1), width + center.v});
    for (const Line& side : viewport_sides(scene, sides_moved)) region.cut(side);
    return region;
  };
  const Ring sides = terms.moved + triangle.side_reach;
  const bool shifts_edges = is_outer && terms.asked.corners == ConservativeCorners::edges;
  const Ring all = terms.growth + terms.error + terms.moved;
  // Shifted edges of a triangle without area are two parallels that reach across the window.
  const bool may_be_anywhere = shifts_edges && sign_of(all) > 0;
  if (!may_be_anywhere && !weights_in(all, sides).has_points()) return nothing;
  const Ring needed = terms.growth - terms.moved;
  const bool is_covered = is_outer && terms.asked.covers_degenerates &&
                          triangle.shape != Shape::cut && !has_repeated_index(triangle) &&
                          !scene.culls_anything() && sign_of(terms.half_pixel + needed) > 0 &&
                          weights_in(needed, -sides).has_area();
  if (is_covered) return {Verdict::required, Reason::inside};
  return {Verdict::permitted, Reason::degenerate};
}

}  // namespace

Facing conservative_facing(const TriangleSetup& triangle) {
  const Scene& scene = *triangle.scene;
  if (!scene.culls_anything()) return Facing::drawn;
  const int orientation = triangle.ideal.orientation();
  if (orientation == 0) return Facing::open;  // neither a front nor a back face
  if (triangle.shape == Shape::cut) {
    const CutFacing facing = facing_of_cut(triangle);
    if (facing == CutFacing::open) return Facing::open;
    return facing == CutFacing::culled ? Facing::culled : Facing::drawn;
  }
  const bool is_sure = triangle.shape == Shape::exact ||
                       scene.contract().basis == cases::Basis::ideal ||
                       triangle.has_certain_orientation();
  if (!is_sure) return Facing::open;
  return scene.is_culled(orientation) ? Facing::culled : Facing::drawn;
}

SampleVerdict decide_conservatively(const TriangleSetup& triangle, int x, int y) {
  const Scene& scene = *triangle.scene;
  const PixelTerms terms(triangle);
  const Point center = scene.pixel_middle(x, y);
  if (!scene.target_pixels().holds(x, y) || !may_show(scene, center, triangle.side_reach)) {
    return {Verdict::forbidden, Reason::viewport};
  }
  const Facing facing = conservative_facing(triangle);
  if (facing == Facing::culled) return {Verdict::forbidden, Reason::culled};
  if (triangle.ideal.orientation() == 0) return decide_degenerate(triangle, terms, center);
  const SampleVerdict decision = terms.asked.kind == ConservativeKind::outer
                                     ? decide_outer(triangle, terms, center)
                                     : decide_inner(triangle, terms, center);
  const bool is_open = facing == Facing::open || !may_show(scene, center, -triangle.side_reach);
  if (!is_open || decision.verdict != Verdict::required) return decision;
  return {Verdict::permitted, reason_of_open(triangle, terms)};
}

Ring conservative_spread(const Scene& scene) {
  const std::optional<Conservative>& asked = scene.contract().conservative;
  if (!asked || asked->kind == ConservativeKind::inner) return {0};
  return (exact_ring(asked->growth) + exact_ring(asked->error) + Ring(1)) * scene.units_per_pixel();
}

bool may_cover_far_pixels(const TriangleSetup& triangle) {
  const std::optional<Conservative>& asked = triangle.scene->contract().conservative;
  return asked && asked->corners == ConservativeCorners::edges &&
         asked->kind == ConservativeKind::outer;
}

std::optional<Ring> decisive_distance(const TriangleSetup& triangle) {
  const PixelTerms terms(triangle);
  const bool has_moved_edges =
      terms.asked.corners == ConservativeCorners::edges && sign_of(terms.moved) > 0;
  const bool is_simple = triangle.shape != Shape::cut && triangle.ideal.orientation() != 0 &&
                         !has_moved_edges && !may_be_flat(triangle) &&
                         terms.moved < terms.half_pixel &&
                         conservative_facing(triangle) != Facing::open;
  if (!is_simple) return std::nullopt;
  // Every point of S(r) is within 1 + r of every sample of the pixel.
  return Ring(2) * terms.half_pixel + terms.growth + terms.error + terms.moved;
}

}  // namespace rastercheck::oracle
