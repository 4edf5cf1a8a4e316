// Vertex order changes nothing beyond the bound: a triangle is the same whichever of its vertices
// comes first. The drawing with the second vertex first is judged by the truth of the original
// order, which exposes set-up code that works for only one order. The drawing with the third vertex
// first is judged where it differs from the drawing with the second first.
//
// Why. Rotating the columns of M permutes the rows of Q and leaves det M unchanged (RULES §1): the
// edge functions are the same in another order, and facing, 1/w, N/D and z/w, which are sums over
// all three, are the same.
//
// Flat attributes come from the provoking vertex, which a rotation changes, so all vertices are
// given the same value. Leaving flat attributes out instead would renumber the other attributes.

#include "properties/judged_law.h"
#include "properties/laws/internal/changed_drawing.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::vertex_order_changes_nothing_law {
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

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  cases::ClipCase clip = c;
  even_out_flat_attributes(clip);
  const cases::Contract contract = backend.contract(clip);
  cases::Case rotated = clip;
  rotate(rotated);
  const Result<backends::Drawn> second_first = draw_promised(rotated, backend);
  if (!second_first) return tl::unexpected(second_first.error());
  Check check = judge_drawn(clip, contract, second_first->fragments, {}, index);
  add_to_notes(check, "drawn in the order second, third, first vertex");
  rotate(rotated);
  const Result<backends::Drawn> third_first = draw_promised(rotated, backend);
  if (!third_first) return tl::unexpected(third_first.error());
  Check changed =
      judge_changed(clip, contract, second_first->fragments, third_first->fragments, index);
  add_to_notes(changed, "drawn in the order third, first, second vertex");
  merge(check, changed);
  return check;
}

const LawRegistration kRegistration(
    {.id = "vertex-order-changes-nothing-beyond-the-bound",
     .sentence = "vertex order changes nothing beyond the bound",
     .reason = "Rotating vertices permutes the edge functions and changes no sum of them.",
     .exceptions =
         "flat attributes, which follow the provoking vertex: all vertices are given the same",
     .generate = &generate_any,
     .check = &check,
     .covers = {cover(12, "clipped"), cover(44, "drawn"), cover(5, "extrapolated centre"),
                cover(15, "several samples"), cover_decided(9, "tie"), cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::vertex_order_changes_nothing_law
