// Constants stay constant: an attribute with the same value at all three vertices has that value
// everywhere, to the bit; a zero may have either sign, unless the contract keeps signs of zero.
//
// How far the contract implies this. A bound of b scale ULP includes 1/2 for the rounding to
// float32, so the result before rounding is off by less than e = b − 1/2. If e < 1/4, rounding to
// nearest gives the constant back: neighbouring floats are an ulp away, or half an ulp below a
// power of two, so the nearest midpoint between floats is 1/4 ulp from the constant. If the promise
// is weaker, as towards the horizon, nothing is judged, unless the contract promises to keep
// constants whatever the bound.
//
// Attributes: smooth and noperspective ones, at every location; flat attributes are copies anyway.
// Samples: required ones, so that snapping and clipping of the outline do not matter.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "oracle/ulp.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"

namespace rastercheck::properties::constants_stay_constant_law {
namespace {

using oracle::Rational;
using records::AttributeKind;
using records::FragmentClass;

/// A bound b must be below this, so that b − 1/2 < 1/4.
constexpr double kMostBound = 0.75;

bool is_constant(const cases::Case& c, const cases::Triangle& triangle, std::size_t attribute) {
  const float first = c.attributes_of(triangle[0])[attribute];
  return is_same(first, c.attributes_of(triangle[1])[attribute]) &&
         is_same(first, c.attributes_of(triangle[2])[attribute]);
}

/// True if the promise may be strong enough somewhere. In cases::ValueBound, g >= 1 except at
/// extrapolated centres, K >= 1, and a constant's range is 0.
bool may_be_exact(const cases::ValueBound& bound) {
  return double{bound.constant} + double{bound.per_horizon} + double{bound.per_condition} <
         kMostBound;
}

/// Indices of the triangle's attributes that the law checks.
std::vector<std::uint32_t> constants_of(const cases::Case& c, const cases::Contract& contract,
                                        const cases::Triangle& triangle) {
  std::vector<std::uint32_t> constants;
  for (std::uint32_t a = 0; a < c.attributes.size(); ++a) {
    const cases::Interpolation interpolation = c.attributes[a].interpolation;
    if (interpolation == cases::Interpolation::flat) continue;
    const bool is_smooth = interpolation == cases::Interpolation::smooth;
    const cases::ValueBound& bound =
        is_smooth ? contract.bounds.smooth : contract.bounds.noperspective;
    const bool is_kept = contract.keeps_constants || may_be_exact(bound);
    if (is_kept && is_constant(c, triangle, a)) constants.push_back(a);
  }
  return constants;
}

class ConstantsCheck {
 public:
  ConstantsCheck(const cases::Case& c, const cases::Contract& contract,
                 const cases::Fragments& drawn)
      : case_(&c),
        keeps_constants_(contract.keeps_constants),
        keeps_sign_of_zero_(contract.keeps_sign_of_zero),
        drawn_(&drawn),
        verdicts_(c, contract),
        tally_(c) {
    for (const cases::Triangle& triangle : c.triangles) {
      constants_.push_back(constants_of(c, contract, triangle));
    }
  }

  Check run() {
    const bool has_some = std::any_of(constants_.begin(), constants_.end(),
                                      [](const auto& of_triangle) { return !of_triangle.empty(); });
    if (!has_some)
      return not_applicable(
          "no triangle has a constant attribute that is promised to stay constant");
    for (std::size_t i = 0; i < drawn_->size(); ++i) check_fragment(i);
    return tally_.finish();
  }

 private:
  void check_fragment(std::size_t i) {
    const cases::SamplePlace place = drawn_->place_of(i);
    if (!is_of_case(*case_, place) || constants_[place.triangle].empty()) return;
    const records::SampleVerdict decision = verdicts_.judge(place.triangle, place);
    if (decision.verdict != records::Verdict::required) return;
    tally_.pass_required(place.triangle);
    if (decision.reason != records::Reason::inside) {
      tally_.label(records::to_string(decision.reason));
    }
    for (const std::uint32_t a : constants_[place.triangle]) {
      check_attribute(place, a, drawn_->attributes_of(i)[a]);
    }
  }

