// The initial value of a depth buffer, how finely the buffer compares, and how far edges of cut
// triangles may be off. Expected results are calculated by hand.

#include <gtest/gtest.h>

#include "oracle/fragments.h"
#include "oracle/judge.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::depth_buffer_test {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// Two triangles in a corner of a 4×4 target, over its six pixels x + y < 3, at the given depths.
cases::Case layers(float first, float second) {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                             {{{-1, -1, first, 1}, {1, -1, first, 1}, {-1, 1, first, 1}}});
  c.positions.insert(c.positions.end(),
                     {{-1, -1, second, 1}, {1, -1, second, 1}, {-1, 1, second, 1}});
  c.triangles.push_back({3, 4, 5});
  c.depth_test = cases::DepthTest::less;
  return c;
}

cases::Fragments drawing(std::uint32_t triangle, float depth) {
  cases::Fragments drawn;
  for (std::uint16_t y = 0; y < 3; ++y) {
    for (std::uint16_t x = 0; x + y < 3; ++x) {
      drawn.triangle.push_back(triangle);
      drawn.y.push_back(y);
      drawn.x.push_back(x);
      drawn.sample.push_back(0);
      drawn.depth.push_back(depth);
    }
  }
  return drawn;
}

/// The number of a drawing's samples of a class.
std::uint64_t count(const cases::Case& c, const cases::Contract& contract,
                    const cases::Fragments& drawn, FragmentClass fragment_class) {
  const records::Judgement judgement = judge(SceneTruth(c, contract), drawn).judgement;
  const auto found = judgement.errors.find(AttributeKind::coverage);
  return found == judgement.errors.end() ? 0 : found->second.classes[fragment_class];
}

std::uint64_t count(const cases::Case& c, const cases::Fragments& drawn,
                    FragmentClass fragment_class) {
  return count(c, cases::contract_of(c), drawn, fragment_class);
}

// Kills: fragments of depth 1 that must be drawn, although the buffer may begin at 1.
TEST(DepthBuffer, MayBeginWithOneWhereTheCaseDoesNotSay) {
  const cases::Case c = layers(1, 1);
  EXPECT_EQ(count(c, drawing(0, 1), FragmentClass::correct), 6U);
  EXPECT_EQ(count(c, {}, FragmentClass::missing), 0U);
  const records::Judgement judgement = judge(SceneTruth(c, cases::contract_of(c)), {}).judgement;
  EXPECT_EQ(judgement.counts.required, 0U);
  EXPECT_EQ(judgement.counts.permitted, 12U);
}

TEST(DepthBuffer, BeginsWithWhatTheCaseSays) {
  cases::Case c = layers(0.5F, 0.75F);
  c.depth_clear = 0.75F;
  EXPECT_EQ(count(c, {}, FragmentClass::missing), 6U);
  EXPECT_EQ(count(c, drawing(0, 0.5F), FragmentClass::correct), 6U);
  c.depth_clear = 0.25F;
  EXPECT_EQ(count(c, {}, FragmentClass::missing), 0U);
  EXPECT_EQ(count(c, drawing(0, 0.5F), FragmentClass::extra), 6U);
}

// Kills: "less or equal" in the comparison with the initial depth. The contract's bound for depths
// is 0, so that depths are exact.
TEST(DepthBuffer, KeepsWhatItBeginsWithOfEqualDepths) {
  cases::Case c = layers(0.75F, 0.75F);
  c.depth_clear = 0.75F;
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.depth.constant = 0;
  EXPECT_EQ(count(c, contract, {}, FragmentClass::missing), 0U);
  EXPECT_EQ(count(c, contract, drawing(0, 0.75F), FragmentClass::extra), 6U);
  // Under the case's own contract, a computed depth may be less by half an ulp of 1, the greater
  // end of the range.
  EXPECT_EQ(count(c, drawing(0, 0.75F), FragmentClass::correct), 6U);
}

