// A point, and a line that is a parallelogram, is drawn as the two triangles that it consists of:
// the same samples, with the same values.
//
// Why. The square around a vertex and the parallelogram along a line are polygons whose borders the
// fill rule decides (RULES §9, §10), as it does the borders of triangles and their common diagonal:
// so the two triangles cover the same samples, once. All corners of a point have its vertex's
// values. The two corners at an end of a line have the end's values, depth and w; a map of the
// window that has these at the corners is constant along the minor axis, and so is the
// parallelogram's, by s along the major axis.
//
// Primitives: inside all planes and the viewport's sides, corners included, which float32 must hold
// exactly; so that nothing is cut, and snapping to a grid that has the corners moves nothing.
// Attributes at a centroid, which would be that of one of the triangles, are evaluated at the
// centre instead. Samples: all; the oracle judges those that differ, as parts of the point or line.

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "properties/judged_law.h"
#include "properties/laws/internal/changed_drawing.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"
#include "properties/primitive_state.h"
#include "properties/random_state.h"

namespace rastercheck::properties::areas_are_two_triangles_law {
namespace {

/// A case's points or lines that can be made of triangles, and these, two for each, in order.
struct BothCases {
  cases::ClipCase primitives;
  cases::ClipCase triangles;
};

/// A corner of a point or line: the vertex whose values it has, and its place.
struct Corner {
  std::uint32_t vertex = 0;
  WindowPoint at;
};

/// The four corners around a point or parallelogram, in order.
std::array<Corner, 4> corners_of(const cases::Case& c, const cases::Triangle& primitive) {
  const std::uint32_t a = primitive[0];
  const std::uint32_t b = primitive[1];
  const WindowPoint p = window_point(c, c.positions[a]);
  const WindowPoint q = window_point(c, c.positions[b]);
  if (c.primitive == cases::Primitive::points) {
    const double half = double{c.point_size} / 2;
    return {Corner{a, {p.u - half, p.v - half}}, Corner{a, {p.u + half, p.v - half}},
            Corner{a, {p.u + half, p.v + half}}, Corner{a, {p.u - half, p.v + half}}};
  }
  const double half = double{c.line_width} / 2;
  const bool is_x_major = std::abs(q.u - p.u) >= std::abs(q.v - p.v);
  const double du = is_x_major ? 0 : half;
  const double dv = is_x_major ? half : 0;
  return {Corner{a, {p.u - du, p.v - dv}}, Corner{b, {q.u - du, q.v - dv}},
          Corner{b, {q.u + du, q.v + dv}}, Corner{a, {p.u + du, p.v + dv}}};
}

/// Appends the two triangles, if float32 has all their corners, inside everything. If not, vertices
/// without a triangle may be left.
bool add_triangles(const cases::Case& c, const cases::Triangle& primitive, cases::Case& out) {
  const std::array<Corner, 4> corners = corners_of(c, primitive);
  const bool is_line = c.primitive == cases::Primitive::lines;
  const std::uint32_t provoking = primitive[c.rules == cases::Rules::opengl && is_line ? 1 : 0];
  std::array<std::uint32_t, 4> added{};
  for (std::size_t i = 0; i < 4; ++i) {
    const cases::ClipVertex& of = c.positions[corners[i].vertex];
    cases::ClipVertex vertex = at_window(c, corners[i].at, 0, of.w);
    vertex.z = of.z;
    if (!is_on_eighths(corners[i].at) || !is_exactly_at(c, vertex, corners[i].at)) return false;
    added[i] = add_vertex_like(out, corners[i].vertex, vertex);
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      if (c.attributes[a].interpolation != cases::Interpolation::flat) continue;
      out.attribute_values[added[i] * c.attributes.size() + a] = c.attributes_of(provoking)[a];
    }
  }
  const cases::Triangle first{added[0], added[1], added[2]};
  const cases::Triangle second{added[0], added[2], added[3]};
  if (!is_inside(out, first) || !is_inside(out, second)) return false;
  out.triangles.push_back(first);
  out.triangles.push_back(second);
  return true;
}

std::optional<BothCases> both_cases(const cases::ClipCase& c) {
  BothCases both{c, c};
  both.primitives.depth_test = cases::DepthTest::none;
  both.triangles.depth_test = cases::DepthTest::none;
  leave_out_centroids(both.primitives);
  leave_out_centroids(both.triangles);
  both.primitives.triangles.clear();
  both.triangles.triangles.clear();
  both.triangles.primitive = cases::Primitive::triangles;
  for (const cases::Triangle& primitive : c.triangles) {
    if (!is_inside(c, primitive)) continue;
    if (add_triangles(c, primitive, both.triangles)) {
      both.primitives.triangles.push_back(primitive);
    }
  }
  if (both.primitives.triangles.empty()) return std::nullopt;
  return both;
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend, std::uint64_t index) {
  const bool is_about = clip.primitive == cases::Primitive::points ||
                        (clip.primitive == cases::Primitive::lines &&
                         clip.line_mode == cases::LineMode::parallelogram);
  if (!is_about) return not_applicable("the property is about points and parallelograms");
  const std::optional<BothCases> both = both_cases(clip);
  if (!both) return not_applicable("no corners are exactly on eighths of pixels and inside");
  if (!keeps_eighths(backend.contract(both->triangles)) ||
      !keeps_eighths(backend.contract(both->primitives))) {
    return not_applicable("the contract may move the corners, or leaves the owner of sides open");
  }
  Result<backends::Drawn> triangles = draw_promised(both->triangles, backend);
  if (!triangles) return tl::unexpected(triangles.error());
  const Result<backends::Drawn> drawn = draw_promised(both->primitives, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  for (std::uint32_t& triangle : triangles->fragments.triangle) triangle /= 2;
  Check check = judge_changed(both->primitives, drawn->contract, triangles->fragments,
                              drawn->fragments, index);
  add_to_notes(check, "its two triangles were drawn otherwise");
  if (clip.primitive == cases::Primitive::points) add_label(check, "points");
  return check;
}

/// Points and parallelograms whose ends are on eighths of pixels.
Generated generate(Draw& draw) {
  const bool is_of_points = draw.one_in(2);
  cases::Case c = random_primitive_state(
      draw, is_of_points ? cases::Primitive::points : cases::Primitive::lines, true);
  // Half of a size must be a multiple of an eighth.
  if (is_of_points) {
    set_point_size(draw, c);
    c.point_size = std::floor(c.point_size * 4) / 4;
  } else {
    set_line_mode(draw, c);
    c.line_mode = cases::LineMode::parallelogram;
    c.line_width = std::floor(c.line_width * 4) / 4;
  }
  const int count = draw.between(2, 6 + draw.size() / 10);
  for (int i = 0; i < count; ++i) {
    std::array<std::uint32_t, 2> ends{};
    for (std::uint32_t& end : ends) {
      const WindowPoint p = visible_point(draw, c);
      const float depth = random_depth(draw, c);
      const float w = draw.pick(std::array{0.5F, 1.0F, 1.0F, 2.0F});
      end = add_vertex(c, at_window(c, {floor_to_eighths(p.u), floor_to_eighths(p.v)}, depth, w));
    }
    c.triangles.push_back({ends[0], ends[is_of_points ? 0 : 1], ends[is_of_points ? 0 : 1]});
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return {c, is_of_points ? "points" : "parallelograms"};
}

bool draws_either(backends::Backend& backend) {
  return draws_lines(backend) || draws_points(backend);
}

const LawRegistration kRegistration(
    {.id = "points-and-parallelograms-are-two-triangles",
     .sentence = "points and parallelograms are drawn as their two triangles",
     .reason =
         "Squares and parallelograms are polygons, whose borders the fill rule decides; a map "
         "of the window with an end's values at both its corners is constant across.",
     .exceptions = "centroids; what is clipped, or has corners that float32 does not hold",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_either,
     .unpromised = "the backend draws neither lines nor points",
     .takes_lines_and_points = true,
     .covers = {cover_decided(20, "drawn"), cover_decided(10, "points")}});

}  // namespace
}  // namespace rastercheck::properties::areas_are_two_triangles_law
