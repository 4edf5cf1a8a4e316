// Compares the levels of the judge's cascade with each other on lines and points of every kind,
// exact, snapped and with vertices that the contract leaves open.

#include <gtest/gtest.h>

#include <string>

#include "oracle/judge.h"
#include "tests/oracle/cascade.h"
#include "tests/oracle/drawing.h"

namespace rastercheck::oracle::cascade_primitives_test {
namespace {

using cases::LineMode;
using cases::Primitive;
using cases::Rules;

/// A coordinate of clip space: on a grid that has samples and diamonds' corners, or anywhere.
float coordinate(Dice& dice) {
  return dice.one_in(2) ? static_cast<float>(dice.between(-20, 20)) / 16 : dice.real(-4, 0);
}

cases::Case random_case(Dice& dice, Primitive primitive) {
  cases::Case c;
  c.rules = dice.pick({Rules::opengl, Rules::vulkan, Rules::d3d});
  c.primitive = primitive;
  c.line_mode = dice.pick({LineMode::rectangular, LineMode::parallelogram, LineMode::bresenham});
  c.line_width = dice.pick({1.0F, 1.0F, 0.625F, 2.5F, 5.0F});
  c.point_size = dice.pick({1.0F, 2.0F, 3.75F, 6.0F});
  c.framebuffer = {16, 8, dice.pick({1, 1, 4})};
  c.viewport = {static_cast<float>(dice.between(-2, 2)), 0, 16, 8};
  c.fill_rule = dice.pick({cases::TieRule::top_left, cases::TieRule::bottom_left});
  c.attributes = {{"u"}};
  c.clip_distance_count = dice.one_in(4) ? 1 : 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (int end = 0; end < 2; ++end) {
      const float w = dice.one_in(8) ? -1.0F : dice.pick({1.0F, 1.0F, 0.5F, 3.0F});
      const float x = coordinate(dice) * w;
      const float y = coordinate(dice) * w;
      c.positions.push_back({x, y, 0.5F * w, w});
      c.attribute_values.push_back(dice.real(-3, 3));
      if (c.clip_distance_count > 0) c.clip_distances.push_back(dice.real(-2, 2));
    }
    const bool is_line = primitive == Primitive::lines;
    c.triangles.push_back({2 * i, 2 * i + (is_line ? 1 : 0), 2 * i + (is_line ? 1 : 0)});
  }
  return c;
}

cases::Contract random_contract(Dice& dice, const cases::Case& c) {
  cases::Contract contract;
  contract.tie_rule = dice.one_in(4) ? cases::TieRule::unspecified : c.fill_rule;
  if (dice.one_in(2)) return contract;
  contract.coverage = cases::Snapping{
      .subpixel_bits = dice.pick({4, 8}),
      .rounding = dice.pick({cases::Rounding::nearest_even, cases::Rounding::unspecified}),
      .position_error = dice.pick({0.0F, 0.5F})};
  contract.basis = cases::Basis::snapped;
  return contract;
}

void compare_levels(Primitive primitive) {
  Dice dice(primitive == Primitive::lines ? 1 : 2);
  std::uint64_t by_filter = 0;
  std::uint64_t by_all = 0;
  for (int i = 0; i < 150; ++i) {
    const cases::Case c = random_case(dice, primitive);
    const SceneTruth scene(c, random_contract(dice, c));
    const cases::Fragments drawn = spoiled(scene, perfect(scene), dice);
    ASSERT_EQ(disagreement(scene, drawn), "") << i;
    ASSERT_EQ(disagreement(scene, everything(scene)), "") << i << ", everything";
    const Outcome outcome = outcome_of(scene, drawn, from(Level::filter));
    by_filter += outcome.judged.judgement.levels.samples.filter;
    by_all += outcome.judged.judgement.levels.samples.filter +
              outcome.judged.judgement.levels.samples.interval +
              outcome.judged.judgement.levels.samples.exact;
  }
  EXPECT_GT(2 * by_filter, by_all);
}

// Kills: a band left out, a side with the wrong sign, ends of Bresenham's lines that exclude.
TEST(CascadeOfPrimitives, AgreesOnLines) { compare_levels(Primitive::lines); }
TEST(CascadeOfPrimitives, AgreesOnPoints) { compare_levels(Primitive::points); }

}  // namespace
}  // namespace rastercheck::oracle::cascade_primitives_test
