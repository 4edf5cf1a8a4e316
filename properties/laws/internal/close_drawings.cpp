#include "properties/laws/internal/close_drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "properties/float_numbers.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// The difference of two floats, rounded to a double, has a relative error of at most 2^-53; an
/// allowance, which is a product and a sum of doubles, at most three times as much. A difference
/// beyond this factor certainly exceeds the allowance.
constexpr double kRounded = 1 + 0x1p-50;

class CloseCheck {
 public:
  CloseCheck(const cases::Case& c, const cases::Fragments& expected, const cases::Fragments& drawn,
             const Closeness& closeness)
      : case_(&c), expected_(&expected), drawn_(&drawn), closeness_(&closeness), tally_(c) {}

  Check run() {
    visit_places(
        *expected_, *drawn_,
        [&](const cases::SamplePlace& place, std::size_t before, std::size_t now) {
          see_both(place, before, now);
        },
        [&](const cases::SamplePlace& place, std::size_t /*now*/, const char* exact) {
          see_difference(place, FragmentClass::extra, exact);
        },
        [&](const cases::SamplePlace& place) {
          see_difference(place, FragmentClass::missing, kDrawnBefore);
        });
    tally_.label_drawn();
    return tally_.finish();
  }

 private:
  /// Handles a sample that is not drawn exactly once in each of the two drawings.
  void see_difference(const cases::SamplePlace& place, FragmentClass fragment_class,
                      const char* exact) {
    if (is_of_case(*case_, place) && closeness_->is_open(place)) {
      ++tally_.counts().permitted;
      tally_.label("permitted");
      return;
    }
    tally_.report(violation_at(place, fragment_class, exact, closeness_->note));
  }

  void see_both(const cases::SamplePlace& place, std::size_t before, std::size_t now) {
    ++tally_.counts().required;
    tally_.pass(AttributeKind::coverage);
    if (!is_of_case(*case_, place)) return;
    tally_.see(place.triangle);
    see_value(place, std::nullopt, expected_->depth[before], drawn_->depth[now]);
    for (std::uint32_t a = 0; a < case_->attributes.size(); ++a) {
      see_value(place, a, expected_->attributes_of(before)[a], drawn_->attributes_of(now)[a]);
    }
  }

  std::optional<ValueAllowance> allowed(std::uint32_t triangle,
                                        std::optional<std::uint32_t> attribute) {
    const auto [found, is_new] = allowed_.try_emplace({triangle, attribute});
    if (is_new) found->second = closeness_->allowed(triangle, attribute);
    return found->second;
  }

  void see_value(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute,
                 float before, float now) {
    if (is_same(before, now) && !std::isnan(now)) return;
    const std::optional<ValueAllowance> both = allowed(place.triangle, attribute);
    if (!both) return;
    const double most = greatest_difference(*both, number_of(before), number_of(now));
    const double difference = std::abs(number_of(before) - number_of(now));
    if (difference <= most * kRounded) return;  // always false for NaN
    if (closeness_->is_undefined(place, attribute)) return;
    tally_.report(violation_at(place, class_of_wrong(now, FragmentClass::beyond_bound),
                               fmt::format("at most {:.3g} from {}", most, value_text(before)),
                               closeness_->note, {kind_of(*case_, attribute), attribute, now}));
  }

  const cases::Case* case_;
  const cases::Fragments* expected_;
  const cases::Fragments* drawn_;
  const Closeness* closeness_;
  Tally tally_;
  std::map<std::pair<std::uint32_t, std::optional<std::uint32_t>>, std::optional<ValueAllowance>>
      allowed_;
};

}  // namespace

ValueAllowance depth_allowance(const cases::Case& c, const cases::Contract& contract) {
  const cases::ValueBound& bound = contract.bounds.depth;
  const double size{std::max(std::abs(c.viewport.min_depth), std::abs(c.viewport.max_depth))};
  return {double{bound.constant} + double{bound.absolute} / ulp_of(size), size};
}

std::optional<ValueAllowance> value_allowance(const cases::Case& c, const cases::Contract& contract,
                                              const cases::Triangle& triangle,
                                              std::size_t attribute) {
  using cases::Interpolation;
  const Interpolation interpolation = c.attributes[attribute].interpolation;
  if (interpolation == Interpolation::flat) return ValueAllowance{};
  ValueAllowance allowance;
  double least_w = std::numeric_limits<double>::infinity();
  double greatest_w = 0;
  for (const std::uint32_t vertex : triangle) {
    const double value{c.attributes_of(vertex)[attribute]};
    allowance.magnitude = std::max(allowance.magnitude, std::abs(value));
    least_w = std::min(least_w, double{c.positions[vertex].w});
    greatest_w = std::max(greatest_w, double{c.positions[vertex].w});
  }
  const bool is_smooth = interpolation == Interpolation::smooth;
  const bool is_affine = contract.is_affine(interpolation);
  if (least_w <= 0 && is_affine) return std::nullopt;
  const cases::ValueBound& bound =
      is_smooth ? contract.bounds.smooth : contract.bounds.noperspective;
  if (bound.per_condition > 0 || bound.range_share > 0 || bound.absolute > 0) return std::nullopt;
  allowance.units = double{bound.constant};
  if (bound.per_horizon > 0) {
    const bool is_covered = !contract.coverage || contract.basis == cases::Basis::snapped;
    if (least_w <= 0 || !is_covered) return std::nullopt;
    allowance.units += double{bound.per_horizon} * (is_affine ? 1.0 : greatest_w / least_w);
  }
  return allowance;
}

double greatest_difference(const ValueAllowance& both, double f, double g) {
  if (both.units >= 0x1p22) return std::numeric_limits<double>::infinity();
  const double greater = std::max(std::abs(f), std::abs(g));
  const double most = greater / (1 - both.units * 0x1p-23);
  return both.units * ulp_of(std::max(both.magnitude, most));
}

Check compare_close(const cases::Case& c, const cases::Fragments& expected,
                    const cases::Fragments& drawn, const Closeness& closeness) {
  return CloseCheck(c, expected, drawn, closeness).run();
}

}  // namespace rastercheck::properties
