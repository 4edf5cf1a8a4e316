// Screen derivatives stay within the bound: ∂r/∂u and ∂r/∂v of every attribute of a correctly drawn
// fragment are numbers no farther from the exact derivatives than the contract says
// (cases::Contract). This follows from RULES §4, which makes derivatives as exact as the values.
//
// Attributes: those with a single exact derivative. This excludes noperspective attributes with
// some w <= 0, centroids whose place is open, and all attributes if the contract allows several
// placements. Samples: required ones; an evenly spread selection if a case has many fragments.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"

namespace rastercheck::properties::derivatives_stay_within_the_bound_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// The greatest number of fragments of a case that are judged.
constexpr std::size_t kMostFragments = 64;

class DerivativesCheck {
 public:
  DerivativesCheck(const cases::Case& c, const cases::Contract& contract,
                   const cases::Fragments& drawn)
      : case_(&c),
        bound_(*contract.derivative_bound),
        drawn_(&drawn),
        verdicts_(c, contract),
        tally_(c) {}

  Check run() {
    std::vector<std::size_t> all(drawn_->size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const std::size_t i : some_of(all, kMostFragments)) check_fragment(i);
    return tally_.finish();
  }

 private:
  void check_fragment(std::size_t i) {
    const cases::SamplePlace place = drawn_->place_of(i);
    if (!is_of_case(*case_, place)) return;
    const records::SampleVerdict decision = verdicts_.judge(place.triangle, place);
    if (decision.verdict != records::Verdict::required) return;
    tally_.pass_required(place.triangle);
    if (decision.reason != records::Reason::inside) {
      tally_.label(records::to_string(decision.reason));
    }
    for (std::uint32_t a = 0; a < case_->attributes.size(); ++a) check_attribute(i, place, a);
  }

  void check_attribute(std::size_t i, const cases::SamplePlace& place, std::uint32_t attribute) {
    const oracle::TriangleTruth& truth = verdicts_.truth(place.triangle);
    if (truth.is_value_free(attribute)) return;
    const auto x = static_cast<int>(place.x);
    const auto y = static_cast<int>(place.y);
    const auto s = static_cast<int>(place.sample);
    const auto computed = drawn_->derivatives_of(i).subspan(std::size_t{attribute} * 2).first<2>();
    const auto judged = truth.judge_derivatives(attribute, x, y, s, computed, bound_);
    if (!judged) return tally_.label("no one derivative");
    const AttributeKind kind = records::kind_of(case_->attributes[attribute].interpolation);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const oracle::JudgedDerivative& one = (*judged)[axis];
      if (one.fragment_class == FragmentClass::correct) {
        tally_.pass(kind);
        continue;
      }
      const auto exact = truth.scaled_derivatives(attribute, x, y, s);
      records::Violation violation = violation_at(
          place, one.fragment_class, (axis == 0 ? exact->exact.du : exact->exact.dv).to_string(),
          axis == 0 ? "the derivative along window x" : "the derivative along window y",
          {kind, attribute, computed[axis]});
      violation.error = one.error;
      violation.bound = records::Enclosure{double{bound_}, double{bound_}};
      tally_.report(violation);
    }
  }

  const cases::Case* case_;
  float bound_;
  const cases::Fragments* drawn_;
  Verdicts verdicts_;
  Tally tally_;
};

Check find(const cases::Case& c, const backends::Drawn& drawn) {
  const cases::Fragments& fragments = drawn.fragments;
  const bool has_derivatives = fragments.size() == 0 || !fragments.derivatives.empty();
  if (!drawn.contract.derivative_bound || c.attributes.empty() || !has_derivatives) {
    return not_applicable("the backend promises no derivatives, or the case has no attributes");
  }
  return DerivativesCheck(c, drawn.contract, fragments).run();
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, &find);
}

/// Makes any case with at least one attribute.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  ensure_attribute(draw, made.source);
  return made;
}

bool is_promised(backends::Backend& backend) {
  return backend.contract({}).derivative_bound.has_value();
}

const LawRegistration kRegistration(
    {.id = "screen-derivatives-stay-within-the-bound",
     .sentence = "screen derivatives stay within the bound",
     .reason = "∂r/∂u = (N_u − r D_u)/D is as exact as the value is (RULES §4).",
     .exceptions = "noperspective values with some w <= 0, centroids whose place is open, values "
                   "that the contract leaves in a range; backends that promise no derivatives",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend promises no bound for derivatives",
     .covers = {cover(12, "clipped"), cover(5, "no one derivative"), cover(17, "several samples"),
                cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::derivatives_stay_within_the_bound_law