TEST(DepthBuffer, LeavesOpenWhetherADepthIsLessThanItsBeginning) {
  cases::Case c = layers(1 - 0x1p-24F, 1 - 0x1p-24F);  // half an ulp of 1 below 1
  EXPECT_EQ(count(c, {}, FragmentClass::missing), 0U);
  c = layers(1 - 0x1p-23F, 1 - 0x1p-23F);
  EXPECT_EQ(count(c, {}, FragmentClass::missing), 6U);
}

// The second triangle is nearer by 2^-20: more than 2 steps of 2^-24, but less than one step of
// 2^-16.
TEST(DepthBuffer, ComparesAsFinelyAsTheContractSays) {
  const cases::Case c = layers(0.5F, 0.5F - 0x1p-20F);
  cases::Contract contract = cases::contract_of(c);
  const cases::Fragments farther = drawing(0, 0.5F);
  const cases::Fragments nearer = drawing(1, 0.5F - 0x1p-20F);
  for (const cases::DepthFormat format :
       {cases::DepthFormat::float32, cases::DepthFormat::float64, cases::DepthFormat::unorm24,
        cases::DepthFormat::unorm32}) {
    contract.depth_format = format;
    EXPECT_EQ(count(c, contract, farther, FragmentClass::wrong_triangle), 6U);
    EXPECT_EQ(count(c, contract, nearer, FragmentClass::correct), 6U);
  }
  contract.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(count(c, contract, farther, FragmentClass::correct), 6U);
  EXPECT_EQ(count(c, contract, nearer, FragmentClass::correct), 6U);
  EXPECT_EQ(count(c, contract, {}, FragmentClass::missing), 6U);
}

/// The number of samples at which the contract permits the second of two layers.
std::uint64_t seen_of_second(const cases::Case& c, bool keeps_equal_depth) {
  cases::Contract contract = cases::contract_of(c);
  contract.keeps_equal_depth = keeps_equal_depth;
  EXPECT_EQ(count(c, contract, drawing(0, 0.5F), FragmentClass::correct), 6U);
  EXPECT_EQ(count(c, contract, {}, FragmentClass::missing), 6U);
  return count(c, contract, drawing(1, 0.5F), FragmentClass::correct);
}

// z/w is 1/2 at all vertices, whatever their w; the second triangle fails the test "less".
TEST(DepthBuffer, KeepsTheFirstOfTwoTrianglesInAPlaneOfEqualDepth) {
  cases::Case c = layers(0.5F, 0.5F);
  EXPECT_EQ(seen_of_second(c, false), 6U);
  EXPECT_EQ(seen_of_second(c, true), 0U);
  c.positions[4] = {2, -2, 1, 2};
  EXPECT_EQ(seen_of_second(c, true), 0U);
}

// Kills: planes of different depth, or triangles of no constant depth, taken for equal ones. Depths
// within an ulp of 1 may still be computed as equal or in either order.
TEST(DepthBuffer, LeavesTheOrderOfOtherTrianglesOpen) {
  cases::Case c = layers(0.5F, 0.5F + 0x1p-24F);
  EXPECT_EQ(seen_of_second(c, true), 6U);
  c = layers(0.5F, 0.5F);
  c.positions[4].z = 0.5F + 0x1p-24F;
  EXPECT_EQ(seen_of_second(c, true), 6U);
  c = layers(0.5F, 0.5F);
  for (std::size_t i : {0U, 3U}) c.positions[i].z = 0.5F + 0x1p-24F;  // the same, but not a plane
  EXPECT_EQ(seen_of_second(c, true), 6U);
}

