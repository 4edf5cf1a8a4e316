// Verdicts, by hand (RULES §2). Pictures show window rows from v = 0 on, one character per sample.

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::coverage_test {
namespace {

using cases::ClipVertex;
using cases::Cull;
using cases::FrontFace;
using cases::Rules;
using cases::TieRule;

/// "#" required, "?" permitted, "." forbidden; rows joined by '/'.
std::string picture(const cases::Case& c, int sample = 0) {
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  std::string text;
  for (int y = 0; y < c.framebuffer.height; ++y) {
    if (y > 0) text += '/';
    for (int x = 0; x < c.framebuffer.width; ++x) {
      switch (truth.judge(x, y, sample).verdict) {
        case records::Verdict::required:
          text += '#';
          break;
        case records::Verdict::permitted:
          text += '?';
          break;
        case records::Verdict::forbidden:
          text += '.';
          break;
      }
    }
  }
  return text;
}

records::Reason reason(const cases::Case& c, int x, int y, int sample = 0) {
  const SceneTruth scene(c, cases::contract_of(c));
  return TriangleTruth(scene, 0).judge(x, y, sample).reason;
}

/// A clip position at window (u, v) of a 4 × 4 viewport whose window y follows NDC y.
ClipVertex at_window(float u, float v, float w = 1, float z = 0) {
  return {(u / 2 - 1) * w, (v / 2 - 1) * w, z, w};
}

cases::Case window_triangle(Rules rules, const ClipVertex& a, const ClipVertex& b,
                            const ClipVertex& c) {
  return small_case(rules, 4, 4, {a, b, c});
}

/// A triangle whose two legs, and hypotenuse u + v = 4, run exactly through samples.
cases::Case tied(Rules rules) {
  return window_triangle(rules, at_window(0.5F, 0.5F), at_window(3.5F, 0.5F),
                         at_window(0.5F, 3.5F));
}

TEST(Coverage, IsTheInteriorOfTheThreeEdges) {
  const auto c =
      window_triangle(Rules::vulkan, at_window(0, 0), at_window(3.75F, 0), at_window(0, 3.75F));
  EXPECT_EQ(picture(c), "###./##../#.../....");
  EXPECT_EQ(reason(c, 0, 0), records::Reason::inside);
  EXPECT_EQ(reason(c, 3, 3), records::Reason::outside);
}

TEST(TieRule, OfVulkanTakesTopAndLeftEdges) {
  EXPECT_EQ(picture(tied(Rules::vulkan)), "###./##../#.../....");
  EXPECT_EQ(reason(tied(Rules::vulkan), 0, 0), records::Reason::tie);
}

TEST(TieRule, OfOpenGlTakesBottomAndLeftEdgesWithWindowYUp) {
  EXPECT_EQ(picture(tied(Rules::opengl)), "###./##../#.../....");
  auto top_left = tied(Rules::opengl);
  top_left.fill_rule = TieRule::top_left;
  EXPECT_EQ(picture(top_left), "..../##../#.../....");
}

TEST(TieRule, BottomLeftLeavesOutTheTopRowWithWindowYDown) {
  auto c = tied(Rules::vulkan);
  c.fill_rule = TieRule::bottom_left;
  EXPECT_EQ(picture(c), "..../##../#.../....");
}

TEST(TieRule, DoesNotDependOnVertexOrder) {
  for (const cases::Triangle& order :
       {cases::Triangle{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
    auto c = tied(Rules::vulkan);
    c.triangles[0] = order;
    EXPECT_EQ(picture(c), "###./##../#.../....");
  }
}

TEST(TieRule, UnspecifiedPermitsWhatLiesOnAnEdge) {
  const cases::Case c = tied(Rules::vulkan);
  cases::Contract contract = cases::contract_of(c);
  contract.tie_rule = TieRule::unspecified;
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(truth.judge(0, 0, 0).verdict, records::Verdict::permitted);
  EXPECT_EQ(truth.judge(0, 0, 0).reason, records::Reason::tie);
  EXPECT_EQ(truth.judge(1, 1, 0).verdict, records::Verdict::required);
}

TEST(WindowY, OfD3dRunsAgainstNdcY) {
  // NDC (−1,−1), (1,−1), (−1,1): the right angle is at the bottom left of the display, v = 4.
  const auto c =
      small_case(Rules::d3d, 4, 4, {{{-1, -1, 0, 1}, {0.75F, -1, 0, 1}, {-1, 0.75F, 0, 1}}});
  EXPECT_EQ(picture(c), "..../#.../##../###.");
}

TEST(Eye, BehindItAVertexOpensAWedgeBeyondTheOppositeEdge) {
  // w = −1 at window (2, 0): the visible part lies beyond the edge (0,2)–(4,2), on the side away
  // from that vertex.
  const auto c =
      window_triangle(Rules::vulkan, at_window(2, 0, -1), at_window(0, 2), at_window(4, 2));
  EXPECT_EQ(picture(c), "..../..../####/####");
}

TEST(Eye, BehindItAWholeTriangleCoversNothing) {
  const auto c =
      window_triangle(Rules::vulkan, at_window(0, 0, -1), at_window(4, 0, -2), at_window(0, 4, -1));
  EXPECT_EQ(picture(c), "..../..../..../....");
}

TEST(Eye, InThePlaneOfATriangleSeesNothing) {
  const auto c = small_case(Rules::vulkan, 4, 4, {{{1, 1, 0, 1}, {-1, -1, 0, 1}, {2, 2, 0, 5}}});
  EXPECT_EQ(picture(c), "..../..../..../....");
  EXPECT_EQ(reason(c, 1, 1), records::Reason::degenerate);
}

TEST(DepthPlane, IsInsideItselfAndOutsideOneUlpBeyond) {
  const auto flat = [](Rules rules, float z) {
    return window_triangle(rules, at_window(0, 0, 1, z), at_window(8, 0, 1, z),
                           at_window(0, 8, 1, z));
  };
  const std::string all = "####/####/####/####";
  const std::string none = "..../..../..../....";
  EXPECT_EQ(picture(flat(Rules::vulkan, 0)), all);
  EXPECT_EQ(picture(flat(Rules::vulkan, -0x1p-149F)), none);
  EXPECT_EQ(picture(flat(Rules::vulkan, 1)), all);
  EXPECT_EQ(picture(flat(Rules::vulkan, std::nextafterf(1, 2))), none);
  EXPECT_EQ(picture(flat(Rules::opengl, -1)), all);
  EXPECT_EQ(picture(flat(Rules::opengl, std::nextafterf(-1, -2))), none);
  auto clamped = flat(Rules::vulkan, 2);
  clamped.depth_clamp = true;
  EXPECT_EQ(picture(clamped), all);
}

TEST(DepthPlane, CutsWhereTheDepthPassesIt) {
  // z/w = 1/2 − u/4 passes 0 at u = 2, between samples.
  const auto c = window_triangle(Rules::vulkan, at_window(0, 0, 1, 0.5F), at_window(8, 0, 1, -1.5F),
                                 at_window(0, 8, 1, 0.5F));
  EXPECT_EQ(picture(c), "##../##../##../##..");
  EXPECT_EQ(reason(c, 2, 0), records::Reason::clipped);
}

TEST(ClipDistance, AndItsNegativeShareEverySampleOnce) {
  // f = u − 3/2 passes through the samples of column 1.
  auto c = window_triangle(Rules::vulkan, at_window(0, 0), at_window(8, 0), at_window(0, 8));
  c.clip_distance_count = 1;
  c.clip_distances = {-1.5F, 6.5F, -1.5F};
  EXPECT_EQ(picture(c), ".###/.###/.###/.###");
  EXPECT_EQ(reason(c, 1, 0), records::Reason::tie);
  for (float& d : c.clip_distances) d = -d;
  EXPECT_EQ(picture(c), "#.../#.../#.../#...");
  c.rules = Rules::d3d;  // f >= 0 includes zero on both sides
  c.viewport = {0, 4, 4, -4, 0, 1};
  EXPECT_EQ(picture(c), "##../##../##../##..");
}

TEST(ClipDistance, ThatIsZeroEverywhereCutsNothing) {
  auto c = window_triangle(Rules::vulkan, at_window(0, 0), at_window(8, 0), at_window(0, 8));
  c.clip_distance_count = 1;
  c.clip_distances = {0, 0, -0.0F};
  EXPECT_EQ(picture(c), "####/####/####/####");
}

TEST(Facing, IsAsDisplayed) {
  // (0,0) → (4,0) → (0,4): with v down this turns clockwise on the screen, with v up
  // counter-clockwise.
  const auto drawn = [](Rules rules, Cull cull, FrontFace front) {
    auto c = window_triangle(rules, at_window(0, 0), at_window(3.75F, 0), at_window(0, 3.75F));
    c.cull = cull;
    c.front_face = front;
    return picture(c) != "..../..../..../....";
  };
  EXPECT_TRUE(drawn(Rules::vulkan, Cull::back, FrontFace::cw));
  EXPECT_FALSE(drawn(Rules::vulkan, Cull::back, FrontFace::ccw));
  EXPECT_FALSE(drawn(Rules::vulkan, Cull::front, FrontFace::cw));
  EXPECT_TRUE(drawn(Rules::opengl, Cull::back, FrontFace::ccw));
  EXPECT_FALSE(drawn(Rules::opengl, Cull::front, FrontFace::ccw));
  EXPECT_TRUE(drawn(Rules::opengl, Cull::front, FrontFace::cw));
}

TEST(Viewport, BoundsItHalfOpen) {
  // Sample 12 of the 16-sample pattern lies on the left side of its pixel, so x = 2 is the far
  // border of the viewport.
  auto c = window_triangle(Rules::d3d, {-8, -8, 0, 1}, {8, -8, 0, 1}, {0, 16, 0, 1});
  c.framebuffer.samples = 16;
  c.viewport = {0, 0, 2, 4, 0, 1};
  EXPECT_EQ(picture(c, 12), "##../##../##../##..");
  c.rules = Rules::vulkan;
  EXPECT_EQ(picture(c, 12), "##?./##?./##?./##?.");
  EXPECT_EQ(reason(c, 2, 0, 12), records::Reason::clip_edge);
  EXPECT_EQ(reason(c, 3, 0, 12), records::Reason::viewport);
  c.rules = Rules::opengl;
  EXPECT_EQ(picture(c, 12), "##?./##?./##?./##?.");
}

TEST(Scissor, KeepsItsPixels) {
  auto c = window_triangle(Rules::vulkan, at_window(0, 0), at_window(8, 0), at_window(0, 8));
  c.scissor = cases::Scissor{1, 2, 2, 9};
  EXPECT_EQ(picture(c), "..../..../.##./.##.");
}

TEST(Distance, IsToTheNearestBoundaryInPixels) {
  const auto c = window_triangle(Rules::vulkan, at_window(0, 0), at_window(4, 0), at_window(0, 4));
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  EXPECT_EQ(*truth.distance(0, 0, 0), (records::Enclosure{0.5, 0.5}));
  EXPECT_EQ(*truth.distance(0, 3, 0), (records::Enclosure{0, 0}));  // on the hypotenuse
  const records::Enclosure inside = *truth.distance(1, 1, 0);       // (4 − 3)/√2
  EXPECT_LT(inside.lo, inside.hi);
  EXPECT_TRUE(records::contains(inside, std::sqrt(0.5)) ||
              records::contains(inside, std::nextafter(std::sqrt(0.5), 0)));
  const records::Enclosure outside = *truth.distance(3, 3, 0);  // (4 − 7)/√2
  EXPECT_NEAR(outside.lo, -2.1213203435596424, 0x1p-50);
  EXPECT_LE(outside.lo, outside.hi);
}

TEST(Distance, OfATriangleWithoutAreaIsNone) {
  const auto c = small_case(Rules::vulkan, 4, 4, {{{1, 1, 0, 1}, {1, 1, 0, 1}, {2, 0, 0, 1}}});
  const SceneTruth scene(c, cases::contract_of(c));
  EXPECT_FALSE(TriangleTruth(scene, 0).distance(1, 1, 0));
}

// By hand: z = 1/2 + v/8 over 8 rows, so that the far plane z = w lies at v = 4; max|z| + max|w| is
// 7/2, and an error e relative to it moves the plane by 28 e rows.
TEST(ClipError, LeavesOpenWhatIsNearAPlaneByItsDistance) {
  cases::Case c = small_case(cases::Rules::vulkan, 1, 8,
                             {{{-1, -1, 0.5F, 1}, {3, -1, 0.5F, 1}, {-1, 3, 2.5F, 1}}}, {});
  const auto verdicts = [&c](double error) {
    cases::Contract contract;
    contract.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
    contract.clip_error = error;
    const SceneTruth scene(c, contract);
    const TriangleTruth truth(scene, 0);
    std::string all;
    for (int y = 0; y < 8; ++y) {
      const records::Verdict verdict = truth.judge(0, y, 0).verdict;
      all += verdict == records::Verdict::required    ? 'r'
             : verdict == records::Verdict::permitted ? 'p'
                                                      : 'f';
    }
    return all;
  };
  EXPECT_EQ(verdicts(0), "rrrrffff");
  EXPECT_EQ(verdicts(1.0 / 64), "rrrrffff");  // 7/16 of a row
  EXPECT_EQ(verdicts(1.0 / 32), "rrrppfff");  // 7/8 of a row
  EXPECT_EQ(verdicts(1.0 / 16), "rrppppff");  // 7/4 of a row
}

}  // namespace
}  // namespace rastercheck::oracle::coverage_test
