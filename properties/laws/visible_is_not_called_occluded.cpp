// What is visible is not called occluded: an occlusion culler says of a triangle that nothing of it
// is visible past others only if that is so.
//
// The last triangle of a case is asked about (the occludee); all before it are the occluders. With
// z(q) the least depth of the occluders that cover a sample q, or the depth that the buffer is
// cleared to, a fragment of the occludee at q passes the depth test `less` against the occluders
// iff its depth is less than z(q). If it must pass under every reading that the contract permits –
// the occludee must cover q, and its greatest permitted depth is less than the least permitted
// depth of every occluder that may cover q (oracle/occlusion_truth.h) – then the occludee is
// visible, and "occluded" is wrong: a renderer would drop a triangle that is seen.
//
// "Visible" is never wrong, since a culler may answer so whenever it does not know. Where no sample
// may be visible, the case gets the label "conservative answer", so a run shows how many there are.
// Attributes are left out, because depths and coverage do not depend on them. A case with a single
// triangle has no occluders; its triangle is visible unless it covers nothing.

#include <fmt/format.h>

#include <optional>
#include <string>

#include "oracle/occlusion_truth.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/occluded_cases.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::visible_is_not_called_occluded_law {
namespace {

using records::FragmentClass;
using records::Verdict;

/// The occludee's samples by how certainly they are visible.
struct SeenSamples {
  std::uint64_t visible = 0;
  std::uint64_t open = 0;
  std::uint64_t hidden = 0;
  std::optional<cases::SamplePlace> first_visible;
};

/// The question that the law asks about a case.
cases::Case question_of(const cases::Case& c) {
  cases::Case question = c;
  question.attributes.clear();
  question.attribute_values.clear();
  question.depth_test = cases::DepthTest::less;
  return question;
}

records::Violation wrong_answer(const oracle::OcclusionTruth& truth,
                                const cases::SamplePlace& place) {
  const oracle::OcclusionDepths depths = truth.depths(place);
  const std::string behind =
      depths.nearest ? fmt::format("triangle {} is the nearest occluder there", *depths.nearest)
                     : std::string("no occluder is nearer there than the cleared depth");
  records::Violation violation =
      violation_at(place, FragmentClass::missing,
                   fmt::format("required: its depth is at most {}, that of occluders at least {}",
                               depths.occludee.enclosure().hi, depths.occluders.enclosure().lo),
                   behind);
  violation.actual = "called occluded";
  return violation;
}

void add_labels(const cases::Case& c, const SeenSamples& seen, bool is_occluded, Tally& tally) {
  constexpr std::uint64_t kFew = 2;
  if (c.triangles.size() > 1) tally.label("occluders");
  if (seen.visible > 0) tally.label("visible");
  if (seen.visible > 0 && seen.hidden > 0) tally.label("partly hidden");
  if (seen.visible > 0 && seen.visible <= kFew && seen.hidden > 0) tally.label("narrow gap");
  const bool is_surely_hidden = seen.visible == 0 && seen.open == 0;
  if (is_surely_hidden && seen.hidden > 0) tally.label("hidden");
  if (is_surely_hidden && seen.hidden == 0) tally.label("covers nothing");
  if (is_surely_hidden && !is_occluded) tally.label("conservative answer");
  if (seen.visible == 0 && seen.open > 0) tally.label("left open");
  for (std::size_t t = 0; t + 1 < c.triangles.size(); ++t) {
    for (const std::uint32_t vertex : c.triangles[t]) {
      if (c.positions[vertex].w <= 0) tally.label("occluder behind the eye");
    }
  }
}

Check judge_answer(const cases::Case& c, const cases::Contract& contract, bool is_occluded) {
  const oracle::SceneTruth scene(c, contract);
  const oracle::OcclusionTruth truth(scene, c.triangles.size() - 1);
  Tally tally(c);
  SeenSamples seen;
  records::LevelCounts levels;
  truth.for_each_sample(
      [&seen](const cases::SamplePlace& place, Verdict is_visible) {
        ++(is_visible == Verdict::required    ? seen.visible
           : is_visible == Verdict::forbidden ? seen.hidden
                                              : seen.open);
        if (is_visible == Verdict::required && !seen.first_visible) seen.first_visible = place;
      },
      levels);
  tally.add_levels(levels);
  tally.counts().required = seen.visible;
  tally.counts().permitted = seen.open;
  tally.counts().forbidden = seen.hidden;
  if (seen.visible + seen.open + seen.hidden > 0) {
    tally.see(static_cast<std::uint32_t>(c.triangles.size() - 1));
  }
  add_labels(c, seen, is_occluded, tally);
  if (is_occluded && seen.first_visible) {
    tally.report(wrong_answer(truth, *seen.first_visible));
  } else {
    tally.pass(records::AttributeKind::coverage, seen.visible);
  }
  return tally.finish();
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (backend.occlusion_culler() == nullptr) {
    return not_applicable("the backend answers no occlusion queries");
  }
  if (c.triangles.empty()) return not_applicable("no triangle to ask about");
  const cases::Case question = question_of(c);
  const Result<bool> answer = is_occluded(question, question.triangles.size() - 1, backend);
  if (!answer) return tl::unexpected(answer.error());
  return judge_answer(question, backend.contract(question), *answer);
}

bool is_promised(backends::Backend& backend) { return backend.occlusion_culler() != nullptr; }

const LawRegistration kRegistration(
    {.id = "what-is-visible-is-not-called-occluded",
     .sentence = "what is visible is not called occluded",
     .reason =
         "A fragment that is nearer than all that covers its sample passes the depth test, so "
         "its triangle is visible.",
     .exceptions =
         "backends that answer no occlusion queries; samples that the contract leaves open",
     .generate = &occluded_case,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend answers no occlusion queries",
     .covers = {cover(50, "occluders"), cover_decided(18, "visible"), cover_decided(12, "hidden"),
                cover_decided(7, "partly hidden"), cover_decided(1, "narrow gap"),
                cover(5, "occluder behind the eye"), cover(11, "several samples")}});

}  // namespace
}  // namespace rastercheck::properties::visible_is_not_called_occluded_law
