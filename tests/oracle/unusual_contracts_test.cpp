// Contracts of rasterizers unlike GPUs (RULES §13): other grids, sample positions, tie rules,
// culling and one-sided bounds. Expected verdicts are by hand; random cases compare a grid and a
// sample position that are no dyadic fractions with a picture three times as large, in which they
// are.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "oracle/internal/rational_number.h"
#include "oracle/judge.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/open_case.h"
#include "tests/oracle/random_case.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::unusual_contracts_test {
namespace {

using cases::PixelFraction;
using cases::Rounding;
using cases::Snapping;
using cases::TieRule;
using cases::Winding;
using records::FragmentClass;
using records::Reason;
using records::Verdict;

/// A vertex at a window position of a 4 × 4 framebuffer under Vulkan's rules.
cases::ClipVertex at(float x, float y, float depth = 0.5F) {
  return {x / 2 - 1, y / 2 - 1, depth, 1};
}

cases::Case triangle(const std::array<cases::ClipVertex, 3>& positions) {
  return small_case(cases::Rules::vulkan, 4, 4, positions, {{{0.25F}, {0.25F}, {0.25F}}});
}

records::SampleVerdict verdict(const cases::Case& c, const cases::Contract& contract, int x,
                               int y) {
  const SceneTruth scene(c, contract);
  return TriangleTruth(scene, 0).judge(x, y, 0);
}

// A console of the nineties: positions cut to 1/12 pixel, sampled at 7/12.
TEST(TwelfthsOfAPixel, AreExact) {
  // The left edge at 25/16 = 18.75/12 goes to 18/12 or 19/12, and 19/12 = 1 + 7/12 is the sample.
  const cases::Case c = triangle({at(1.5625F, -8), at(1.5625F, 8), at(9.5625F, 0)});
  cases::Contract contract = cases::contract_of(c);
  contract.basis = cases::Basis::snapped;
  contract.sample_position = PixelFraction{7, 7, 12};
  const auto with = [&](Rounding rounding) {
    contract.coverage = cases::with_steps({8, rounding, 0}, 12);
    return verdict(c, contract, 1, 1);
  };
  EXPECT_EQ(with(Rounding::floor).reason, Reason::inside);
  EXPECT_EQ(with(Rounding::toward_zero).reason, Reason::inside);
  EXPECT_EQ(with(Rounding::ceil).reason, Reason::tie);
  EXPECT_EQ(with(Rounding::nearest_even).reason, Reason::tie);
  EXPECT_EQ(with(Rounding::nearest_even).verdict, Verdict::required) << "a left edge";
  EXPECT_EQ(with(Rounding::floor).verdict, Verdict::required);
  // At the centre, 1.5 = 18/12 is the sample: now the edge cut down to it goes through.
  contract.sample_position.reset();
  EXPECT_EQ(with(Rounding::floor).reason, Reason::tie);
  EXPECT_EQ(with(Rounding::ceil).verdict, Verdict::forbidden);
}

TEST(Corners, AreSampledWhereTheContractSaysSo) {
  // Covers x >= 1, y >= 1, x + y <= 4.5.
  cases::Case c = triangle({at(1, 1), at(1, 3.5F), at(3.5F, 1)});
  cases::Contract contract = cases::contract_of(c);
  contract.sample_position = PixelFraction{0, 0, 1};
  EXPECT_EQ(verdict(c, contract, 1, 1).verdict, Verdict::required) << "a corner of top and left";
  EXPECT_EQ(verdict(c, contract, 2, 2).verdict, Verdict::required) << "2 + 2 < 4.5";
  EXPECT_EQ(verdict(c, contract, 3, 1).reason, Reason::tie) << "on the top edge";
  EXPECT_EQ(verdict(c, contract, 0, 1).verdict, Verdict::forbidden);
  EXPECT_EQ(verdict(c, cases::contract_of(c), 2, 2).verdict, Verdict::forbidden)
      << "2.5 + 2.5 > 4.5";
}

TEST(Centres, AreTheSamplePositionOfTheContract) {
  cases::Case c = triangle({at(0, 0), at(0, 4), at(4, 0)});
  c.attributes[0].location = cases::Location::center;
  c.attribute_values = {0, 0, 4};  // the window x
  cases::Contract contract = cases::contract_of(c);
  contract.sample_position = PixelFraction{1, 1, 3};
  const SceneTruth scene(c, contract);
  const auto value = TriangleTruth(scene, 0).attribute(0, 1, 1, 0);
  ASSERT_TRUE(value);
  EXPECT_EQ(value->lo.to_string(), "4/3");
  EXPECT_EQ(value->hi, value->lo);
}

/// The edges of a triangle through the sample (1.5, 1.5), by the direction of their inside.
struct Edge {
  std::string name;
  std::array<cases::ClipVertex, 3> positions;
};
const std::vector<Edge>& edges() {
  static const std::vector<Edge> kEdges{
      {"left", {at(1.5F, -8), at(1.5F, 8), at(9, 0)}},
      {"right", {at(1.5F, -8), at(1.5F, 8), at(-9, 0)}},
      {"top", {at(-8, 1.5F), at(8, 1.5F), at(0, 9)}},
      {"bottom", {at(-8, 1.5F), at(8, 1.5F), at(0, -9)}},
      {"left and top", {at(-6.5F, 9.5F), at(9.5F, -6.5F), at(9.5F, 9.5F)}},
      {"right and bottom", {at(-6.5F, 9.5F), at(9.5F, -6.5F), at(-6.5F, -6.5F)}},
      {"left and bottom", {at(-6.5F, -6.5F), at(9.5F, 9.5F), at(9.5F, -6.5F)}},
      {"right and top", {at(-6.5F, -6.5F), at(9.5F, 9.5F), at(-6.5F, 9.5F)}}};
  return kEdges;
}

TEST(TieRules, OwnTheirEdges) {
  // In the order of edges(): left, right, top, bottom, left and top, right and bottom, left and
  // bottom, right and top.
  const std::vector<std::pair<TieRule, std::string>> rules{{TieRule::top_left, "10101010"},
                                                           {TieRule::bottom_left, "10011010"},
                                                           {TieRule::top_right, "01100101"},
                                                           {TieRule::bottom_right, "01010101"},
                                                           {TieRule::top_then_left, "10101001"},
                                                           {TieRule::top_then_right, "01101001"},
                                                           {TieRule::bottom_then_left, "10010110"},
                                                           {TieRule::bottom_then_right, "01010110"},
                                                           {TieRule::all, "11111111"},
                                                           {TieRule::none, "00000000"}};
  for (const auto& [rule, owners] : rules) {
    for (std::size_t i = 0; i < edges().size(); ++i) {
      const cases::Case c = triangle(edges()[i].positions);
      cases::Contract contract = cases::contract_of(c);
      contract.tie_rule = rule;
      const records::SampleVerdict decision = verdict(c, contract, 1, 1);
      EXPECT_EQ(decision.verdict == Verdict::required, owners[i] == '1')
          << edges()[i].name << ", rule " << static_cast<int>(rule);
      EXPECT_NE(decision.verdict, Verdict::permitted);
    }
  }
}

// With window y up, top edges have their inside at lesser y.
TEST(TieRules, AreAsDisplayed) {
  cases::Case c = triangle(edges()[2].positions);  // inside at greater y
  c.rules = cases::Rules::opengl;
  cases::Contract contract = cases::contract_of(c);
  contract.tie_rule = TieRule::bottom_then_left;
  EXPECT_EQ(verdict(c, contract, 1, 1).verdict, Verdict::required);
  contract.tie_rule = TieRule::top_then_left;
  EXPECT_EQ(verdict(c, contract, 1, 1).verdict, Verdict::forbidden);
}

TEST(Culls, LeavesOutOneOrientation) {
  // Window y points down: (0, 0), (4, 0), (0, 4) turns clockwise as displayed.
  const cases::Case clockwise = triangle({at(0, 0), at(4, 0), at(0, 4)});
  const cases::Case counter = triangle({at(0, 0), at(0, 4), at(4, 0)});
  cases::Contract contract = cases::contract_of(clockwise);
  contract.culls = Winding::clockwise;
  EXPECT_EQ(verdict(clockwise, contract, 0, 0).reason, Reason::culled);
  EXPECT_EQ(verdict(counter, contract, 0, 0).verdict, Verdict::required);
  contract.culls = Winding::counter_clockwise;
  EXPECT_EQ(verdict(clockwise, contract, 0, 0).verdict, Verdict::required);
  EXPECT_EQ(verdict(counter, contract, 0, 0).reason, Reason::culled);
}

TEST(LeastArea, PermitsThatSmallTrianglesAreMissing) {
  const cases::Case c = triangle({at(0, 0), at(0, 2), at(2, 0)});  // 2 square pixels
  cases::Contract contract = cases::contract_of(c);
  const auto with = [&](float least) {
    contract.least_area = least;
    return verdict(c, contract, 0, 0);
  };
  EXPECT_EQ(with(1.75F).verdict, Verdict::required);
  EXPECT_EQ(with(2.25F).verdict, Verdict::permitted);
  EXPECT_EQ(verdict(c, contract, 1, 1).verdict, Verdict::forbidden) << "outside all the same";
  // On a grid of whole pixels vertices may move, so the area may shrink below 1.75.
  contract.coverage = Snapping{0, Rounding::unspecified, 0};
  EXPECT_EQ(with(1.75F).verdict, Verdict::permitted);
}

TEST(LeavingOut, TakesThePlaceOfClipping) {
  cases::Case c = triangle({at(0, 0), at(0, 4), at(4, 0)});
  cases::Contract contract = cases::contract_of(c);
  contract.culls_instead_of_clipping = true;
  EXPECT_EQ(verdict(c, contract, 0, 0).verdict, Verdict::required) << "nothing is beyond";
  cases::Case beyond_far = c;
  beyond_far.positions[0].z = 1;
  EXPECT_EQ(verdict(beyond_far, contract, 1, 1).verdict, Verdict::required) << "on the far plane";
  beyond_far.positions[0].z = 1.0000001F;
  EXPECT_EQ(verdict(beyond_far, contract, 1, 1).reason, Reason::clipped);
  beyond_far.depth_clamp = true;
  EXPECT_EQ(verdict(beyond_far, contract, 1, 1).verdict, Verdict::required);
  cases::Case behind = c;
  behind.positions[1].w = 0;
  EXPECT_EQ(verdict(behind, contract, 0, 0).reason, Reason::clipped);
  contract.guard_beyond_viewport = 1;
  EXPECT_EQ(verdict(triangle({at(-1, 0), at(0, 4), at(5, 0)}), contract, 0, 0).verdict,
            Verdict::required);
  EXPECT_EQ(verdict(triangle({at(-1.25F, 0), at(0, 4), at(4, 0)}), contract, 0, 0).reason,
            Reason::clipped);
  // Snapping with an error leaves open whether a vertex just on the side is beyond it.
  contract.coverage = Snapping{4, Rounding::nearest_even, 0.5F};
  contract.clip_tolerance = 0;
  EXPECT_EQ(verdict(triangle({at(-1, 0), at(0, 4), at(4, 0)}), contract, 0, 0).reason,
            Reason::not_promised);
}

TEST(GuardBand, MayLieAboutTheViewport) {
  // The edge from (-3, ...) is long; where it is cut at the viewport, samples near it are open.
  cases::Case c = triangle({at(-3, 1.03125F), at(8, 2.5F), at(8, 8)});
  cases::Contract contract = cases::contract_of(c);
  contract.coverage = Snapping{4, Rounding::nearest_even, 0};
  contract.clip_tolerance = 64;  // four pixels
  const SceneTruth uncut(c, contract);
  EXPECT_NE(TriangleTruth(uncut, 0).judge(3, 2, 0).verdict, Verdict::permitted);
  contract.guard_beyond_viewport = 2;
  EXPECT_EQ(verdict(c, contract, 3, 2).verdict, Verdict::permitted);
  contract.guard_beyond_viewport = 8;
  EXPECT_NE(verdict(c, contract, 3, 2).verdict, Verdict::permitted);
}

/// The class of a depth drawn at pixel (0, 0).
FragmentClass depth_class(const cases::Contract& contract, float depth) {
  const cases::Case c = triangle({at(0, 0), at(0, 1.5F), at(1.5F, 0)});  // one sample, at depth 0.5
  const SceneTruth scene(c, contract);
  cases::Fragments drawn;
  push(drawn, 0, 0, 0, 0, depth, {0.25F});
  JudgedDrawing judged = judge(scene, drawn);
  records::ErrorStatistics& of_depth = judged.judgement.errors[records::AttributeKind::depth];
  for (const FragmentClass one :
       {FragmentClass::correct, FragmentClass::beyond_bound, FragmentClass::not_a_number}) {
    if (of_depth.classes[one] == 1) return one;
  }
  return FragmentClass::missing;
}

TEST(DepthError, LiesOnOneSide) {
  const cases::Case c = triangle({at(0, 0), at(0, 1.5F), at(1.5F, 0)});
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.depth.constant = 0x1p24F;  // unbounded
  contract.depth_error = cases::DepthError::never_nearer;
  EXPECT_EQ(depth_class(contract, 0.5F), FragmentClass::correct);
  EXPECT_EQ(depth_class(contract, 0.9F), FragmentClass::correct);
  EXPECT_EQ(depth_class(contract, std::nextafter(0.5F, 0.0F)), FragmentClass::beyond_bound);
  EXPECT_EQ(depth_class(contract, std::numeric_limits<float>::quiet_NaN()),
            FragmentClass::not_a_number);
  contract.depth_error = cases::DepthError::never_farther;
  EXPECT_EQ(depth_class(contract, 0.1F), FragmentClass::correct);
  EXPECT_EQ(depth_class(contract, std::nextafter(0.5F, 1.0F)), FragmentClass::beyond_bound);
  // Bounded on the other side: 0.5 has an ULP of 2^-24 below 0.5 and the bound is of max(n, f) = 1.
  contract.bounds.depth.constant = 2;
  EXPECT_EQ(depth_class(contract, 0.5F - 0x1p-22F), FragmentClass::correct);
  EXPECT_EQ(depth_class(contract, 0.5F - 0x1.8p-22F), FragmentClass::beyond_bound);
}

TEST(AbsoluteBounds, AreInUnitsOfTheValue) {
  const cases::Case c = triangle({at(0, 0), at(0, 1.5F), at(1.5F, 0)});
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.depth = {.constant = 0, .absolute = 0x1p-8F};
  EXPECT_EQ(depth_class(contract, 0.5F + 0x1p-8F), FragmentClass::correct);
  EXPECT_EQ(depth_class(contract, 0.5F + 0x1.0001p-8F), FragmentClass::beyond_bound);
  contract.bounds.smooth = {.constant = 0, .absolute = 0x1p-9F};
  const SceneTruth scene(c, contract);
  // In ULP of 0.25, which are 2^-25.
  EXPECT_EQ(TriangleTruth(scene, 0).value_bound(0, 0, 0, 0), Rational(65536));
}

/// Two triangles over all of 4 × 4 pixels, the first at depth `first`, the second at `second`.
cases::Case two_layers(float first, float second) {
  cases::Case c = triangle({at(-8, -8, first), at(-8, 16, first), at(16, -8, first)});
  for (const cases::ClipVertex& p : {at(-8, -8, second), at(-8, 16, second), at(16, -8, second)}) {
    c.positions.push_back(p);
    c.attribute_values.push_back(0.25F);
  }
  c.triangles.push_back({3, 4, 5});
  c.depth_test = cases::DepthTest::less;
  return c;
}

/// How many of the 16 fragments of a drawing of one triangle alone are right.
std::uint64_t right_if_only(const cases::Case& c, const cases::Contract& contract,
                            std::uint32_t triangle) {
  const SceneTruth scene(c, contract);
  cases::Fragments drawn;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      push(drawn, triangle, x, y, 0, c.positions[c.triangles[triangle][0]].z, {0.25F});
    }
  }
  JudgedDrawing judged = judge(scene, drawn);
  return judged.judgement.errors[records::AttributeKind::coverage].classes[FragmentClass::correct];
}

