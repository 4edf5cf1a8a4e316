// A line turned round stays: if the two ends of each line change places, the drawing stays right
// for the case as it was.
//
// Why. A rectangle and a parallelogram are the same sets of samples whichever end comes first, with
// the same borders, and s of the one end is 1 − s of the other (RULES §10). Bresenham's lines leave
// out the pixel whose diamond holds the second end, and so differ where the ends are: pixels whose
// middle is within a pixel, and half of the width, of an end along both axes may differ. Between
// them the line leaves the same diamonds, and ties go the same way, since the line is moved the
// same way.
//
// Samples: all, with values of rectangles and parallelograms. Flat attributes would take the other
// end's value, and are left out. Of Bresenham's lines only what the contract decides.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include "properties/judged_law.h"
#include "properties/laws/internal/changed_drawing.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"

namespace rastercheck::properties::lines_turned_round_stay_law {
namespace {

constexpr const char* kNote = "drawn with the ends of each line exchanged";

/// True if a pixel is so near to an end of the line that turning the line round may change it.
bool is_at_an_end(const cases::Case& c, const cases::SamplePlace& place) {
  const cases::Triangle& line = c.triangles[place.triangle];
  const double most = std::max(1.0, double{c.line_width}) / 2 + 1;
  return std::any_of(line.begin(), line.begin() + 2, [&](std::uint32_t vertex) {
    const cases::ClipVertex& end = c.positions[vertex];
    if (end.w <= 0) return true;  // the line may be cut anywhere
    const WindowPoint at = window_point(c, end);
    return std::abs(place.x + 0.5 - at.u) <= most && std::abs(place.y + 0.5 - at.v) <= most;
  });
}

Check compare_bresenham(const cases::Case& c, const backends::Drawn& before,
                        const cases::Fragments& turned) {
  Tally tally(c);
  Verdicts verdicts(c, before.contract);
  const auto see = [&](const cases::SamplePlace& place, records::FragmentClass of) {
    const bool is_of_a_line = is_of_case(c, place);  // a backend may draw others
    if (is_of_a_line && is_at_an_end(c, place)) return tally.label("at an end");
    const bool is_open = is_of_a_line && verdicts.judge(place.triangle, place).verdict ==
                                             records::Verdict::permitted;
    if (is_open) return;
    const bool is_extra = of == records::FragmentClass::extra;
    tally.report(violation_at(place, of, is_extra ? kNotDrawnBefore : kDrawnBefore, kNote));
  };
  visit_places(
      before.fragments, turned,
      [&](const cases::SamplePlace& place, std::size_t, std::size_t) {
        if (is_of_case(c, place)) tally.pass_required(place.triangle);
      },
      [&](const cases::SamplePlace& place, std::size_t, const char*) {
        see(place, records::FragmentClass::extra);
      },
      [&](const cases::SamplePlace& place) { see(place, records::FragmentClass::missing); });
  tally.label_drawn();
  return tally.finish();
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend, std::uint64_t index) {
  if (clip.primitive != cases::Primitive::lines) return not_applicable(kNotLines);
  cases::ClipCase c = clip;
  c.depth_test = cases::DepthTest::none;
  leave_out_flat_attributes(c);
  const bool is_bresenham = c.line_mode == cases::LineMode::bresenham;
  if (is_bresenham && !draws_what_is_asked_for(backend)) {
    return not_applicable("the contract leaves open which pixels of Bresenham's lines are drawn");
  }
  cases::ClipCase turned = c;
  for (cases::Triangle& line : turned.triangles) line = {line[1], line[0], line[0]};
  const Result<backends::Drawn> before = draw_promised(c, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(turned, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  if (is_bresenham) {
    Check check = compare_bresenham(c, *before, drawn->fragments);
    add_label(check, "diamonds");
    return check;
  }
  Check check = judge_changed(c, drawn->contract, before->fragments, drawn->fragments, index);
  add_to_notes(check, kNote);
  return check;
}

const LawRegistration kRegistration(
    {.id = "a-line-turned-round-stays",
     .sentence = "a line turned round stays where it is",
     .reason = "A rectangle and a parallelogram have no direction; Bresenham's lines differ only "
               "at their ends.",
     .exceptions = "flat attributes; Bresenham's lines if the contract leaves their pixels open",
     .generate = &random_lines,
     .check = &check,
     .is_promised = &draws_lines,
     .unpromised = kDrawsNoLines,
     .takes_lines_and_points = true,
     .covers = {cover(40, "drawn"), cover_decided(20, "diamonds"),
                cover_decided(10, "at an end")}});

}  // namespace
}  // namespace rastercheck::properties::lines_turned_round_stay_law
