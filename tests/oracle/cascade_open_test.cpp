// The cascade where a contract leaves values open: values at the ends of the permitted range and
// beside them, of triangles that are moved by much or little, flipped, or cut, depending on the
// placement.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>

#include "tests/oracle/cascade.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/random_case.h"
#include "tests/simd_targets.h"

namespace rastercheck::oracle::cascade_open_test {
namespace {

/// A vertex around the target, usually in front of the eye.
cases::ClipVertex open_vertex(bool is_on_grid, int size) {
  const auto w = one_of({1.0F, 1.0F, 1.5F, 0.37F, 4.0F, 0x1p-20F, 30.0F});
  const float x = is_on_grid ? std::floor(ordinary_float(2) * static_cast<float>(size)) /
                                   static_cast<float>(size)
                             : ordinary_float(1.5F);
  const float y = ordinary_float(1.5F);
  const auto z = one_of({0.5F, 0.5F, 0.1F, 0.73F, 0.999F, 1.0F});
  const auto beyond = one_of({0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.6F});
  return {x * w, y * w, (z + beyond) * w, w};
}

cases::Snapping open_snapping() {
  cases::Snapping snapping;
  snapping.subpixel_bits = one_of({0, 2, 4, 8, 8, 12});
  snapping.rounding = one_of(
      {cases::Rounding::unspecified, cases::Rounding::unspecified, cases::Rounding::nearest_even});
  snapping.position_error = one_of({0.0F, 0.0F, 0.01F, 0.75F});
  return snapping;
}

/// One triangle, usually of between a few and some dozen pixels, with attributes that vary by much,
/// by little or not at all.
cases::Case open_case() {
  const int size = one_of({4, 9, 24});
  const auto is_on_grid = *rc::gen::inRange(0, 4) == 0;
  const cases::ClipVertex a = open_vertex(is_on_grid, size);
  const cases::ClipVertex b = open_vertex(is_on_grid, size);
  const cases::ClipVertex c = open_vertex(is_on_grid, size);
  const auto rules = one_of({cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d});
  cases::Case made = small_case(rules, size, size, {a, b, c});
  made.framebuffer.samples = one_of({1, 1, 4});
  made.depth_clamp = *rc::gen::inRange(0, 4) == 0;
  if (*rc::gen::inRange(0, 4) == 0) made.viewport.max_depth = 0.75F;
  for (int i = 0; i < 3; ++i) {
    made.attributes.push_back(
        {"a" + std::to_string(i),
         one_of({cases::Interpolation::smooth, cases::Interpolation::noperspective}),
         one_of({cases::Location::sample, cases::Location::center, cases::Location::centroid})});
  }
  // Sometimes the first attribute varies along x only, so that moves along y hardly change it.
  const auto is_along_x = *rc::gen::inRange(0, 3) == 0;
  const auto is_zero = *rc::gen::inRange(0, 5) == 0;
  for (std::size_t vertex = 0; vertex < 3; ++vertex) {
    const cases::ClipVertex& p = made.positions[vertex];
    const float varying = is_along_x ? p.x / p.w : ordinary_float(4);
    const float almost_constant = 3 + 0x1p-21F * static_cast<float>(*rc::gen::inRange(0, 3));
    const auto any = *rc::gen::inRange(0, 5) == 0 ? random_float(4) : ordinary_float(1);
    made.attribute_values.insert(made.attribute_values.end(),
                                 {varying, almost_constant, is_zero ? 0.0F : any});
  }
  made.coverage = open_snapping();
  made.basis = one_of({cases::Basis::unspecified, cases::Basis::unspecified, cases::Basis::snapped,
                       cases::Basis::ideal});
  return made;
}

cases::Contract open_contract(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  contract.is_on_grid = *rc::gen::arbitrary<bool>();
  contract.keeps_sign_of_zero = *rc::gen::arbitrary<bool>();
  contract.viewport_error = one_of({0.0, 0.0, 0.0, 0.125, 1.0});
  contract.bounds.smooth = one_of<cases::ValueBound>({{0.5F, 0}, {8, 0}, {300, 0}, {0.5F, 0.25F}});
  contract.bounds.noperspective.constant = one_of({0.5F, 4.0F, 1000.0F});
  contract.bounds.depth.constant = one_of({0.5F, 1.0F, 50.0F});
  return contract;
}

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