TEST(DepthFunction, SaysWhichOfTwoDepthsStays) {
  using cases::KeptDepth;
  const cases::Case c = two_layers(0.25F, 0.75F);
  cases::Contract contract = cases::contract_of(c);
  for (const bool is_reversed : {false, true}) {
    for (const bool keeps_last : {false, true}) {
      contract.depth_function =
          is_reversed ? (keeps_last ? KeptDepth::greater_or_equal : KeptDepth::greater)
                      : (keeps_last ? KeptDepth::less_or_equal : KeptDepth::less);
      EXPECT_EQ(right_if_only(c, contract, 0), is_reversed ? 0U : 16U);
      EXPECT_EQ(right_if_only(c, contract, 1), is_reversed ? 16U : 0U);
    }
  }
}

TEST(DepthFunction, SaysWhichOfEqualDepthsStays) {
  using cases::KeptDepth;
  const cases::Case c = two_layers(0.5F, 0.5F);
  cases::Contract contract = cases::contract_of(c);
  contract.keeps_equal_depth = true;
  for (const auto& [function, keeps_last] :
       {std::pair(KeptDepth::less, false), std::pair(KeptDepth::greater, false),
        std::pair(KeptDepth::less_or_equal, true), std::pair(KeptDepth::greater_or_equal, true)}) {
    contract.depth_function = function;
    EXPECT_EQ(right_if_only(c, contract, 0), keeps_last ? 0U : 16U);
    EXPECT_EQ(right_if_only(c, contract, 1), keeps_last ? 16U : 0U);
  }
}

