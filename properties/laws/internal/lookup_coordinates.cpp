#include "properties/laws/internal/lookup_coordinates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "properties/laws/internal/picture_cases.h"

namespace rastercheck::properties {
namespace {

double magnitude(const oracle::ValueRange& range) {
  return std::max(std::abs(range.lo.nearest_double()), std::abs(range.hi.nearest_double()));
}

bool is_within(const oracle::ValueRange& inner, const oracle::ValueRange& outer) {
  return outer.lo <= inner.lo && inner.hi <= outer.hi;
}

}  // namespace

LookupCoordinates::LookupCoordinates(const cases::Case& c, backends::Backend& backend,
                                     const cases::Contract& contract)
    : case_(&c), backend_(&backend), are_drawn_(keeps_fragments_in_pictures(contract)) {}

std::optional<oracle::CoordinateRanges> LookupCoordinates::find(const oracle::TriangleTruth& truth,
                                                                const cases::SamplePlace& place) {
  std::optional<oracle::CoordinateRanges> drawn = drawn_at(place);
  if (!drawn || are_drawn_) return drawn;
  const auto permitted = permitted_coordinates(truth, place);
  const bool is_permitted =
      permitted && is_within(drawn->s, permitted->s) && is_within(drawn->t, permitted->t);
  return is_permitted ? permitted : std::nullopt;
}

std::optional<oracle::CoordinateRanges> LookupCoordinates::drawn_at(
    const cases::SamplePlace& place) {
  if (!has_asked_) {
    has_asked_ = true;
    cases::Case each_alone = *case_;  // a picture's depth test is its pipeline's
    each_alone.depth_test = cases::DepthTest::none;
    Result<cases::Fragments> fragments = backends::fragments_of(draw(each_alone, *backend_));
    if (fragments) {
      FragmentMap by_place = fragments_by_place(*fragments);
      drawn_ = Drawn{std::move(*fragments), std::move(by_place)};
    }
  }
  if (!drawn_) return std::nullopt;
  const auto found = drawn_->by_place.find(place);
  if (found == drawn_->by_place.end()) return std::nullopt;
  const auto values = drawn_->fragments.attributes_of(found->second);
  return ranges_of(values[0], values[1]);
}

std::optional<oracle::CoordinateRanges> ranges_of(float s, float t) {
  if (!std::isfinite(s) || !std::isfinite(t)) return std::nullopt;
  const oracle::Rational exact_s(double{s});
  const oracle::Rational exact_t(double{t});
  return oracle::CoordinateRanges{.s = {exact_s, exact_s}, .t = {exact_t, exact_t}};
}

std::uint32_t farther_coordinate(const oracle::CoordinateRanges& at) {
  return magnitude(at.t) > magnitude(at.s) ? 1 : 0;
}

}  // namespace rastercheck::properties
