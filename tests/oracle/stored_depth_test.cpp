// Depths with a bias and depths in a unorm format (RULES §8). Expected numbers are calculated by
// hand.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "oracle/fragments.h"
#include "oracle/judge.h"
#include "oracle/stored_values.h"
#include "tests/oracle/cascade.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/open_case.h"
#include "tests/oracle/random_case.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::stored_depth_test {
namespace {

using records::FragmentClass;

/// A triangle over the upper left half of 8×8 pixels whose depth is d + x/8 · dx + y/8 · dy at the
/// window position (x, y), before bias.
cases::Case plane(float d, float dx = 0, float dy = 0, cases::Rules rules = cases::Rules::vulkan) {
  const auto at = [&](float u, float v) { return d + u * dx + v * dy; };
  return small_case(rules, 8, 8,
                    {{{-1, -1, at(0, 0), 1}, {3, -1, at(2, 0), 1}, {-1, 3, at(0, 2), 1}}});
}

/// The exact depth at the sample of pixel (0, 0), as it is before it is stored.
std::string depth_of(const cases::Case& c) {
  const SceneTruth scene(c, cases::contract_of(c));
  return to_string(TriangleTruth(scene, 0).depth(0, 0, 0));
}

/// The numbers that may be stored at the sample of pixel (0, 0): "least greatest", in steps.
std::string steps_of(const cases::Case& c, const cases::Contract& contract) {
  const SceneTruth scene(c, contract);
  const auto numbers = TriangleTruth(scene, 0).permitted_numbers(std::nullopt, 0, 0, 0);
  const double steps = std::ldexp(1.0, cases::unorm_bits(c.depth_format)) - 1;
  const auto text = [steps](float f) { return std::to_string(std::lround(double{f} * steps)); };
  return text(numbers->least) + " " + text(numbers->greatest);
}
std::string steps_of(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.depth.constant = 0;
  return steps_of(c, contract);
}

FragmentClass class_of(const cases::Case& c, const cases::Contract& contract, float depth) {
  const SceneTruth scene(c, contract);
  cases::Fragments drawn = perfect(scene);
  for (float& one : drawn.depth) one = depth;
  FragmentClass found = FragmentClass::correct;
  judge(scene, drawn, from(Level::filter), [&](const JudgedSample& sample, const TriangleTruth*) {
    if (sample.place == cases::SamplePlace{0, 0, 0, 0}) {
      found = sample.values.front().fragment_class;
    }
  });
  return found;
}

TEST(DepthBias, AddsTheConstantInUnitsOfTheFormat) {
  cases::Case c = plane(0.5F);
  c.depth_bias = {.constant = 3};
  EXPECT_EQ(depth_of(c), "8388611/16777216");  // 1/2 + 3 · 2^-24, as e = −1
  c.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(depth_of(c), "32771/65536");  // 1/2 + 3 · 2^-16
  c.depth_format = cases::DepthFormat::unorm24;
  EXPECT_EQ(depth_of(c), "8388611/16777216");  // 1/2 + 3 · 2^-24
}

// 1/65535 as a float32 is 0x1.0001p-16: the next bits of the quotient are too small to count.
TEST(DepthBias, HasTheLeastPositiveValueAsUnitUnderD3d) {
  cases::Case c = plane(0.5F, 0, 0, cases::Rules::d3d);
  c.depth_format = cases::DepthFormat::unorm16;
  c.depth_bias = {.constant = 1};
  EXPECT_EQ(depth_of(c), "2147549185/4294967296");  // 1/2 + (2^16 + 1)/2^32
}

// Kills: the slope of x alone, the sum of both, the root.
TEST(DepthBias, AddsTheGreaterSlopePerPixel) {
  cases::Case c = plane(0.25F, 0.25F, -0.5F);  // 1/32 and −1/16 for each pixel
  c.depth_bias = {.slope = 2};
  // At (1/2, 1/2): 1/4 + 1/64 − 1/32 + 2/16.
  EXPECT_EQ(depth_of(c), "23/64");
  c = plane(0.25F, 0.5F, -0.25F);
  c.depth_bias = {.slope = -1};
  // 1/4 + 1/32 − 1/64 − 1/16.
  EXPECT_EQ(depth_of(c), "13/64");
}

TEST(DepthBias, IsLimitedOnTheSideOfItsClamp) {
  cases::Case c = plane(0.5F, 0.25F, 0);
  c.depth_bias = {.slope = 4, .clamp = 0.0625F};
  EXPECT_EQ(depth_of(c), "37/64");  // 1/2 + 1/64 + 1/16
  c.depth_bias.slope = -4;          // 1/2 + 1/64 − 1/8
  EXPECT_EQ(depth_of(c), "25/64");
  c.depth_bias.clamp = -0.0625F;
  EXPECT_EQ(depth_of(c), "29/64");  // 1/2 + 1/64 − 1/16
  c.depth_bias.slope = 4;
  EXPECT_EQ(depth_of(c), "41/64");  // 1/2 + 1/64 + 1/8
}

// Kills: clamping before the bias is added, clamping to the depth range under Vulkan.
TEST(DepthBias, IsFollowedByTheClampOfTheRules) {
  cases::Case c = plane(0.5F);
  c.viewport.min_depth = 0.25F;
  c.viewport.max_depth = 0.75F;
  c.depth_bias = {.constant = 0x1p22F};  // 1/2 + 2^22 · 2^-24
  EXPECT_EQ(depth_of(c), "3/4");
  c.depth_bias.constant = 0x1p23F;
  EXPECT_EQ(depth_of(c), "1");
  c.depth_bias.constant = -0x1p24F;
  EXPECT_EQ(depth_of(c), "0");
  c.depth_clamp = true;
  EXPECT_EQ(depth_of(c), "1/4");
  c.depth_clamp = false;
  c.rules = cases::Rules::d3d;
  EXPECT_EQ(depth_of(c), "1/4");
}

// The greatest depth of the vertices is 1/4 + 2 · 1/8 = 1/2, of the samples it is less.
TEST(DepthBias, TakesTheExponentOfTheGreatestVertex) {
  cases::Case c = plane(0.25F, 0.125F, 0);
  c.depth_bias = {.constant = 1};
  EXPECT_EQ(depth_of(c), "4325377/16777216");  // 1/4 + 1/128 + 2^-24
  // A vertex beyond the far plane counts as 1: 2^-23.
  c = plane(0.25F, 1, 0);
  c.depth_bias = {.constant = 1};
  EXPECT_EQ(depth_of(c), "2621441/8388608");  // 1/4 + 1/16 + 2^-23
  // All depths are 0, and so is the unit.
  c = plane(0);
  c.depth_bias = {.constant = 1};
  EXPECT_EQ(depth_of(c), "0");
}

TEST(DepthBias, OfZeroChangesNothing) {
  cases::Case c = plane(0.5F, 0.25F);
  const std::string before = depth_of(c);
  c.depth_bias = {.constant = 0, .slope = 0, .clamp = 0.125F};
  EXPECT_EQ(depth_of(c), before);
}

TEST(UnormDepth, IsANeighbourOfTheExactOne) {
  cases::Case c = plane(0.5F);
  c.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(steps_of(c), "32767 32768");  // 32767.5
  c.depth_bias = {.constant = 1};         // 32768.49998…
  EXPECT_EQ(steps_of(c), "32768 32768");
  cases::Contract contract = cases::contract_of(c);
  contract.depth_store = cases::DepthStore::either;
  contract.bounds.depth.constant = 0;
  EXPECT_EQ(steps_of(c, contract), "32768 32769");
  contract.depth_store = cases::DepthStore::nearly_nearest;
  EXPECT_EQ(steps_of(c, contract), "32768 32769");
  // r is 2^-16 or 2^-15 or between: 32768.49998… to 32769.49997….
  contract.depth_bias.unit = cases::BiasUnit::either_power;
  contract.depth_store = cases::DepthStore::nearest;
  EXPECT_EQ(steps_of(c, contract), "32768 32769");
}

TEST(UnormDepth, IsJudgedAsAnInteger) {
  cases::Case c = plane(0.5F);
  c.depth_format = cases::DepthFormat::unorm16;
  const cases::Contract contract = cases::contract_of(c);
  EXPECT_EQ(class_of(c, contract, 32767 / 65535.0F), FragmentClass::correct);
  EXPECT_EQ(class_of(c, contract, 32768 / 65535.0F), FragmentClass::correct);
  EXPECT_EQ(class_of(c, contract, 32766 / 65535.0F), FragmentClass::beyond_bound);
  EXPECT_EQ(class_of(c, contract, 32769 / 65535.0F), FragmentClass::beyond_bound);
  // A half is no number of the format.
  EXPECT_EQ(class_of(c, contract, 0.5F), FragmentClass::beyond_bound);
  EXPECT_EQ(class_of(c, contract, NAN), FragmentClass::not_a_number);
}

// Two planes a third of a step apart: 32767.5 + 0.2 and 32767.5 + 0.5 are both 32768.
TEST(UnormDepth, IsWhatTheDepthTestCompares) {
  cases::Case c = plane(0.5F + 0x1.8p-17F);
  const cases::Case nearer = plane(0.5F + 0x1p-18F);
  c.positions.insert(c.positions.end(), nearer.positions.begin(), nearer.positions.end());
  c.triangles.push_back({3, 4, 5});
  c.depth_test = cases::DepthTest::less;
  c.depth_clear = 1;
  const auto seen = [](const cases::Case& source) {
    return perfect(SceneTruth(source, cases::contract_of(source))).triangle.front();
  };
  EXPECT_EQ(seen(c), 1U);
  c.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(seen(c), 0U);  // the first of equals
  cases::Fragments drawn = perfect(SceneTruth(c, cases::contract_of(c)));
  EXPECT_EQ(disagreement(SceneTruth(c, cases::contract_of(c)), drawn), "");
  const auto wrong = [&] {
    const auto judged = judge(SceneTruth(c, cases::contract_of(c)), drawn).judgement;
    const auto found = judged.errors.find(records::AttributeKind::coverage);
    return found->second.classes[FragmentClass::wrong_triangle];
  };
  EXPECT_EQ(wrong(), 0U);
  for (std::uint32_t& triangle : drawn.triangle) triangle = 1;
  EXPECT_EQ(wrong(), drawn.size());
}

TEST(UnormDepth, BeginsWithTheNearestNumber) {
  cases::Case c = plane(0.5F);
  c.depth_format = cases::DepthFormat::unorm16;
  c.depth_test = cases::DepthTest::less;
  c.depth_clear =
      32768 / 65535.0F;  // half a step farther than the plane, which may be stored as it
  const SceneTruth scene(c, cases::contract_of(c));
  EXPECT_EQ(judge(scene, {}).judgement.counts.required, 0U);
  c.depth_clear = 32769 / 65535.0F;
  EXPECT_GT(judge(SceneTruth(c, cases::contract_of(c)), {}).judgement.counts.required, 0U);
}

TEST(StoredDepth, OfEveryNumberOfAFormatIsOneFloat) {
  for (const int bits : {16, 24}) {
    const double steps = std::ldexp(1.0, bits) - 1;
    float last = -1;
    for (double k = 0; k <= steps; k += bits == 16 ? 1 : 251) {
      const auto format = bits == 16 ? cases::DepthFormat::unorm16 : cases::DepthFormat::unorm24;
      const auto nearest = static_cast<float>(k / steps);
      ASSERT_GT(nearest, last);
      last = nearest;
      ASSERT_EQ(stored_depth(Rational(double{nearest}), format), nearest);
    }
  }
}

cases::DepthBias random_bias() {
  cases::DepthBias bias;
  bias.constant = one_of({0.0F, 1.0F, -3.5F, 1000.0F, -0x1p20F, 0x1p127F});
  bias.slope = one_of({0.0F, 1.0F, -1.0F, 0.3F, 100.0F, -0x1p100F});
  bias.clamp = one_of({0.0F, 0.0F, 0.125F, -0.01F, 0x1p-20F});
  return bias;
}

void store(cases::Case& c, cases::Contract& contract) {
  c.depth_bias = random_bias();
  c.depth_format = one_of(
      {cases::DepthFormat::float32, cases::DepthFormat::unorm16, cases::DepthFormat::unorm24});
  contract.depth_format = c.depth_format;
  contract.depth_store = one_of(
      {cases::DepthStore::nearest, cases::DepthStore::nearly_nearest, cases::DepthStore::either});
  contract.depth_bias.slope =
      one_of({cases::BiasSlope::greatest, cases::BiasSlope::root, cases::BiasSlope::between});
  contract.depth_bias.unit = one_of({cases::BiasUnit::power, cases::BiasUnit::either_power,
                                     cases::BiasUnit::least_value, cases::BiasUnit::open});
  contract.depth_bias.exponent = one_of({cases::BiasExponent::vertices, cases::BiasExponent::open});
}

/// A drawing with depths at and beside the ends of what is permitted.
cases::Fragments drawn_at_ends(const SceneTruth& scene, Dice& dice) {
  cases::Fragments drawn = perfect(scene);
  const int bits = cases::unorm_bits(scene.source().depth_format);
  const double step = bits == 0 ? 0 : 1 / (std::ldexp(1.0, bits) - 1);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const TriangleTruth truth(scene, drawn.triangle[i]);
    const auto numbers =
        truth.permitted_numbers(std::nullopt, drawn.x[i], drawn.y[i], drawn.sample[i]);
    if (!numbers || !std::isfinite(numbers->least) || !std::isfinite(numbers->greatest)) continue;
    const float end = dice.one_in(2) ? numbers->least : numbers->greatest;
    const int away = dice.pick({0, 0, 0, 1, -1, 2, -2});
    drawn.depth[i] = bits == 0
                         ? moved(end, away)
                         : static_cast<float>(std::clamp(double{end} + away * step, 0.0, 1.0));
  }
  return drawn;
}

