#include "properties/laws/internal/value_findings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "properties/float_numbers.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using records::FragmentClass;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

float least_float(double lo, double bound, double unit) {
  return static_cast<float>(std::nextafter(lo - before_rounding(bound) * unit, -kInfinity));
}

float greatest_float(double hi, double bound, double unit) {
  return static_cast<float>(std::nextafter(hi + before_rounding(bound) * unit, kInfinity));
}

ValueFindings::ValueFindings(const cases::Case& c, const cases::Contract& contract)
    : case_(&c), contract_(&contract), verdicts_(c, contract), tally_(c) {}

const cases::ValueBound& ValueFindings::bound_of(std::optional<std::uint32_t> attribute) const {
  if (!attribute) return contract_->bounds.depth;
  return case_->attributes[*attribute].interpolation == cases::Interpolation::smooth
             ? contract_->bounds.smooth
             : contract_->bounds.noperspective;
}

bool ValueFindings::is_one_plane(std::uint32_t triangle) {
  return !contract_->coverage || verdicts_.truth(triangle).has_certain_orientation();
}

bool ValueFindings::is_required(const cases::SamplePlace& place) {
  return verdicts_.judge(place.triangle, place).verdict == records::Verdict::required;
}

std::optional<ValuePromise> ValueFindings::promise_of(const cases::SamplePlace& place,
                                                      std::optional<std::uint32_t> attribute) {
  if (!is_required(place)) return std::nullopt;
  const oracle::TriangleTruth& truth = verdicts_.truth(place.triangle);
  if (attribute && truth.is_value_free(*attribute)) return std::nullopt;
  const auto x = static_cast<int>(place.x);
  const auto y = static_cast<int>(place.y);
  const auto s = static_cast<int>(place.sample);
  const auto range = attribute ? truth.attribute(*attribute, x, y, s) : truth.depth(x, y, s);
  const auto bound =
      truth.value_bound(attribute ? std::optional<std::size_t>(*attribute) : std::nullopt, x, y, s);
  if (!range || !bound) return std::nullopt;

  ValuePromise promise;
  promise.lo = range->lo.enclosure().lo;
  promise.hi = range->hi.enclosure().hi;
  promise.bound = bound->enclosure().hi;
  if (attribute) {
    const double of_vertices = truth.attribute_magnitude(*attribute).enclosure().hi;
    promise.unit = ulp_of(std::max({std::abs(promise.lo), std::abs(promise.hi), of_vertices}));
  } else if (const int bits = cases::unorm_bits(case_->depth_format); bits != 0) {
    promise.unit = 1 / (std::ldexp(1.0, bits) - 1);
    promise.bound += 1;  // stored as either neighbour at most
  } else {
    promise.unit = ulp_of(double{std::max(case_->viewport.min_depth, case_->viewport.max_depth)});
  }
  return promise;
}

void ValueFindings::see(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute) {
  tally_.pass(kind_of(*case_, attribute));
  if (last_ == place) return;
  last_ = place;
  tally_.pass_required(place.triangle);
}

void ValueFindings::report(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute,
                           float actual, const std::string& exact, const std::string& text) {
  tally_.report_passed(violation_at(place, class_of_wrong(actual, FragmentClass::beyond_bound),
                                    exact, text, {kind_of(*case_, attribute), attribute, actual}));
}

Check ValueFindings::finish() {
  const bool is_applicable = last_.has_value();
  if (case_->coverage && is_applicable) tally_.label("snapped");
  Check check = tally_.finish();
  check.is_applicable = is_applicable;
  return check;
}

}  // namespace rastercheck::properties