TEST(DepthFunction, ComparesWithWhatTheBufferBeginsWith) {
  using cases::KeptDepth;
  cases::Case c = two_layers(0.25F, 0.75F);
  c.depth_clear = 0.5F;
  cases::Contract contract = cases::contract_of(c);
  EXPECT_EQ(right_if_only(c, contract, 0), 16U);
  contract.depth_function = KeptDepth::greater;
  EXPECT_EQ(right_if_only(c, contract, 0), 0U);
  EXPECT_EQ(right_if_only(c, contract, 1), 16U);
  // A depth equal to the beginning passes only a test with "or equal".
  c = two_layers(0.5F, 0.75F);
  c.depth_clear = 0.5F;
  contract.bounds.depth.constant = 0;
  contract.depth_function = KeptDepth::less;
  EXPECT_EQ(right_if_only(c, contract, 0), 0U);
  contract.depth_function = KeptDepth::less_or_equal;
  EXPECT_EQ(right_if_only(c, contract, 0), 16U);
}

// The bound in units of the value counts where two depths are told apart.
TEST(AbsoluteBounds, LeaveTheOrderOfCloseDepthsOpen) {
  const cases::Case c = two_layers(0.5F, 0.5F + 0x1p-10F);
  cases::Contract contract = cases::contract_of(c);
  EXPECT_EQ(right_if_only(c, contract, 1), 0U);
  contract.bounds.depth.absolute = 0x1p-11F;
  EXPECT_EQ(right_if_only(c, contract, 1), 16U);
}