TEST(DepthBuffer, IsHeededWhereFragmentsAreListed) {
  cases::Case c = layers(0.5F, 1);
  const auto listed = [&c](records::Verdict verdict) {
    std::size_t all = 0;
    for_each_fragment(SceneTruth(c, cases::contract_of(c)),
                      [&](const Fragment& fragment, const TriangleTruth&) {
                        all += fragment.decision.verdict == verdict ? 1U : 0U;
                        return true;
                      });
    return all;
  };
  EXPECT_EQ(listed(records::Verdict::required), 6U);
  c.depth_clear = 0.5F;
  EXPECT_EQ(listed(records::Verdict::required), 0U);
  EXPECT_EQ(listed(records::Verdict::permitted), 0U);
  c.depth_clear.reset();
  c.triangles.erase(c.triangles.begin());  // leaves the one at depth 1
  EXPECT_EQ(listed(records::Verdict::required), 0U);
  EXPECT_EQ(listed(records::Verdict::permitted), 6U);
}

// Kills: a guard band around the window's origin alone, so that everything may be clipped if the
// band is narrower than the viewport.
TEST(GuardBand, IsTheViewportAtLeast) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 64, 64, {{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}}});
  c.viewport.x = 16;
  c.viewport.width = 32;
  c.viewport.height = 32;
  cases::Contract contract = cases::contract_of(c);
  contract.coverage = cases::Snapping();
  const auto judged = [&](float guard_band, int x, int y) {
    contract.guard_band = guard_band;
    const SceneTruth scene(c, contract);
    const TriangleTruth truth(scene, 0);
    return std::pair(truth.has_certain_orientation(), truth.judge(x, y, 0).verdict);
  };
  // The hypotenuse runs from (48, 0) to (16, 32), through the sample at (26.5, 21.5).
  for (const int x : {16, 25, 26, 27, 47}) {
    EXPECT_EQ(judged(0, x, 21), judged(32768, x, 21)) << x;
  }
  EXPECT_TRUE(judged(0, 16, 21).first);
  EXPECT_NE(judged(0, 26, 21).second, records::Verdict::permitted);
  // A vertex slightly outside may be clipped, and the hypotenuse moved with it.
  c.positions[1].x = 1 + 0x1p-20F;
  EXPECT_NE(judged(32768, 26, 21).second, records::Verdict::permitted);
  EXPECT_EQ(judged(0, 26, 21).second, records::Verdict::permitted);
  // Two vertices at x = 8, left of the viewport, lie neither in it nor in a guard band of size 0;
  // the edge from (38, 0) to (8, 30) runs through the sample at (26.5, 11.5).
  c.positions = {{-1.5F, -1, 0, 1}, {0.375F, -1, 0, 1}, {-1.5F, 0.875F, 0, 1}};
  EXPECT_NE(judged(32768, 26, 11).second, records::Verdict::permitted);
  EXPECT_EQ(judged(0, 26, 11).second, records::Verdict::permitted);
}

// The left edge lies at x = 1.506, which is 0.006 pixels or 1.536 units of 1/256 to the right of
// the samples of column 1. All vertices lie outside a guard band of one pixel, so that the triangle
// is cut.
TEST(CutEdges, AreOffByTheToleranceAndThePositionError) {
  constexpr float kLeft = 1.506F / 2 - 1;
  const cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                                   {{{kLeft, -1, 0, 1}, {3, -1, 0, 1}, {kLeft, 3, 0, 1}}});
  cases::Contract contract = cases::contract_of(c);
  contract.coverage = cases::Snapping();
  contract.guard_band = 1;
  contract.clip_tolerance = 1;
  const auto verdict = [&](float position_error) {
    contract.coverage->position_error = position_error;
    return TriangleTruth(SceneTruth(c, contract), 0).judge(1, 1, 0).verdict;
  };
  EXPECT_EQ(verdict(0), records::Verdict::forbidden);
  EXPECT_EQ(verdict(0.5F), records::Verdict::forbidden);
  EXPECT_EQ(verdict(0.625F), records::Verdict::permitted);
  EXPECT_EQ(verdict(64), records::Verdict::permitted);
}

}  // namespace
}  // namespace rastercheck::oracle::depth_buffer_test
