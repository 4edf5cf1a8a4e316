// Outer ranges of values, against the exact ranges and bounds.

#include "oracle/internal/value_ranges.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "oracle/internal/rational_number.h"
#include "oracle/ulp.h"
#include "tests/oracle/open_case.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::value_ranges_test {
namespace {

/// The exact range, widened by the exact bound; empty if every value is permitted.
std::optional<FieldRange> permitted(const TriangleTruth& truth,
                                    std::optional<std::size_t> attribute, const SampleAt& at) {
  if (truth.is_value_free(attribute)) return std::nullopt;
  const auto range = attribute ? truth.attribute(*attribute, at.x, at.y, at.sample)
                               : truth.depth(at.x, at.y, at.sample);
  const auto bound = truth.value_bound(attribute, at.x, at.y, at.sample);
  if (!range || !bound) return std::nullopt;
  const auto unit = [&](const Rational& end) {
    const cases::Viewport& viewport = truth.setup().scene->source().viewport;
    const Field magnitude = attribute
                                ? to_field(truth.attribute_magnitude(*attribute))
                                : Field(double{std::max(viewport.min_depth, viewport.max_depth)});
    return to_field(
        ulp(to_rational(std::max(magnitude, rastercheck::oracle::magnitude(to_field(end))))));
  };
  const Field& ulps = to_field(*bound);
  return FieldRange{to_field(range->lo) - ulps * unit(range->lo),
                    to_field(range->hi) + ulps * unit(range->hi)};
}

struct Judged {
  int values = 0;
  int free = 0;
  /// Fails if a range leaves out a permitted value, or is free although the values are not.
  void check(const ValueSpan& span, const std::optional<FieldRange>& exact) {
    ++values;
    if (!exact) {
      RC_ASSERT(span.is_free);
      ++free;
      return;
    }
    RC_ASSERT(!span.is_free);
    RC_ASSERT(Field(span.lo) <= exact->lo);
    RC_ASSERT(Field(span.hi) >= exact->hi);
  }
};

Judged check_all(const cases::Case& c, const cases::Contract& contract) {
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  const TriangleFilter filter(truth.setup(), truth.setup().pixels(), Level::filter);
  const std::size_t width = 1 + c.attributes.size();
  ValueRanges ranges(scene, std::vector<bool>(width, true));
  ranges.begin(truth, filter);
  const PixelBox box = truth.pixels();
  std::vector<SampleAt> places;
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      for (int s = 0; s < c.framebuffer.samples; ++s) {
        const bool is_drawn = truth.judge(x, y, s).verdict != records::Verdict::forbidden;
        if (is_drawn && places.size() < kBatchSize) places.push_back({x, y, s});
      }
    }
  }
  std::vector<ValueSpan> spans(places.size() * width);
  Judged judged;
  if (places.empty()) return judged;
  ranges.find(places, spans);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t v = 0; v < width; ++v) {
      const auto attribute = v == 0 ? std::nullopt : std::optional(v - 1);
      judged.check(spans[i * width + v], permitted(truth, attribute, places[i]));
    }
  }
  return judged;
}

/// A bound whose terms all count.
cases::ValueBound varying_bound() {
  cases::ValueBound bound;
  bound.per_horizon = one_of({0.0F, 0.5F, 8.0F});
  bound.per_condition = one_of({0.0F, 1.0F, 0x1p-6F});
  bound.range_share = one_of({0.0F, 0.0F, 0x1p-8F});
  return bound;
}

// Kills: a range about the wrong sample; a bound without g, K or its share; a forgotten clamp.
RC_GTEST_PROP(ValueRanges, HoldAllThatAClosedContractPermits, ()) {
  cases::Case c = random_exact_case();
  if (*rc::gen::arbitrary<bool>()) cover_most(c);
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth = varying_bound();
  contract.bounds.noperspective = varying_bound();
  contract.bounds.depth.constant = one_of({0.5F, 3.0F, 0x1p24F});
  const Judged judged = check_all(c, contract);
  RC_CLASSIFY(judged.values > judged.free, "judges values");
}

// Kills: using the radius R of samples for values at pixel centres; slopes of the wrong sign; a
// range that holds only the vertices' values.
RC_GTEST_PROP(ValueRanges, HoldAllThatAnOpenContractPermits, ()) {
  const cases::Case c = open_case();
  cases::Contract contract = open_contract(c);
  if (*rc::gen::arbitrary<bool>()) contract.bounds.smooth = varying_bound();
  const Judged judged = check_all(c, contract);
  RC_CLASSIFY(judged.values > judged.free, "judges values");
}

// An exact contract's ranges are as narrow as its bound: half an ULP, up to doubles' roundings.
TEST(ValueRanges, AreNarrowUnderAnExactContract) {
  const cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                                   {{{-1, -1, 0.5F, 1}, {3, -1, 0.5F, 1}, {-1, 3, 0.5F, 1}}},
                                   {{{0.0F}, {1.0F}, {0.0F}}});
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  const TriangleFilter filter(truth.setup(), truth.setup().pixels(), Level::filter);
  ValueRanges ranges(scene, {true, true});
  ranges.begin(truth, filter);
  const SampleAt at{1, 2, 0};
  std::vector<ValueSpan> spans(2);
  ranges.find({&at, 1}, spans);
  // At (1.5, 2.5) of 4 × 4 pixels a is 1.5/8; the ULP of values up to 1 is 2^-23.
  EXPECT_NEAR(spans[1].lo, 0.1875 - 0x1p-24, 0x1p-45);
  EXPECT_NEAR(spans[1].hi, 0.1875 + 0x1p-24, 0x1p-45);
  EXPECT_NEAR(spans[0].lo, 0.5 - 0x1p-24, 0x1p-45);
}

}  // namespace
}  // namespace rastercheck::oracle::value_ranges_test