/// The case in a picture three times as wide and high.
cases::Case thrice(cases::Case c) {
  c.framebuffer.width *= 3;
  c.framebuffer.height *= 3;
  for (float* number : {&c.viewport.x, &c.viewport.y, &c.viewport.width, &c.viewport.height}) {
    *number *= 3;
  }
  return c;
}

// A sample at a third of a pixel is a corner of a picture three times as large, and a grid of
// thirds is one of its coarser grids.
RC_GTEST_PROP(Thirds, AreWholeNumbersOfALargerPicture, ()) {
  const auto is_exact = *rc::gen::inRange(0, 3) == 0;
  cases::Case small = is_exact ? random_exact_case() : open_case();
  small.framebuffer.samples = 1;
  cases::Contract contract = cases::contract_of(small);
  if (!is_exact) contract = open_contract(small);
  const auto third_x = *rc::gen::inRange(0, 3);
  const auto third_y = *rc::gen::inRange(0, 3);
  if (contract.coverage) {
    contract.coverage->rounding =
        one_of({Rounding::nearest_even, Rounding::half_up, Rounding::half_down, Rounding::floor,
                Rounding::ceil, Rounding::toward_zero, Rounding::unspecified});
    if (!contract.coverage->is_unspecified()) {
      contract.coverage->rounding_of_y = one_of({Rounding::floor, Rounding::half_up});
    }
  }
  // A pixel's centre is that of the middle one of its nine.
  const auto is_at_centre = *rc::gen::inRange(0, 3) == 0;
  cases::Contract larger = contract;
  if (!is_at_centre) {
    contract.sample_position = PixelFraction{third_x, third_y, 3};
    larger.sample_position = PixelFraction{0, 0, 1};
  }
  if (contract.coverage) contract.coverage->odd_steps = 3;
  larger.guard_band *= 3;
  larger.viewport_error *= 3;

  const SceneTruth of_small(small, contract);
  const SceneTruth of_larger(thrice(small), larger);
  const TriangleTruth one(of_small, 0);
  const TriangleTruth other(of_larger, 0);
  RC_ASSERT(one.orientation() == other.orientation());
  RC_ASSERT(one.has_certain_orientation() == other.has_certain_orientation());
  for (int y = 0; y < small.framebuffer.height; ++y) {
    for (int x = 0; x < small.framebuffer.width; ++x) {
      const int other_x = 3 * x + (is_at_centre ? 1 : third_x);
      const int other_y = 3 * y + (is_at_centre ? 1 : third_y);
      const records::SampleVerdict decision = one.judge(x, y, 0);
      RC_ASSERT(decision.verdict == other.judge(other_x, other_y, 0).verdict);
      RC_ASSERT(decision.reason == other.judge(other_x, other_y, 0).reason);
      if (decision.verdict == Verdict::forbidden) continue;
      const auto is_same = [](const auto& a, const auto& b) {
        return a.has_value() == b.has_value() && (!a || (a->lo == b->lo && a->hi == b->hi));
      };
      RC_ASSERT(is_same(one.depth(x, y, 0), other.depth(other_x, other_y, 0)));
      for (std::size_t a = 0; a < small.attributes.size(); ++a) {
        const bool is_anywhere = small.attributes[a].location == cases::Location::centroid;
        if (is_anywhere) continue;  // the pixels differ in size
        RC_ASSERT(is_same(one.attribute(a, x, y, 0), other.attribute(a, other_x, other_y, 0)));
        RC_ASSERT(one.value_bound(a, x, y, 0) == other.value_bound(a, other_x, other_y, 0));
        const auto slope = one.derivatives(a, x, y, 0);
        const auto smaller = other.derivatives(a, other_x, other_y, 0);
        RC_ASSERT(slope.has_value() == smaller.has_value());
        if (slope) RC_ASSERT(to_field(slope->du) == Field(3) * to_field(smaller->du));
      }
    }
  }
}

