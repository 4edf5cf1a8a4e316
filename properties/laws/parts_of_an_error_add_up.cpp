// The parts of an error add up to the whole: the contributions of a drawing's stages to a value,
// each computed from the stage's actual input, sum to the drawn value minus the exact value,
// without a remainder. The parts are the differences V_k − V_(k−1) in a chain of values
// (oracle/stage_split.h) from the exact value to the drawn value, so they sum exactly if the chain
// has both ends and no gaps.
//
// The law checks up to four fragments of each triangle and kMostFragments of a case, for the split
// by the backend's trace and for the split that needs no trace. The parts must sum to actual −
// exact in exact numbers. The exact value must be that of the case as given, including its camera.
// The total in ULP must agree with the difference of the drawn and the exact value. The transform's
// part of the error must be the same, whether computed from the positions that the backend reports
// or from those that it was given. Fragments that must not be drawn are left to laws about
// coverage. The sizes of parts are counted by stage and stratum. Triangles are traced one by one,
// so the depth test is removed.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/exact_contract.h"
#include "oracle/stage_split.h"
#include "oracle/triangle_truth.h"
#include "oracle/ulp.h"
#include "properties/camera_cases.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"

namespace rastercheck::properties::parts_of_an_error_add_up_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::SampleTrace;

/// The greatest numbers of fragments of a triangle, and of a case, whose errors are split.
constexpr std::size_t kMostOfTriangle = 4;
constexpr std::size_t kMostFragments = 64;

/// Returns the transform's part of the error; nothing if the split has none, because the value is
/// undefined for the transformed positions (1/w <= 0 at a sample that only snapping covers).
std::optional<oracle::Rational> transform_part(const oracle::ExactSplit& split) {
  const auto& parts = split.parts;
  if (parts.empty() || parts.front().stage != records::Stage::transform) return std::nullopt;
  return parts.front().error;
}

/// True if the transform's part of the error is different for the positions that the backend
/// reports and for the positions that it was given.
bool is_of_other_positions(const oracle::ExactSplit& told, const oracle::ExactSplit& seen) {
  const std::optional<oracle::Rational> received = transform_part(told);
  const std::optional<oracle::Rational> handed = transform_part(seen);
  return told.exact == seen.exact && received && handed && *received != *handed;
}

class SplitCheck {
 public:
  /// `given` keeps its camera, if any; `clip` is the case as drawn.
  SplitCheck(const cases::Case& given, const cases::Case& clip, const cases::Fragments& drawn,
             backends::Backend& backend)
      : given_(&given),
        case_(&clip),
        drawn_(&drawn),
        backend_(&backend),
        contract_(backend.contract(clip)),
        verdicts_(clip, contract_),
        exact_(given, cases::exact_contract(contract_)),
        tally_(clip) {}

  Result<Check> run() {
    for (const std::size_t i : fragments()) {
      if (error_) break;
      check_fragment(i);
    }
    if (error_) return tl::unexpected(*error_);
    return tally_.finish();
  }