// Kills: a first level that takes a depth for right, or knows its error, where exact numbers say
// otherwise.
RC_GTEST_PROP(StoredDepth, LevelsAgreeWhereNothingIsOpen, ()) {
  cases::Case c = random_exact_case();
  if (*rc::gen::arbitrary<bool>()) cover_most(c);
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.depth.constant = one_of({0.5F, 0.51F, 20.0F});
  store(c, contract);
  const SceneTruth scene(c, contract);
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  RC_ASSERT(disagreement(scene, drawn_at_ends(scene, dice)) == "");
}

RC_GTEST_PROP(StoredDepth, LevelsAgreeWherePositionsAreOpen, ()) {
  cases::Case c = open_case();
  cases::Contract contract = open_contract(c);
  store(c, contract);
  const SceneTruth scene(c, contract);
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  RC_ASSERT(disagreement(scene, drawn_at_ends(scene, dice)) == "");
}

// Kills: a range of offsets that leaves out one of the placements' own, an end off by one step.
RC_GTEST_PROP(StoredDepth, OfAPermittedPlacementIsPermitted, ()) {
  cases::Case c = open_case();
  c.framebuffer.samples = 1;
  c.attributes.clear();
  c.attribute_values.clear();
  cases::Contract contract = cases::contract_of(c);
  contract.basis = cases::Basis::unspecified;
  store(c, contract);
  const SceneTruth scene(c, contract);
  cases::Contract exact = contract;
  exact.coverage.reset();
  exact.basis = cases::Basis::ideal;
  exact.depth_bias = {cases::BiasSlope::greatest,
                      contract.depth_bias.unit == cases::BiasUnit::least_value
                          ? cases::BiasUnit::least_value
                          : cases::BiasUnit::power};
  const SceneTruth ideal(c, exact);
  if (contract.depth_bias.slope == cases::BiasSlope::root) RC_SUCCEED("another slope");
  const TriangleTruth open(scene, 0);
  const TriangleTruth own(ideal, 0);
  if (open.is_value_free(std::nullopt)) RC_SUCCEED("not judged");
  for (int y = 0; y < c.framebuffer.height; ++y) {
    for (int x = 0; x < c.framebuffer.width; ++x) {
      if (open.judge(x, y, 0).verdict == records::Verdict::forbidden) continue;
      if (own.judge(x, y, 0).verdict == records::Verdict::forbidden) continue;
      const auto range = open.depth(x, y, 0);
      const auto depth = own.depth(x, y, 0);
      if (!range || !depth) continue;
      RC_ASSERT(range->lo <= depth->lo);
      RC_ASSERT(range->hi >= depth->hi);
    }
  }
}

}  // namespace
}  // namespace rastercheck::oracle::stored_depth_test
