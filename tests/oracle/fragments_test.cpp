#include "oracle/fragments.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::fragments_test {
namespace {

/// Layers that cover all of a 2 × 2 framebuffer, each at one depth.
cases::Case layers(const std::vector<float>& depths) {
  cases::Case c = small_case(cases::Rules::vulkan, 2, 2, {});
  c.positions.clear();
  c.triangles.clear();
  for (const float z : depths) {
    const auto first = static_cast<std::uint32_t>(c.positions.size());
    c.positions.insert(c.positions.end(), {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}});
    c.triangles.push_back({first, first + 1, first + 2});
  }
  return c;
}

std::vector<std::string> list(const cases::Case& c) {
  std::vector<std::string> fragments;
  const SceneTruth scene(c, cases::contract_of(c));
  for_each_fragment(scene, [&fragments](const Fragment& f, const TriangleTruth&) {
    fragments.push_back(std::to_string(f.place.triangle) + ":" + std::to_string(f.place.x) +
                        std::to_string(f.place.y) + " " +
                        std::string(to_string(f.decision.verdict)));
    return true;
  });
  return fragments;
}

TEST(Fragments, AreOrderedByTriangleRowColumn) {
  const auto fragments = list(layers({0.5F, 0.25F}));
  const std::vector<std::string> expected{"0:00 required", "0:10 required", "0:01 required",
                                          "0:11 required", "1:00 required", "1:10 required",
                                          "1:01 required", "1:11 required"};
  EXPECT_EQ(fragments, expected);
}

TEST(Fragments, StopWhenTheSinkSaysSo) {
  const cases::Case c = layers({0.5F, 0.25F});
  const SceneTruth scene(c, cases::contract_of(c));
  int seen = 0;
  for_each_fragment(scene, [&seen](const Fragment&, const TriangleTruth&) { return ++seen < 3; });
  EXPECT_EQ(seen, 3);
}

TEST(DepthTest, KeepsTheNearest) {
  cases::Case c = layers({0.5F, 0.25F, 0.75F});
  c.depth_test = cases::DepthTest::less;
  const std::vector<std::string> expected{"1:00 required", "1:10 required", "1:01 required",
                                          "1:11 required"};
  EXPECT_EQ(list(c), expected);
}

TEST(DepthTest, KeepsTheFirstDrawnOfEqualDepths) {
  cases::Case c = layers({0.5F, 0.5F});
  c.depth_test = cases::DepthTest::less;
  EXPECT_EQ(list(c).front(), "0:00 required");
  EXPECT_EQ(list(c).size(), 4U);
}

TEST(DepthTest, PermitsBothWherePermittedCoverageLeavesItOpen) {
  // The left side of the nearer layer passes within half a grid unit of the sample of pixel (0, 0).
  cases::Case c = layers({0.5F, 0.25F});
  c.positions[3].x = -0.51F;  // window u = 0.49
  c.positions[5].x = -0.51F;
  c.coverage = cases::Snapping{4, cases::Rounding::unspecified, 1};
  c.depth_test = cases::DepthTest::less;
  const auto fragments = list(c);
  EXPECT_EQ(fragments.front(), "0:00 permitted");
  EXPECT_TRUE(std::count(fragments.begin(), fragments.end(), "1:00 permitted"));
  EXPECT_TRUE(std::count(fragments.begin(), fragments.end(), "1:10 required"));
}

}  // namespace
}  // namespace rastercheck::oracle::fragments_test