 private:
  /// The fragments to check, ordered by triangle.
  std::vector<std::size_t> fragments() const {
    std::map<std::uint32_t, std::vector<std::size_t>> by_triangle;
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      if (is_of_case(*case_, drawn_->place_of(i))) by_triangle[drawn_->triangle[i]].push_back(i);
    }
    std::vector<std::size_t> all;
    for (const auto& [triangle, of_triangle] : by_triangle) {
      const std::vector<std::size_t> some = some_of(of_triangle, kMostOfTriangle);
      all.insert(all.end(), some.begin(), some.end());
    }
    return some_of(all, kMostFragments);
  }

  void check_fragment(std::size_t i) {
    const cases::SamplePlace place = drawn_->place_of(i);
    if (verdicts_.judge(place.triangle, place).verdict == records::Verdict::forbidden) return;
    std::optional<SampleTrace> trace;
    if (backends::Tracer* const tracer = backend_->tracer()) {
      Result<std::optional<SampleTrace>> told = tracer->trace(*case_, place);
      if (!told) {
        error_ = told.error();
        return;
      }
      trace = *std::move(told);
    }
    if (!split_ || triangle_ != place.triangle) {
      triangle_ = place.triangle;
      split_ = std::make_unique<oracle::StageSplit>(*given_, *case_, contract_, triangle_);
      truth_ = std::make_unique<oracle::TriangleTruth>(exact_, triangle_);
    }
    tally_.pass_required(place.triangle);
    check_value(place, std::nullopt, drawn_->depth[i], trace);
    const auto attributes = drawn_->attributes_of(i);
    for (std::uint32_t a = 0; a < attributes.size(); ++a) {
      check_value(place, a, attributes[a], trace);
    }
  }

  void check_value(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute,
                   float actual, const std::optional<SampleTrace>& trace) {
    const auto& [triangle, y, x, sample] = place;
    const auto seen = split_->untraced(attribute, x, y, sample, actual);
    if (!seen) return;  // not finite, or undefined
    std::optional<oracle::ExactSplit> told;
    if (trace) {
      told = split_->traced(attribute, x, y, sample, actual, *trace);
      if (!told) return report(place, attribute, actual, "a trace of the drawn value");
    }
    const AttributeKind kind = kind_of(*case_, attribute);
    for (const auto& split : {seen, told}) {
      if (!split) continue;
      const std::string expected = fault_of(*split, place, actual);
      if (!expected.empty()) return report(place, attribute, actual, expected);
    }
    if (told && is_of_other_positions(*told, *seen)) {
      return report(place, attribute, actual, "a trace of the clip positions that were passed on");
    }
    tally_.pass(kind);
    if (kind == AttributeKind::flat) return;
    const records::Stratum stratum = split_->stratum();
    for (const records::StagePart& part : enclose(told ? *told : *seen).parts) {
      tally_.add_part(kind, stratum, part);
      if (part.error != records::Enclosure{0, 0}) tally_.label(records::to_string(part.stage));
    }
  }

  /// Returns what is expected instead of a wrong split; empty if the split is right.
  std::string fault_of(const oracle::ExactSplit& split, const cases::SamplePlace& place,
                       float actual) {
    if (!adds_up(split, actual)) return "parts that add up to the error";
    // A centroid's place may be open, and the value at a sample that only snapping covers is
    // undefined.
    const std::optional<std::uint32_t> attribute = split.attribute;
    const bool is_centroid =
        attribute && case_->attributes[*attribute].location == cases::Location::centroid;
    const auto x = static_cast<int>(place.x);
    const auto y = static_cast<int>(place.y);
    const auto sample = static_cast<int>(place.sample);
    const auto range =
        attribute ? truth_->attribute(*attribute, x, y, sample) : truth_->depth(x, y, sample);
    if (range && range->lo == range->hi && !is_centroid && split.exact != range->lo) {
      return "parts of the error against " + range->lo.to_string();
    }
    if (!attribute) return "";
    const records::Enclosure total =
        oracle::scale_ulp_error(actual, split.exact, truth_->attribute_magnitude(*attribute));
    if (enclose(split).total != total) return "a total of " + to_decimal(total, 9) + " scale ULP";
    return "";
  }

  void report(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute, float actual,
              const std::string& expected) {
    tally_.report(violation_at(place, FragmentClass::beyond_bound, expected,
                               "the parts do not add up to the error",
                               {kind_of(*case_, attribute), attribute, actual}));
  }

  const cases::Case* given_;
  const cases::Case* case_;
  const cases::Fragments* drawn_;
  backends::Backend* backend_;
  cases::Contract contract_;
  Verdicts verdicts_;
  oracle::SceneTruth exact_;
  Tally tally_;
  std::uint32_t triangle_ = 0;
  // The split and the truth of the current triangle, `triangle_`.
  std::unique_ptr<oracle::StageSplit> split_;
  std::unique_ptr<oracle::TriangleTruth> truth_;
  std::optional<Error> error_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return SplitCheck(c.given(), clip, drawn->fragments, backend).run();
}

/// Makes any case; one case in six has a camera, and half of the cases have snapped vertices.
Generated generate(Draw& draw) {
  Generated made;
  if (draw.one_in(6)) {
    made = {camera_case(draw).source, "with a camera"};
  } else {
    made = generate_any(draw);
  }
  if (draw.one_in(2)) set_snapped_coverage(draw, made.source);
  return made;
}

const LawRegistration kRegistration(
    {.id = "the-parts-of-an-error-add-up-to-the-whole",
     .sentence = "the parts of an error add up to the whole",
     .reason = "Parts are differences of neighbours in one chain of exact numbers, from the exact "
               "value to the drawn one.",
     .exceptions = "values that are no finite numbers, or that the rules leave undefined",
     .generate = &generate,
     .check = &check,
     .covers = {cover(12, "clipped"), cover(15, "several samples"), cover(6, "transform"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::parts_of_an_error_add_up_law
