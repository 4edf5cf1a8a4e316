// A larger error of conservative coverage (cases::Conservative) permits more, and forbids and
// requires nothing else: a drawing that keeps the backend's contract keeps the contract with a
// larger error.
//
// Why. Outer: the square that must miss the triangle for a pixel to be forbidden grows, and what it
// missed may be met, but not the other way round; what is required does not depend on the error.
// Inner: the square that must lie in the triangle for a pixel to be required grows, and may stick
// out, but not the other way round; what is forbidden does not depend on the error. With shifted
// edges, the half-planes grow likewise.
//
// So for each pixel the two verdicts are equal, or the larger error permits it; else the oracle
// contradicts itself. The drawing is judged by the larger error as well.

#include <algorithm>
#include <array>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/verdicts.h"

namespace rastercheck::properties::larger_error_permits_more_law {
namespace {

using records::FragmentClass;
using records::Verdict;

constexpr std::array kMore{0x1p-9F, 0.25F, 0.5F, 1.0F, 3.0F};

/// Reports the pixels of a triangle whose two verdicts contradict each other.
void compare(std::uint32_t triangle, Verdicts& less, Verdicts& more, Check& check) {
  const oracle::PixelBox box = more.truth(triangle).pixels();
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const cases::SamplePlace place{triangle, static_cast<std::uint32_t>(y),
                                     static_cast<std::uint32_t>(x), 0};
      const Verdict before = less.judge(triangle, place).verdict;
      const Verdict now = more.judge(triangle, place).verdict;
      if (before == now) continue;
      if (now == Verdict::permitted) {
        add_label(check, "permitted by the larger error");
        continue;
      }
      add_violation(check, violation_at(place, FragmentClass::extra,
                                        "the verdict of the smaller error, or permitted",
                                        "a larger error must only permit more"));
    }
  }
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  if (!covers_pixels(backend)) return not_applicable();
  const Result<backends::Drawn> drawn = draw(c, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  cases::Contract larger = drawn->contract;
  if (!larger.conservative) return not_applicable();
  const float more = Choices(choices_of(c)).pick(kMore);
  larger.conservative->error =
      std::min(larger.conservative->error + more, cases::kMaxConservativeReach);
  Check check = judge_drawn(c, larger, drawn->fragments,
                            {.judges_values = false, .counts_coverage = true}, index);
  Verdicts by_less(c, drawn->contract);
  Verdicts by_more(c, larger);
  for (std::uint32_t t = 0; t < c.triangles.size(); ++t) compare(t, by_less, by_more, check);
  return check;
}

const LawRegistration kRegistration(
    {.id = "a-larger-error-of-conservative-coverage-permits-more",
     .sentence = "a larger error of conservative coverage permits more",
     .reason = "A square that grows meets what it met, and sticks out where it stuck out "
               "(RULES §11).",
     .exceptions = "pixels that the larger error permits",
     .generate = &generate_any,
     .check = &check,
     .is_promised = &covers_pixels,
     .unpromised = "the backend covers samples, not whole pixels",
     .covers = {cover(10, "clipped"), cover(25, "permitted by the larger error")}});

}  // namespace
}  // namespace rastercheck::properties::larger_error_permits_more_law