  void check_attribute(const cases::SamplePlace& place, std::uint32_t attribute, float actual) {
    const oracle::TriangleTruth& truth = verdicts_.truth(place.triangle);
    if (truth.is_value_free(attribute)) return;
    const cases::Attribute& declared = case_->attributes[attribute];
    const bool may_be_undefined = declared.location == cases::Location::center;
    if (may_be_undefined && verdicts_.is_undefined(place, attribute)) return;
    const auto promised =
        truth.value_bound(attribute, static_cast<int>(place.x), static_cast<int>(place.y),
                          static_cast<int>(place.sample));
    const auto bound = promised ? std::optional(promised->enclosure()) : std::nullopt;
    const bool is_within_reach = bound && bound->hi < kMostBound;
    if (!is_within_reach && !keeps_constants_) return tally_.label("bound too wide");

    tally_.label("constant attribute");
    const float expected = case_->attributes_of(case_->triangles[place.triangle][0])[attribute];
    if (expected == 0) tally_.label("constant zero");
    const AttributeKind kind = records::kind_of(declared.interpolation);
    const FragmentClass found = class_of(actual, expected);
    const bool is_free = found == FragmentClass::wrong_sign_of_zero && !keeps_sign_of_zero_;
    if (found == FragmentClass::correct || is_free) return tally_.pass(kind);
    const Rational exact{double{expected}};
    records::Violation violation =
        violation_at(place, found, exact.to_string(),
                     "all three vertices have " + value_text(expected), {kind, attribute, actual});
    violation.bound = bound;
    if (std::isfinite(actual)) {
      violation.error =
          oracle::scale_ulp_error(actual, exact, truth.attribute_magnitude(attribute));
    }
    tally_.report(violation);
  }

  const cases::Case* case_;
  bool keeps_constants_;
  bool keeps_sign_of_zero_ = true;
  const cases::Fragments* drawn_;
  std::vector<std::vector<std::uint32_t>> constants_;  ///< [triangle]: attributes
  Verdicts verdicts_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, [](const cases::Case& clip, const backends::Drawn& drawn) {
    return ConstantsCheck(clip, drawn.contract, drawn.fragments).run();
  });
}

float random_constant(Draw& draw) {
  switch (draw.between(0, 7)) {
    case 0:
      return 0.0F;
    case 1:
      return -0.0F;
    case 2:
      return -1.0F;
    case 3:
      return draw.spread(-149, -120);
    case 4:
      return draw.spread(100, 127);
    case 5:  // a power of two, below which floats are twice as close, or a float beside one
      return draw.pick(std::array{1.0F, 0x1.fffffep-1F, 0x1.000002p+0F, -0x1p20F, 0x1p-20F});
    default:
      return draw.spread(-8, 8);
  }
}

/// Makes most attributes constant over all vertices. A third of the cases have snapped vertices,
/// and clipping adds further snapped vertices.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  ensure_attribute(c);
  const std::size_t count = c.attributes.size();
  for (std::size_t a = 0; a < count; ++a) {
    if (a > 0 && draw.one_in(4)) continue;
    const float constant = random_constant(draw);
    for (std::size_t v = 0; v < c.positions.size(); ++v) {
      c.attribute_values[v * count + a] = constant;
    }
  }
  if (draw.one_in(3)) set_snapped_coverage(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "constants-stay-constant",
     .sentence = "constants stay constant",
     .reason = "Σ c e_i / Σ e_i is c, and a bound below 3/4 scale ULP leaves no other float.",
     .exceptions = "values whose bound is wider than that, unless the contract promises to keep "
                   "constants; flat attributes, which are copies",
     .generate = &generate,
     .check = &check,
     .covers = {cover(13, "clipped"), cover(43, "constant attribute"), cover(14, "constant zero"),
                cover(17, "several samples"), cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::constants_stay_constant_law
