// Vertex order changes nothing beyond the bound: a triangle is the same whichever of its vertices
// comes first. What is drawn of each rotation is held against the truth of the order as it was, so
// that set-up code that is good for one order only shows.
//
// Flat attributes come from the provoking vertex, which a rotation changes: all vertices are given
// the same value of them. Leaving the attributes out instead would renumber the others.

#include "oracle/transform.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

void even_out_flat_attributes(cases::Case& c) {
  const std::size_t count = c.attributes.size();
  for (std::size_t a = 0; a < count; ++a) {
    if (c.attributes[a].interpolation != cases::Interpolation::flat) continue;
    for (std::size_t v = 0; v < c.positions.size(); ++v) c.attribute_values[v * count + a] = 0;
  }
}

void rotate(cases::Case& c) {
  for (cases::Triangle& triangle : c.triangles) triangle = {triangle[1], triangle[2], triangle[0]};
}

Result<Check> check(const cases::Case& c, backends::Backend& backend, const CheckOptions& options) {
  Result<cases::Case> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  even_out_flat_attributes(*clip);
  Check both;
  cases::Case rotated = *clip;
  for (int turns = 1; turns <= 2; ++turns) {
    rotate(rotated);
    const Result<cases::Framebuffer> drawn = draw(rotated, backend);
    if (!drawn) return tl::unexpected(drawn.error());
    Check one = judge_drawn(*clip, backend.contract(*clip), *drawn, {}, options);
    for (records::Violation& violation : one.violations) {
      violation.note += violation.note.empty() ? "" : "; ";
      violation.note +=
          turns == 1 ? "drawn with the second vertex first" : "drawn with the third vertex first";
    }
    merge(both, one);
  }
  return both;
}

const LawRegistration kRegistration(
    {.name = "vertex order changes nothing beyond the bound",
     .reason = "Rotating vertices permutes the edge functions and changes no sum of them.",
     .exceptions =
         "flat attributes, which follow the provoking vertex: all vertices are given the same",
     .generate = &generate_any,
     .check = &check,
     .covers = {cover(12, "clipped"), cover(44, "drawn"), cover(5, "extrapolated centre"),
                cover(15, "several samples"), cover_decided(9, "tie"), cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties
