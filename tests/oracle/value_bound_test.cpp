// The bounds on errors of values, by hand.

#include "oracle/internal/value_bound.h"

#include <gtest/gtest.h>

#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::value_bound_test {
namespace {

// By hand: 1/w is 1 at v = 4 and 1/4 at v = 0, so 1/w = (1 + 3 v/4)/4; at v = 1/2 it is 11/32.
TEST(HorizonRatio, IsTheGreatestInverseWOverThatOfThePoint) {
  const cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{-1, 1, 0, 1}, {1, 1, 0, 1}, {-4, -4, 0, 4}}},
                 {{{0}, {1}, {0}}});
  const SceneTruth truth(c, cases::contract_of(c));
  const TriangleSetup setup(truth.scene(), 0);
  EXPECT_EQ(horizon_ratio(setup, {Ring(0.5), Ring(0.5), Ring(1)}).value(), Field(32, 11));
  EXPECT_EQ(horizon_ratio(setup, {Ring(0.5), Ring(4), Ring(1)}).value(), Field(1));
  EXPECT_FALSE(horizon_ratio(setup, {Ring(0.5), Ring(-4), Ring(1)}).has_value());
}

// With w = 1, 1, −1 the horizon (1/w = 0) runs between the second vertex and the mirror image of
// the third: 1/w = 1 at v = 4 and −1 at v = 0, so 1/w = v/2 − 1, which is greatest at the far side
// of the guard band.
TEST(HorizonRatio, OfATriangleThroughTheEyeGoesToItsClippedCorners) {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                             {{{-1, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, -1}}}, {{{0}, {1}, {0}}});
  c.depth_clamp = true;
  cases::Contract contract = cases::contract_of(c);
  contract.guard_band = 16;
  const SceneTruth truth(c, contract);
  const TriangleSetup setup(truth.scene(), 0);
  EXPECT_EQ(horizon_ratio(setup, {Ring(2), Ring(5), Ring(1)}).value(), Field(7) / Field(3, 2));
}

// By hand: w is 1 on the left border and 4 at the middle of the right one, so that 1/w, linear in
// the window, is 5/8 at the centre: g = 8/5, and the bound 1/2 + 1/4 · 8/5.
TEST(ValueBound, GrowsTowardsTheHorizon) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 9, 9, {{{-1, -1, 0, 1}, {4, 0, 0, 4}, {-1, 1, 0, 1}}},
                 {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}});
  c.attributes[1].interpolation = cases::Interpolation::flat;
  c.attributes[2].interpolation = cases::Interpolation::noperspective;
  cases::Contract contract;
  contract.bounds.smooth = {0.5F, 0.25F};
  contract.bounds.noperspective = {3, 0.25F};
  contract.bounds.depth = {2, 0};
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.value_bound(0, 4, 4, 0)->to_string(), "9/10");
  EXPECT_EQ(truth.value_bound(1, 4, 4, 0)->to_string(), "0");
  EXPECT_EQ(truth.value_bound(2, 4, 4, 0)->to_string(), "13/4");
  EXPECT_EQ(truth.value_bound(std::nullopt, 4, 4, 0)->to_string(), "2");
}

// Kills: no bound at all if the exact triangle has no area but its snapped triangle has.
TEST(ValueBound, IsTheConstantWhereTheExactTriangleIsDegenerate) {
  const cases::Case c =
      small_case(cases::Rules::vulkan, 9, 9, {{{-1, -1, 0, 1}, {0, 0, 0, 1}, {1, 1, 0, 1}}},
                 {{{0}, {1}, {2}}});
  cases::Contract contract;
  contract.bounds.smooth = {0.5F, 0.25F};
  const SceneTruth scene(c, contract);
  EXPECT_EQ(TriangleTruth(scene, 0).value_bound(0, 4, 4, 0)->to_string(), "1/2");
}

/// A triangle in perspective: (X, Y, w) = (0, 0, 1), (4, 0, 1), (0, 8, 2). Its edges are E_0 = 32 −
/// 8 u − 8 v, E_1 = 8 u and E_2 = 4 v, and |det M| = 32.
cases::Case in_perspective(float largest) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-2, 2, 0, 2}}},
                 {{{-1, 0}, {largest, 0}, {0, 1}}});
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  return c;
}

// By hand, at (1, 1). Magnitudes (|X|, |Y|, |w|): (4, 4, 1), (4, 4, 1) and (8, 8, 2), so |E|_0 =
// |E|_1 = 16 + 16 + 64 and |E|_2 = 8 + 8 + 32; E = 16, 8, 4. K = 240/28; for noperspective values,
// Σ |w||E| = 288 over 32.
TEST(Condition, IsWhatTheWeightsAreMadeOfOverWhatTheyAre) {
  const cases::Case c = in_perspective(3);
  const SceneTruth truth(c, cases::contract_of(c));
  const TriangleSetup setup(truth.scene(), 0);
  const HomogeneousPoint p{Ring(1), Ring(1), Ring(1)};
  EXPECT_EQ(condition(setup, false, p).value(), Field(60, 7));
  EXPECT_EQ(condition(setup, true, p).value(), Field(9));
  EXPECT_FALSE(condition(setup, false, {Ring(0), Ring(8), Ring(1)}).has_value());  // ΣE = 0
}

