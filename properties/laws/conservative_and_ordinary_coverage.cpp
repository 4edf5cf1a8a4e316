// Outer coverage holds the ordinary one, and inner coverage lies in it. For a backend that covers
// whole pixels (cases::Conservative):
//
//   all samples of a covered pixel are drawn                      else they are `missing`
//   outer   a pixel with a sample inside the triangle is drawn    else its samples are `missing`
//   inner   all samples of a drawn pixel are in the triangle      else they are `extra`
//
// Why. The triangle's inner points about a sample strictly inside it lie in the pixel's open
// square, too, wherever in the pixel the sample is, so the square meets the triangle. If the square
// lies in the triangle, its samples are strictly inside. Which samples those are is asked of the
// oracle under the same contract, but for samples, which it decides by other means than pixels. If
// vertices are snapped, it answers for all positions that the contract allows.
//
// Left out are, for outer coverage, samples that only a tie gives to the triangle: where clip
// planes leave nothing but an edge, a sample on it may be covered, while the pixel need not be. For
// inner coverage: samples on the border of a pixel (two of the pattern of 16), through which an
// edge may go. Each triangle is drawn as if alone: the case's depth test is removed.

#include <cstdint>
#include <set>

#include "cases/sample_pattern.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"

namespace rastercheck::properties::conservative_and_ordinary_coverage_law {
namespace {

using cases::ConservativeKind;
using records::FragmentClass;
using records::Verdict;

class CoverageComparison {
 public:
  CoverageComparison(const cases::Case& c, const cases::Contract& contract,
                     const cases::Fragments& drawn)
      : case_(&c),
        kind_(contract.conservative->kind),
        verdicts_(c, of_samples(contract)),
        pattern_(cases::standard_pattern(c.framebuffer.samples)),
        tally_(c) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const cases::SamplePlace place = drawn.place_of(i);
      if (is_of_case(c, place)) drawn_.insert(place);
    }
  }

  Check run() {
    check_whole_pixels();
    if (kind_ == ConservativeKind::inner) {
      check_inner();
    } else {
      for (std::uint32_t t = 0; t < case_->triangles.size(); ++t) check_outer(t);
    }
    tally_.label_drawn();
    return tally_.finish();
  }

 private:
  static cases::Contract of_samples(cases::Contract contract) {
    contract.conservative.reset();
    return contract;
  }

  std::uint32_t samples() const { return static_cast<std::uint32_t>(case_->framebuffer.samples); }

  void check_whole_pixels() {
    for (const cases::SamplePlace& place : drawn_) {
      tally_.see(place.triangle);
      for (std::uint32_t s = 0; s < samples(); ++s) {
        const cases::SamplePlace other{place.triangle, place.y, place.x, s};
        if (drawn_.contains(other) || !reported_.insert(other).second) continue;
        tally_.report(violation_at(other, FragmentClass::missing,
                                   "required: another sample of the pixel is drawn",
                                   "all samples of a covered pixel are covered"));
      }
    }
  }

  /// True if a sample lies on the border of its pixel.
  bool is_on_border(std::uint32_t sample) const {
    return pattern_[sample].x == 0 || pattern_[sample].y == 0;
  }

  void check_outer(std::uint32_t triangle) {
    const oracle::PixelBox box = verdicts_.truth(triangle).pixels();
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        for (std::uint32_t s = 0; s < samples(); ++s) {
          const cases::SamplePlace place{triangle, static_cast<std::uint32_t>(y),
                                         static_cast<std::uint32_t>(x), s};
          const records::SampleVerdict decision = verdicts_.judge(triangle, place);
          if (decision.verdict != Verdict::required) continue;
          if (decision.reason != records::Reason::inside) continue;
          see_required(place);
          break;  // one sample is enough to require the pixel
        }
      }
    }
  }

  void see_required(const cases::SamplePlace& place) {
    if (drawn_.contains(place)) return tally_.pass_required(place.triangle);
    ++tally_.counts().required;
    if (!reported_.insert(place).second) return;
    tally_.report(violation_at(place, FragmentClass::missing,
                               "required: the sample lies in the triangle",
                               "outer coverage holds all samples of the triangle"));
  }

  void check_inner() {
    for (const cases::SamplePlace& place : drawn_) {
      if (is_on_border(place.sample)) continue;
      if (verdicts_.judge(place.triangle, place).verdict != Verdict::forbidden) {
        tally_.pass(records::AttributeKind::coverage);
        continue;
      }
      tally_.report(violation_at(place, FragmentClass::extra,
                                 "forbidden: the sample is not in the triangle",
                                 "inner coverage holds only pixels that lie in the triangle"));
    }
  }

  const cases::Case* case_;
  ConservativeKind kind_;
  Verdicts verdicts_;
  std::span<const cases::SamplePosition> pattern_;
  std::set<cases::SamplePlace> drawn_;
  std::set<cases::SamplePlace> reported_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!covers_pixels(backend)) return not_applicable();
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return CoverageComparison(clip, drawn->contract, drawn->fragments).run();
}

const LawRegistration kRegistration(
    {.id = "outer-coverage-holds-the-ordinary-one-and-inner-lies-in-it",
     .sentence = "outer coverage holds the ordinary one, and inner lies in it",
     .reason = "A pixel with a point of the triangle at a sample touches the triangle, and a pixel "
               "that lies in the triangle has all its samples there (RULES §11).",
     .exceptions = "samples on the triangle's border, and for inner coverage on their pixel's",
     .generate = &generate_any,
     .check = &check,
     .is_promised = &covers_pixels,
     .unpromised = "the backend covers samples, not whole pixels",
     .covers = {cover(10, "clipped"), cover(32, "drawn"), cover(11, "several samples"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::conservative_and_ordinary_coverage_law
