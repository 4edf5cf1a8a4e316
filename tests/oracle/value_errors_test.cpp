#include "oracle/internal/value_errors.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/internal/coverage.h"
#include "oracle/internal/rational_number.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle {
namespace {

cases::Contract random_contract() {
  cases::Contract contract;
  contract.basis = one_of({cases::Basis::ideal, cases::Basis::snapped, cases::Basis::unspecified});
  contract.tie_rule = one_of({cases::TieRule::top_left, cases::TieRule::unspecified});
  contract.guard_band = one_of({4.0F, 32768.0F});
  if (*rc::gen::inRange(0, 6) > 0) {
    contract.coverage = cases::Snapping{
        one_of({2, 8, 16}), one_of({cases::Rounding::nearest_even, cases::Rounding::unspecified}),
        one_of({0.0F, 0.25F})};
  }
  return contract;
}

/// The computed values that try a range hardest: its ends rounded, their neighbours, and others.
std::vector<float> values_near(const OpenValue& open) {
  std::vector<float> values{0.0F};
  const Field lo = open.range.lo.value();
  const Field hi = open.range.hi.value();
  for (const Field& end : {lo, hi, Field((lo + hi) / 2)}) {
    const float rounded = nearest_float(end);
    if (!std::isfinite(rounded)) continue;
    values.push_back(rounded);
    for (const float far : {-3e38F, 3e38F}) values.push_back(std::nextafter(rounded, far));
  }
  return values;
}

/// The excess by definition: from the range itself.
Field excess_by_definition(const Ring& computed, const OpenValue& open, const Ring& magnitude) {
  const ScaleExponent scale = scale_exponent(magnitude);
  const Field f(computed);
  if (f > open.range.hi.value()) return UlpError(computed, open.range.hi, scale).value();
  if (f < open.range.lo.value()) return UlpError(computed, open.range.lo, scale).value();
  return 0;
}

Ring magnitude_of(const Scene& scene, const TriangleValues& values,
                  std::optional<std::size_t> attribute) {
  if (!attribute) return std::max(scene.least_depth(), scene.greatest_depth());
  Ring largest(0);
  for (const Ring& value : values.vertex_values(*attribute)) {
    largest = std::max(largest, magnitude(value));
  }
  return largest;
}

/// Compares every covered sample's errors with those of the ranges that TriangleValues gives.
void expect_errors_of_ranges(const TriangleSetup& setup) {
  const Scene& scene = *setup.scene;
  const TriangleValues values(setup);
  const ValueErrors errors(setup, values);
  const PixelBox box = setup.pixels();
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const int s = (x + y) % scene.source().framebuffer.samples;
      if (decide(setup, x, y, s).verdict == records::Verdict::forbidden) continue;
      for (std::size_t subject = 0; subject <= scene.source().attributes.size(); ++subject) {
        const std::optional<std::size_t> attribute =
            subject == 0 ? std::nullopt : std::optional(subject - 1);
        const std::optional<OpenValue> open =
            attribute ? values.attribute(*attribute, x, y, s) : values.depth(x, y, s);
        if (!open) {
          RC_ASSERT(!errors.of(attribute, x, y, s, Ring(0)));
          continue;
        }
        const Ring scale = magnitude_of(scene, values, attribute);
        for (const float computed : values_near(*open)) {
          const auto error = errors.of(attribute, x, y, s, exact_ring(computed));
          RC_ASSERT(error.has_value());
          RC_ASSERT(error->excess.value() ==
                    excess_by_definition(exact_ring(computed), *open, scale));
        }
      }
    }
  }
}

// Kills: a reading that is not of the range, a bracket taken too early, ends that are not cut down,
// a forgotten pole, clamping in the wrong order.
RC_GTEST_PROP(ValueErrors, AreThoseOfTheRange, ()) {
  cases::Case c = random_exact_case();
  if (*rc::gen::inRange(0, 8) == 0) c.attributes[0].location = cases::Location::centroid;
  const cases::Contract contract = random_contract();
  const SceneTruth truth(c, contract);
  expect_errors_of_ranges(TriangleSetup(truth.scene(), c.triangles[0]));
}

/// Ordinary triangles: all w positive, most of the target covered.
RC_GTEST_PROP(ValueErrors, AreThoseOfTheRangeOfOrdinaryTriangles, ()) {
  cases::Case c = random_exact_case();
  for (cases::ClipVertex& p : c.positions) {
    const float x = ordinary_float(3);
    const float y = ordinary_float(3);
    const int w = *rc::gen::inRange(1, 9);
    p = {x * static_cast<float>(w), y * static_cast<float>(w), 0.5F * static_cast<float>(w),
         static_cast<float>(w)};
  }
  const cases::Contract contract = random_contract();
  const SceneTruth truth(c, contract);
  expect_errors_of_ranges(TriangleSetup(truth.scene(), c.triangles[0]));
}