// By hand, at (1, 1), of a line from (X, Y, w) = (0, 0, 1) to (0, 8, 2): n = (0, 8), E = 64 − 16 v
// and 8 v. Of magnitudes (4, 4, 1) and (8, 8, 2), |n| = (16, 16), |E|_0 = 16 (2 + 8) + 16 (2 + 8)
// and |E|_1 = 16 (1 + 4) + 16 (1 + 4); K = 480/56, for noperspective values (320 + 2 · 160)/64. A
// parallelogram takes the second halves of both sums alone.
TEST(Condition, OfALineIsThatOfItsFunctionals) {
  cases::Case c = in_perspective(3);
  c.primitive = cases::Primitive::lines;
  c.triangles = {{0, 2, 2}};
  const HomogeneousPoint p{Ring(1), Ring(1), Ring(1)};
  const auto condition_of = [&](cases::LineMode mode, bool is_affine) {
    c.line_mode = mode;
    const SceneTruth truth(c, cases::contract_of(c));
    return condition(TriangleSetup(truth.scene(), 0), is_affine, p).value();
  };
  for (const cases::LineMode mode : {cases::LineMode::rectangular, cases::LineMode::bresenham}) {
    EXPECT_EQ(condition_of(mode, false), Field(60, 7));
    EXPECT_EQ(condition_of(mode, true), Field(10));
  }
  EXPECT_EQ(condition_of(cases::LineMode::parallelogram, false), Field(30, 7));
  EXPECT_EQ(condition_of(cases::LineMode::parallelogram, true), Field(5));
  c.primitive = cases::Primitive::points;
  c.triangles = {{2, 2, 2}};
  EXPECT_EQ(condition_of(cases::LineMode::rectangular, false), Field(1));
}

// The pixel's centre is at (1/2, 1/2): |E| = 80, 80, 40 and E = 24, 4, 2, K = 20/3. The range of
// the values −1, 3 and 0 is 4, measured in ulp(3) = 2^-22.
TEST(ValueBound, GrowsWithTheConditionAndWithTheRange) {
  const cases::Case c = in_perspective(3);
  cases::Contract contract;
  contract.bounds.smooth = {0.5F, 0, 3, 0x1p-24F};
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.value_bound(0, 0, 0, 0)->to_string(), "43/2");  // 1/2 + 20 + 1
  // K is at least 1, so the bound is at least 1/2 + 3 + 1; least_bound() may be slightly less.
  EXPECT_LE(least_bound(truth.setup(), 0), 4.5);
  EXPECT_GT(least_bound(truth.setup(), 0), 4.5 * (1 - 0x1p-40));
}

// Kills: a promise about values that may lose all their digits.
TEST(ValueBound, IsNoneWhereAllDigitsMayBeLost) {
  const cases::Case c = in_perspective(3);
  cases::Contract contract;
  contract.bounds.smooth = {0.5F, 0, 0x1p22F, 0};
  EXPECT_FALSE(TriangleTruth(SceneTruth(c, contract), 0).value_bound(0, 0, 0, 0).has_value());
  contract.bounds.smooth.per_condition = 0x1p21F;
  EXPECT_TRUE(TriangleTruth(SceneTruth(c, contract), 0).value_bound(0, 0, 0, 0).has_value());
  contract.bounds.smooth = {0x1p24F, 0, 0, 0};
  contract.bounds.depth = {0x1.fffffep23F, 0, 0, 0};
  EXPECT_FALSE(TriangleTruth(SceneTruth(c, contract), 0).value_bound(0, 0, 0, 0).has_value());
  EXPECT_TRUE(TriangleTruth(SceneTruth(c, contract), 0).value_bound({}, 0, 0, 0).has_value());
  contract.bounds.depth = {0x1p24F, 0, 0, 0};
  EXPECT_FALSE(TriangleTruth(SceneTruth(c, contract), 0).value_bound({}, 0, 0, 0).has_value());
}

// A value that is claimed to be linear in the window has the condition of a noperspective value.
TEST(ValueBound, OfAnAffineClaimIsThatOfANoperspectiveValue) {
  const cases::Case c = in_perspective(3);
  cases::Contract contract;
  contract.claims = cases::Claim::affine;
  contract.bounds.smooth = {0.5F, 2, 1, 0};
  contract.bounds.noperspective = contract.bounds.smooth;
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.value_bound(0, 0, 0, 0)->to_string(), truth.value_bound(1, 0, 0, 0)->to_string());
}

}  // namespace
}  // namespace rastercheck::oracle::value_bound_test
