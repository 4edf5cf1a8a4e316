// Promises for single triangles (cases::TrianglePromise): whatever is not promised is permitted,
// and everything else is judged.

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "oracle/judge.h"

namespace rastercheck::oracle::promises_test {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::NotJudged;
using records::Reason;
using records::Verdict;

/// 4 × 4 pixels; triangle 0 covers the left half, triangle 1 covers everything and is farther away.
cases::Case two_triangles() {
  cases::Case c;
  c.framebuffer = {4, 4, 1};
  c.viewport = {0, 0, 4, 4, 0, 1};
  c.rules = cases::Rules::vulkan;
  c.attributes = {{"r"}};
  c.positions = {{-4, -4, 0.25F, 1}, {0, -4, 0.25F, 1}, {0, 8, 0.25F, 1},
                 {-1, -1, 0.75F, 1}, {3, -1, 0.75F, 1}, {-1, 3, 0.75F, 1}};
  c.attribute_values = {1, 1, 1, 2, 2, 2};
  c.triangles = {{0, 1, 2}, {3, 4, 5}};
  return c;
}

/// A contract that promises nothing about triangle 0.
cases::Contract without_the_first(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  contract.triangles.resize(2);
  contract.triangles[0].is_made = false;
  return contract;
}

void draw(cases::Fragments& drawn, std::uint32_t triangle, int x, int y, float depth, float value) {
  drawn.attribute_count = 1;
  drawn.triangle.push_back(triangle);
  drawn.x.push_back(static_cast<std::uint16_t>(x));
  drawn.y.push_back(static_cast<std::uint16_t>(y));
  drawn.sample.push_back(0);
  drawn.depth.push_back(depth);
  drawn.attributes.push_back(value);
}

TEST(TrianglePromise, NotMadePermitsEverySampleOfTheTarget) {
  cases::Case c = two_triangles();
  c.scissor = cases::Scissor{1, 0, 3, 4};
  c.viewport.width = 2;
  const SceneTruth scene(c, without_the_first(c));
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.judge(0, 0, 0).verdict, Verdict::forbidden) << "the scissor";
  EXPECT_EQ(truth.judge(3, 3, 0).reason, Reason::not_promised) << "beside the viewport";
  EXPECT_EQ(truth.judge(4, 0, 0).verdict, Verdict::forbidden) << "no pixel";
  EXPECT_TRUE(truth.is_value_free(0));
  EXPECT_TRUE(truth.is_value_free(std::nullopt));
  EXPECT_FALSE(TriangleTruth(scene, 1).is_value_free(0));
}

TEST(TrianglePromise, TrianglesWithoutAPromiseAreCountedAndOthersJudged) {
  const cases::Case c = two_triangles();
  const SceneTruth scene(c, without_the_first(c));
  cases::Fragments drawn;
  draw(drawn, 0, 3, 0, 7, 12345);  // any values
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) draw(drawn, 1, x, y, 0.75F, x == 2 && y == 1 ? 3.0F : 2.0F);
  }
  JudgedDrawing judged = judge(scene, drawn);
  records::ErrorStatistics& coverage = judged.judgement.errors[AttributeKind::coverage];
  EXPECT_EQ(coverage.classes[FragmentClass::correct], 17U);
  EXPECT_EQ(coverage.not_judged[NotJudged::not_promised], 1U);
  records::ErrorStatistics& smooth = judged.judgement.errors[AttributeKind::smooth];
  EXPECT_EQ(smooth.not_judged[NotJudged::not_promised], 1U);
  EXPECT_EQ(smooth.classes[FragmentClass::correct], 15U);
  EXPECT_EQ(smooth.classes[FragmentClass::beyond_bound], 1U);
  EXPECT_EQ(judged.judgement.counts.permitted, 16U);
  EXPECT_EQ(judged.judgement.counts.required, 16U);
}

// Kills: a frame that is dropped, or whose pixels are all left open, because of one triangle.
TEST(TrianglePromise, UnderADepthTestSamplesOfOtherTrianglesAreJudged) {
  cases::Case c = two_triangles();
  c.depth_test = cases::DepthTest::less;
  const SceneTruth scene(c, without_the_first(c));
  cases::Fragments drawn;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      if (x == 0 && y == 0) {
        draw(drawn, 0, x, y, 7, 12345);  // a triangle without promises may hide the other
      } else if (x == 3 && y == 3) {
        continue;  // but one of them must be drawn
      } else {
        draw(drawn, 1, x, y, 0.75F, x == 2 && y == 1 ? 3.0F : 2.0F);
      }
    }
  }
  JudgedDrawing judged = judge(scene, drawn);
  records::ErrorStatistics& coverage = judged.judgement.errors[AttributeKind::coverage];
  EXPECT_EQ(coverage.classes[FragmentClass::correct], 15U);
  EXPECT_EQ(coverage.classes[FragmentClass::missing], 1U);
  EXPECT_EQ(coverage.not_judged[NotJudged::not_promised], 1U);
  EXPECT_EQ(judged.judgement.errors[AttributeKind::smooth].classes[FragmentClass::beyond_bound],
            1U);
}

TEST(TrianglePromise, BoundsAreTheTrianglesOwn) {
  const cases::Case c = two_triangles();
  cases::Contract contract = cases::contract_of(c);
  contract.triangles.resize(2);
  contract.triangles[0].bounds.smooth.constant = 8;
  contract.triangles[1].bounds.smooth.constant = 0x1p24F;
  const SceneTruth scene(c, contract);
  EXPECT_EQ(TriangleTruth(scene, 0).value_bound(0, 0, 1, 0), Rational(8.0));
  EXPECT_FALSE(TriangleTruth(scene, 1).value_bound(0, 3, 3, 0));
  EXPECT_TRUE(TriangleTruth(scene, 1).is_value_free(0));
}

/// A viewport whose left side, at about x = 0.47, cuts a triangle: the new vertices may be rounded
/// to 0.5, so that the centre at 0.5 may lie on the edge of the remaining part.
TEST(TrianglePromise, SamplesBesideTheSidesAreOpenWhereCutsAre) {
  cases::Case c = two_triangles();
  c.coverage = cases::Snapping{4, cases::Rounding::unspecified, 0};
  c.triangles = {{3, 4, 5}};
  c.positions[3].x = -3;
  cases::Contract contract = cases::contract_of(c);
  contract.tie_rule = cases::TieRule::unspecified;
  contract.triangles.resize(1);
  contract.triangles[0].side_tolerance = 1;
  for (const auto& [side, verdict] :
       std::vector<std::pair<float, Verdict>>{{0.46875F, Verdict::permitted},
                                              {0.53125F, Verdict::permitted},
                                              {0.40625F, Verdict::required},
                                              {0.59375F, Verdict::forbidden}}) {
    c.viewport.x = side;
    const SceneTruth scene(c, contract);
    const TriangleTruth truth(scene, 0);
    EXPECT_EQ(truth.judge(0, 1, 0).verdict, verdict) << side;
    EXPECT_EQ(truth.judge(1, 1, 0).verdict, Verdict::required) << side;
  }
}

}  // namespace
}  // namespace rastercheck::oracle::promises_test
