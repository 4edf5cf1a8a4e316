// Clipping a line changes no value: a line that a user clip distance cuts has, where it is still
// drawn, the values of the whole line.
//
// Why. A clip distance takes samples away, by the share s of the line's second end, and s belongs
// to the ends as they were given (RULES §10). A rasterizer that makes new ends must give them the
// values, and must keep s, of the old ones; a flat value stays that of an end that was cut off.
//
// Attributes at a centroid depend on the pixel's other samples, and are evaluated at the centre
// instead. Samples: those that are drawn with and without the distances, of which the oracle judges
// some whose values differ. Contracts that snap promise nothing of lines that are cut.

#include <cstddef>
#include <vector>

#include "cases/some_fragments.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/changed_drawing.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::clipped_lines_keep_their_values_law {
namespace {

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend, std::uint64_t index) {
  if (clip.primitive != cases::Primitive::lines) return not_applicable(kNotLines);
  if (clip.clip_distance_count == 0) return not_applicable("the case has no clip distances");
  if (backend.contract(clip).coverage) {
    return not_applicable("of snapped lines that are clipped nothing is promised");
  }
  cases::ClipCase cut = clip;
  cut.depth_test = cases::DepthTest::none;
  leave_out_centroids(cut);
  cases::ClipCase whole = cut;
  whole.clip_distance_count = 0;
  whole.clip_distances.clear();
  const Result<backends::Drawn> before = draw_promised(whole, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(cut, backend);
  if (!drawn) return tl::unexpected(drawn.error());

  std::vector<std::size_t> of_whole;
  std::vector<std::size_t> of_cut;
  visit_places(
      before->fragments, drawn->fragments,
      [&](const cases::SamplePlace&, std::size_t i, std::size_t j) {
        of_whole.push_back(i);
        of_cut.push_back(j);
      },
      [](const cases::SamplePlace&, std::size_t, const char*) {}, [](const cases::SamplePlace&) {});
  const cases::Fragments expected = cases::some_fragments(before->fragments, of_whole);
  const cases::Fragments kept = cases::some_fragments(drawn->fragments, of_cut);
  Check check = judge_changed(whole, before->contract, expected, kept, index);
  add_to_notes(check, "drawn with the case's clip distances, without which the value is right");
  if (of_cut.size() < before->fragments.size()) add_label(check, "cut");
  return check;
}

/// Lines with clip distances of both signs.
Generated generate(Draw& draw) {
  Generated made = random_lines(draw);
  cases::Case& c = made.source;
  c.coverage.reset();
  if (!draw.capabilities().has(cases::Feature::clip_distances)) return made;
  c.clip_distance_count = 1;
  c.clip_distances.clear();
  for (std::size_t i = 0; i < c.positions.size(); ++i) {
    const float distance = draw.uniform(-1, 2);
    c.clip_distances.push_back(distance);
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-clipped-line-keeps-its-values",
     .sentence = "a clipped line keeps its values",
     .reason = "A clip distance takes samples away; the share of the second end is that of the "
               "ends that were given.",
     .exceptions = "centroids; cases without clip distances; contracts that snap vertices",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_lines,
     .unpromised = kDrawsNoLines,
     .takes_lines_and_points = true,
     .covers = {cover_decided(30, "cut"), cover_decided(30, "drawn")}});

}  // namespace
}  // namespace rastercheck::properties::clipped_lines_keep_their_values_law