/// A triangle over the whole of a 4×4 target with w = 1, 1, 4, whose 1/w is 1/4 at the top.
cases::Case receding() {
  return small_case(cases::Rules::vulkan, 4, 4, {{{-1, 1, 0, 1}, {1, 1, 0, 1}, {-4, -4, 0, 4}}},
                    {{{0}, {1}, {0}}});
}

// By hand: 1/w is 1 at v = 4 and 1/4 at v = 0, so 1/w = (1 + 3 v/4)/4; at v = 1/2 it is 11/32.
TEST(HorizonRatio, IsTheGreatestInverseWOverThatOfThePoint) {
  const cases::Case c = receding();
  const SceneTruth truth(c, cases::contract_of(c));
  const TriangleSetup setup(truth.scene(), c.triangles[0]);
  EXPECT_EQ(horizon_ratio(setup, {Ring(0.5), Ring(0.5)}).value(), Field(32, 11));
  EXPECT_EQ(horizon_ratio(setup, {Ring(0.5), Ring(4)}).value(), Field(1));
  EXPECT_FALSE(horizon_ratio(setup, {Ring(0.5), Ring(-4)}).has_value());
}

// With w = 1, 1, −1 the horizon (1/w = 0) runs between the second and the third vertex's mirror:
// 1/w = 1 at v = 4, −1 at v = 0, so 1/w = v/2 − 1, and greatest at the guard band's far side.
TEST(HorizonRatio, OfATriangleThroughTheEyeGoesToItsClippedCorners) {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                             {{{-1, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, -1}}}, {{{0}, {1}, {0}}});
  c.depth_clamp = true;
  cases::Contract contract = cases::contract_of(c);
  contract.guard_band = 16;
  const SceneTruth truth(c, contract);
  const TriangleSetup setup(truth.scene(), c.triangles[0]);
  EXPECT_EQ(horizon_ratio(setup, {Ring(2), Ring(5)}).value(), Field(7) / Field(3, 2));
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
  EXPECT_EQ(truth.value_bound(2, 4, 4, 0)->to_string(), "3");
  EXPECT_EQ(truth.value_bound(std::nullopt, 4, 4, 0)->to_string(), "2");
}

// Kills: no bound at all where the exact triangle has no area and its snapped one has.
TEST(ValueBound, IsTheConstantWhereTheExactTriangleIsDegenerate) {
  const cases::Case c =
      small_case(cases::Rules::vulkan, 9, 9, {{{-1, -1, 0, 1}, {0, 0, 0, 1}, {1, 1, 0, 1}}},
                 {{{0}, {1}, {2}}});
  cases::Contract contract;
  contract.bounds.smooth = {0.5F, 0.25F};
  const SceneTruth scene(c, contract);
  EXPECT_EQ(TriangleTruth(scene, 0).value_bound(0, 4, 4, 0)->to_string(), "1/2");
}

// A point may be covered by the triangle of some positions between grid points and by none of the
// grid points': where vertices need not be on the grid it is permitted. An apex at (1/2, 3/2) grid
// units from the sample, about a degree wide.
TEST(PositionsOffTheGrid, LeaveOpenWhatNoPlacementDecides) {
  constexpr float kUnit = 0x1p-8F;  // in NDC of a target of 2 pixels: 2^-8 pixels
  cases::Case c = small_case(cases::Rules::vulkan, 2, 2,
                             {{{-0.5F + 0.5F * kUnit, -0.5F + 1.5F * kUnit, 0, 1},
                               {-0.51F, -1, 0, 1},
                               {-0.5F, -1, 0, 1}}});
  cases::Contract contract;
  contract.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
  contract.tie_rule = cases::TieRule::unspecified;
  const SceneTruth on_grid(c, contract);
  contract.is_on_grid = false;
  const SceneTruth off_grid(c, contract);
  int open = 0;
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) {
      const records::Verdict placed = TriangleTruth(on_grid, 0).judge(x, y, 0).verdict;
      const records::Verdict free = TriangleTruth(off_grid, 0).judge(x, y, 0).verdict;
      open += free == records::Verdict::permitted ? 1 : 0;
      // What positions on the grid decide may be open off it; never the other way round.
      EXPECT_TRUE(free == placed || free == records::Verdict::permitted);
    }
  }
  EXPECT_EQ(open, 1);
}

}  // namespace
}  // namespace rastercheck::oracle
