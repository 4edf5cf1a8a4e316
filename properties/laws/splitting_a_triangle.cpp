// Splitting a triangle changes nothing beyond the bound: a triangle cut into parts at a point of an
// edge, at a point inside, or at the middles of all edges is drawn by the parts together, each
// sample once, with the same values.
//
// Why. Vertices are added in clip space: p = Σ s_i p_i with s_i >= 0 and Σ s_i = 1 is a point of
// the triangle, wherever it appears, even behind the eye. A smooth attribute r, z and a clip
// distance d are linear in clip space, so with r = Σ s_i r_i, and z and d alike, each part has the
// same map as the whole: the same 1/w, N/D, z/w and f at each sample (RULES §1). Inner edges occur
// twice, in opposite directions, and a zero is inside exactly one of the two parts (§2). Outer
// edges lie in edges of the whole. The s_i are multiples of 1/4, and the numbers have so few bits
// that every sum is exact in float32.
//
// Both drawings are within the bound of the same exact value, so they differ by at most twice the
// bound. Noperspective attributes are linear in the window and not in clip space, flat attributes
// follow the provoking vertex, and centroids follow the coverage. So all attributes are made smooth
// and evaluated at the sample. Each triangle is drawn as if alone: the depth test is removed.
//
// Samples: all except those that internal/parted_triangles.h leaves open near the outline of
// snapped triangles. Values are compared only if they come from exact positions: an added vertex
// that is snapped no longer lies in the plane of the triangle's snapped vertices.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "properties/choices.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/parted_triangles.h"

namespace rastercheck::properties::splitting_a_triangle_law {
namespace {

using cases::Triangle;

/// Cuts a triangle in two at a point of an edge.
std::vector<Triangle> split_at_edge(cases::Case& c, const Triangle& whole, int quarters) {
  const std::uint32_t point = add_mixed(c, whole, {4 - quarters, quarters, 0});
  return {{whole[0], point, whole[2]}, {point, whole[1], whole[2]}};
}

/// Cuts a triangle in three at a point inside.
std::vector<Triangle> split_inside(cases::Case& c, const Triangle& whole) {
  const std::uint32_t point = add_mixed(c, whole, {2, 1, 1});
  return {{whole[0], whole[1], point}, {point, whole[1], whole[2]}, {whole[0], point, whole[2]}};
}

/// Cuts a triangle in four at the middles of its edges.
std::vector<Triangle> split_at_middles(cases::Case& c, const Triangle& whole) {
  const std::uint32_t of_01 = add_mixed(c, whole, {2, 2, 0});
  const std::uint32_t of_12 = add_mixed(c, whole, {0, 2, 2});
  const std::uint32_t of_20 = add_mixed(c, whole, {2, 0, 2});
  return {{whole[0], of_01, of_20},
          {of_01, whole[1], of_12},
          {of_20, of_12, whole[2]},
          {of_01, of_12, of_20}};
}

Parted parted(const cases::Case& c) {
  Parted result;
  result.whole = with_short_vertices(c);
  result.parts = result.whole;
  result.parts.triangles.clear();
  result.note = "drawn in parts";
  Choices choices(choices_of(c));
  for (std::uint32_t t = 0; t < result.whole.triangles.size(); ++t) {
    Triangle triangle = result.whole.triangles[t];
    std::rotate(triangle.begin(), triangle.begin() + static_cast<int>(choices.below(3)),
                triangle.end());
    std::vector<Triangle> parts;
    switch (choices.below(4)) {
      case 0:
        parts = split_inside(result.parts, triangle);
        break;
      case 1:
        parts = split_at_middles(result.parts, triangle);
        break;
      case 2:
        parts = split_at_edge(result.parts, triangle, 1);
        break;
      default:
        parts = split_at_edge(result.parts, triangle, 2);
    }
    result.parts.triangles.insert(result.parts.triangles.end(), parts.begin(), parts.end());
    result.triangle_of.insert(result.triangle_of.end(), parts.size(), t);
  }
  return result;
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  return check_parted(parted(clip), backend);
}

const LawRegistration kRegistration(
    {.id = "splitting-a-triangle-changes-nothing-beyond-the-bound",
     .sentence = "splitting a triangle changes nothing beyond the bound",
     .reason =
         "Positions, depths, distances and smooth attributes are linear in clip space: a part "
         "has the map of the whole.",
     .exceptions = "samples near the outline of a snapped triangle, and its values; noperspective "
                   "and flat attributes, which are made smooth",
     .generate = &generate_any,
     .check = &check,
     .is_promised = &draws_all_parts_once,
     .unpromised = "the backend does not promise that parts cover, once, what the whole covers",
     .needs_samples = true,
     .covers = {cover(10, "clipped"), cover(15, "several samples"), cover_decided(15, "snapped"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::splitting_a_triangle_law
