// The cascade where a contract leaves values open: values at the ends of the permitted range and
// beside them, of triangles that are moved by much or little, flipped, or cut, depending on the
// placement.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>

#include "tests/oracle/cascade.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/open_case.h"
#include "tests/oracle/random_case.h"
#include "tests/simd_targets.h"

namespace rastercheck::oracle::cascade_open_test {
namespace {

/// A float at or beside an end of the permitted range, or somewhere between its ends.
float near_end(const std::optional<ValueRange>& range, Dice& dice) {
  if (!range) return 0;
  const float lo = range->lo.nearest_float();
  const float hi = range->hi.nearest_float();
  if (lo == 0 && hi == 0) return dice.pick({0.0F, -0.0F});
  const int steps = dice.pick({0, 0, -1, 1, -2, 2, -3, 3, -7, 9, 40, -60, 700});
  switch (dice.between(0, 2)) {
    case 0:
      return moved(lo, steps);
    case 1:
      return moved(hi, steps);
    default:
      return lo + (hi - lo) * static_cast<float>(dice.between(0, 16)) / 16;
  }
}

cases::Fragments drawn_at_ends(const SceneTruth& scene, Dice& dice) {
  cases::Fragments drawn = perfect(scene);
  const std::size_t count = drawn.attribute_count;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const TriangleTruth truth(scene, drawn.triangle[i]);
    const int x = drawn.x[i];
    const int y = drawn.y[i];
    const int sample = drawn.sample[i];
    drawn.depth[i] = near_end(truth.depth(x, y, sample), dice);
    for (std::size_t a = 0; a < count; ++a) {
      drawn.attributes[count * i + a] = near_end(truth.attribute(a, x, y, sample), dice);
    }
  }
  return drawn;
}

// Kills: an inner bound that is too wide; an outer bound that is too narrow; an excess that is not
// the distance to the nearest reading.
RC_GTEST_PROP(CascadeOpen, LevelsAgreeAtTheEndsOfWhatIsPermitted, ()) {
  const cases::Case c = open_case();
  const SceneTruth scene(c, open_contract(c));
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  const cases::Fragments drawn = drawn_at_ends(scene, dice);
  RC_CLASSIFY(drawn.size() > 0, "covers something");
  const std::string difference = disagreement(scene, drawn);
  RC_ASSERT(difference == "");
}

/// A triangle in perspective, about 70 pixels wide, off the grid.
cases::Case ordinary_case(cases::Basis basis, float position_error) {
  cases::Case c = small_case(cases::Rules::vulkan, 96, 96,
                             {{{-0.737F, -0.813F, 0.137F, 1.0F},
                               {1.471F, -1.213F, 0.931F, 2.0F},
                               {-1.019F, 1.131F, 0.773F, 1.5F}}},
                             {{{0.11F, 7.3F}, {1.7F, -2.9F}, {-0.23F, 0.37F}}});
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  c.coverage = cases::Snapping{8, cases::Rounding::unspecified, position_error};
  c.basis = basis;
  return c;
}

double filtered_share(const cases::Case& c) {
  const SceneTruth scene(c, cases::contract_of(c));
  const cases::Fragments drawn = perfect(scene);
  EXPECT_GT(drawn.size(), 1'000U);
  const records::LevelCounts values = judge(scene, drawn).judgement.levels.values;
  return static_cast<double>(values.filter) /
         static_cast<double>(values.filter + values.interval + values.exact);
}

// Checks that doubles decide at all; otherwise the law above would test nothing. Perfect drawings
// have the least permitted value, which is the hardest to decide if the basis is snapped.
TEST(CascadeOpen, DoublesDecideWhatLiesWithin) {
  EXPECT_GT(filtered_share(ordinary_case(cases::Basis::unspecified, 0)), 0.4);
  EXPECT_GT(filtered_share(ordinary_case(cases::Basis::snapped, 0.5F)), 0.4);
}

// Every level's answers are the same to the bit, whichever vector instructions the filter uses.
TEST(CascadeOpen, AllTargetsGiveTheSameBits) {
  cases::Case c = ordinary_case(cases::Basis::unspecified, 0.5F);
  c.framebuffer = {32, 32, 4};
  c.viewport.width = 32;
  c.viewport.height = 32;
  c.attributes[0].location = cases::Location::center;
  c.attributes[1].location = cases::Location::centroid;
  const SceneTruth scene(c, cases::contract_of(c));
  Dice dice(1);
  const cases::Fragments drawn = drawn_at_ends(scene, dice);
  const Outcome best = outcome_of(scene, drawn, {});
  EXPECT_GT(best.judged.judgement.levels.values.filter, 1'000U);
  for (const std::int64_t target : all_targets()) {
    const OnTarget on_target(target);
    EXPECT_EQ(difference_in_bits(best, outcome_of(scene, drawn, {})), "")
        << hwy::TargetName(target);
  }
}

}  // namespace
}  // namespace rastercheck::oracle::cascade_open_test
