// Splitting a triangle changes nothing beyond the bound: a triangle cut into parts at a point of an
// edge, at a point inside, or at the middles of all edges is drawn by the parts together, each
// sample once, and with the values that it had.
//
// Why. Vertices are added in clip space: p = Σ s_i p_i with s_i >= 0 and Σ s_i = 1 is a point of
// the triangle, wherever it appears, also behind the eye. What a smooth attribute r, z and a clip
// distance d interpolate is linear in clip space, so that with r = Σ s_i r_i, and z and d alike,
// each part has the map of the whole: the same 1/w, N/D, z/w and f at each sample (RULES §1). Its
// edges inside are there twice, in opposite directions, and a zero is inside of one of the two
// (§2); its outer edges lie in those of the whole. The s_i are quarters and the numbers short
// enough that every sum is a float32: nothing is rounded.
//
// Values are within the bound of one exact value, so the two drawings' differ by twice the bound at
// most. Noperspective attributes are linear in the window and not in clip space, flat ones follow
// the provoking vertex, centroids what is covered: all attributes are made smooth and evaluated at
// the sample. Each triangle as if drawn alone: a depth test is left out.
//
// Samples: all that internal/parted_triangles.h does not find open, which are samples near the
// outline of snapped triangles. Values where attributes come from the exact positions: those of
// vertices that are snapped, and of a point that is snapped between them, lie in other planes.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "properties/laws/internal/choices.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/parted_triangles.h"

namespace rastercheck::properties::splitting_a_triangle_law {
namespace {

using cases::Triangle;

/// At a point of an edge: two parts.
std::vector<Triangle> split_at_edge(cases::Case& c, const Triangle& whole, int quarters) {
  const std::uint32_t point = add_mixed(c, whole, {4 - quarters, quarters, 0});
  return {{whole[0], point, whole[2]}, {point, whole[1], whole[2]}};
}

/// At a point inside: three parts.
std::vector<Triangle> split_inside(cases::Case& c, const Triangle& whole) {
  const std::uint32_t point = add_mixed(c, whole, {2, 1, 1});
  return {{whole[0], whole[1], point}, {point, whole[1], whole[2]}, {whole[0], point, whole[2]}};
}

/// At the middles of all edges: four parts.
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
  Choices choices(fingerprint(c));
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
     .covers = {cover(10, "clipped"), cover(15, "several samples"), cover_decided(15, "snapped"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::splitting_a_triangle_law