// The judge, which decides most fragments in doubles elsewhere, accepts what is exactly right and
// notices what is not.
RC_GTEST_PROP(Thirds, AreJudgedAsTheyAre, ()) {
  cases::Case c = random_exact_case();
  c.framebuffer.samples = 1;
  cases::Contract contract = cases::contract_of(c);
  contract.sample_position = PixelFraction{1, 2, 3};
  contract.tie_rule = one_of({TieRule::top_then_right, TieRule::bottom_right, TieRule::all});
  const SceneTruth scene(c, contract);
  const cases::Fragments drawn = perfect(scene);
  JudgedDrawing judged = judge(scene, drawn);
  for (const auto kind : {records::AttributeKind::coverage, records::AttributeKind::depth,
                          records::AttributeKind::smooth, records::AttributeKind::noperspective}) {
    records::ErrorStatistics& errors = judged.judgement.errors[kind];
    RC_ASSERT(errors.classes[FragmentClass::beyond_bound] == 0U);
    RC_ASSERT(errors.classes[FragmentClass::missing] == 0U);
    RC_ASSERT(errors.classes[FragmentClass::extra] == 0U);
  }
  if (drawn.size() == 0) return;
  cases::Contract at_centres = contract;
  at_centres.sample_position.reset();
  const SceneTruth usual(c, at_centres);
  const cases::Fragments of_centres = perfect(usual);
  const bool is_alike = of_centres.x == drawn.x && of_centres.y == drawn.y;
  if (is_alike) return;
  JudgedDrawing wrong = judge(scene, of_centres);
  records::ErrorStatistics& coverage = wrong.judgement.errors[records::AttributeKind::coverage];
  RC_ASSERT(coverage.classes[FragmentClass::missing] + coverage.classes[FragmentClass::extra] > 0U);
}

}  // namespace
}  // namespace rastercheck::oracle::unusual_contracts_test
