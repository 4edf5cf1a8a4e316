// A wider line holds a narrower one: what a line covers, it also covers if it is drawn wider.
//
// Why. The samples of a rectangle or a parallelogram are those at most half the width from the
// middle, and between the ends, whose borders stay (RULES §10). A sample on a border of the
// narrower one is inside the wider one.
//
// Lines: rectangles and parallelograms. Samples: those that the contract does not leave open for
// the wider line.

#include <cstddef>

#include "cases/names.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"

namespace rastercheck::properties::wider_lines_hold_narrower_ones_law {
namespace {

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (clip.primitive != cases::Primitive::lines) return not_applicable(kNotLines);
  if (clip.line_mode == cases::LineMode::bresenham) {
    return not_applicable("pixels of Bresenham's lines are replicated to both sides by turns");
  }
  cases::ClipCase narrow = clip;
  narrow.depth_test = cases::DepthTest::none;
  cases::ClipCase wide = narrow;
  Choices choices(choices_of(clip));
  wide.line_width += choices.pick(std::array{0.125F, 0.5F, 1.0F, 2.0F, 7.0F});
  if (wide.line_width > cases::kMostPrimitiveSize) return not_applicable("the line is too wide");
  const Result<backends::Drawn> before = draw_promised(narrow, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(wide, backend);
  if (!drawn) return tl::unexpected(drawn.error());

  Tally tally(wide);
  Verdicts verdicts(wide, drawn->contract);
  visit_places(
      before->fragments, drawn->fragments,
      [&](const cases::SamplePlace& place, std::size_t, std::size_t) {
        if (is_of_case(wide, place)) tally.pass_required(place.triangle);
      },
      [&](const cases::SamplePlace&, std::size_t, const char*) { tally.label("wider"); },
      [&](const cases::SamplePlace& place) {
        if (!is_of_case(wide, place) ||
            verdicts.judge(place.triangle, place).verdict == records::Verdict::permitted) {
          return;
        }
        tally.report(violation_at(place, records::FragmentClass::missing,
                                  "required: the narrower line has it",
                                  "drawn with a width of " + value_text(wide.line_width)));
      });
  tally.label_drawn();
  return tally.finish();
}

Generated generate(Draw& draw) {
  Generated made = random_lines(draw);
  set_area_mode(draw, made.source);
  made.stratum = cases::name_of(made.source.line_mode);
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-wider-line-holds-the-narrower-one",
     .sentence = "a wider line holds the narrower one",
     .reason = "The middle and the ends stay, and only the distance from the middle grows.",
     .exceptions = "Bresenham's lines; samples that the contract leaves open",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_lines,
     .unpromised = kDrawsNoLines,
     .takes_lines_and_points = true,
     .covers = {cover(40, "drawn"), cover(40, "wider")}});

}  // namespace
}  // namespace rastercheck::properties::wider_lines_hold_narrower_ones_law
