// Depths and attributes by qualifier and location (RULES §4), by hand. The triangle's window
// corners are (0,0), (4,0), (0,4); weights e = (1 − u/4 − v/4, u/4, v/4) where all w = 1.

#include <gtest/gtest.h>

#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::values_test {
namespace {

using cases::Interpolation;
using cases::Location;
using cases::Rules;

cases::Case corner(Rules rules, const std::array<std::vector<float>, 3>& values,
                   const std::array<float, 3>& z = {0, 0, 0}, float w1 = 1) {
  const float top = rules == Rules::d3d ? 1.0F : -1.0F;
  return small_case(rules, 4, 4,
                    {{{-1, top, z[0], 1}, {w1, top * w1, z[1] * w1, w1}, {-1, -top, z[2], 1}}},
                    values);
}

std::string text(const std::optional<ValueRange>& value) {
  if (!value) return "undefined";
  if (!value->is_open) return value->lo.to_string();
  return "[" + value->lo.to_string() + ", " + value->hi.to_string() + "]";
}

std::string attribute(const cases::Case& c, int x, int y, int sample = 0) {
  const SceneTruth scene(c, cases::contract_of(c));
  return text(TriangleTruth(scene, 0).attribute(0, x, y, sample));
}

std::string depth(const cases::Case& c, int x, int y) {
  const SceneTruth scene(c, cases::contract_of(c));
  return text(TriangleTruth(scene, 0).depth(x, y, 0));
}

TEST(Smooth, IsRationalLinear) {
  const auto c = corner(Rules::vulkan, {{{0}, {1}, {0}}}, {}, 2);  // u/(8 − u)
  EXPECT_EQ(attribute(c, 0, 0), "1/15");
  EXPECT_EQ(attribute(c, 1, 0), "3/13");
}

TEST(Noperspective, IsLinearInWindowSpace) {
  auto c = corner(Rules::vulkan, {{{0}, {1}, {0}}}, {}, 2);
  c.attributes[0].interpolation = Interpolation::noperspective;
  EXPECT_EQ(attribute(c, 0, 0), "1/8");
  EXPECT_EQ(attribute(c, 1, 0), "3/8");
}

TEST(Flat, TakesTheProvokingVertex) {
  for (const auto& [rules, expected] :
       {std::pair(Rules::opengl, "3"), std::pair(Rules::vulkan, "1"), std::pair(Rules::d3d, "1")}) {
    auto c = corner(rules, {{{1}, {2}, {3}}});
    c.attributes[0].interpolation = Interpolation::flat;
    EXPECT_EQ(attribute(c, 0, 0), expected);
  }
}

TEST(Center, ExtrapolatesWhereItIsNotCovered) {
  auto c = corner(Rules::vulkan, {{{0}, {4}, {0}}});  // r = u
  c.framebuffer.samples = 4;
  c.attributes[0].location = Location::center;
  // Sample 0 of pixel (3, 0), at (3.375, 0.125), is covered; the centre lies on the hypotenuse and
  // is not covered.
  EXPECT_EQ(attribute(c, 3, 0, 0), "7/2");
}

TEST(Center, IsUndefinedBehindTheHorizon) {
  // With w1 = −1, 1/w is 1 at the left border and −1 at the right border: 1 − u/2, zero at u = 2.
  auto c = corner(Rules::vulkan, {{{0}, {1}, {0}}}, {}, -1);
  c.attributes[0].location = Location::center;
  EXPECT_EQ(attribute(c, 2, 0), "undefined");
  c.attributes[0].interpolation = Interpolation::noperspective;
  EXPECT_EQ(attribute(c, 2, 0), "undefined");
  EXPECT_EQ(attribute(c, 1, 0), "3/8");
}

TEST(Centroid, OfD3dIsTheCentreWhereAllSamplesAreCovered) {
  auto c = corner(Rules::d3d, {{{0}, {4}, {0}}});  // r = u
  c.framebuffer.samples = 4;
  c.attributes[0].location = Location::centroid;
  EXPECT_EQ(attribute(c, 0, 0), "1/2");
}

TEST(Centroid, OfD3dIsElseTheFirstCoveredSample) {
  auto c = corner(Rules::d3d, {{{0}, {4}, {0}}});
  c.framebuffer.samples = 4;
  c.attributes[0].location = Location::centroid;
  // Pixel (3, 0): sample 0 at (3.375, 0.125) is inside u + v < 4, sample 3 at (3.625, 0.875) is
  // not.
  EXPECT_EQ(attribute(c, 3, 0, 0), "27/8");
}

TEST(Centroid, OfVulkanIsAnyPointOfPixelAndTriangle) {
  auto c = corner(Rules::vulkan, {{{0}, {4}, {0}}});
  c.framebuffer.samples = 4;
  c.attributes[0].location = Location::centroid;
  EXPECT_EQ(attribute(c, 0, 0), "[0, 1]");
  c.attribute_values = {0, 0, 4};  // r = v; in pixel (3, 0), v reaches from 0 to 1 only at u = 3
  EXPECT_EQ(attribute(c, 3, 0, 0), "[0, 1]");
  c.attribute_values = {0, 4, 4};  // r = u + v, at most 4 on the hypotenuse
  EXPECT_EQ(attribute(c, 3, 0, 0), "[3, 4]");
}

TEST(Depth, IsMappedByTheRules) {
  const std::array<float, 3> z{0, 0.5F, 0};  // z = u/8
  const std::array<std::vector<float>, 3> none{};
  EXPECT_EQ(depth(corner(Rules::vulkan, none, z), 1, 0), "3/16");
  EXPECT_EQ(depth(corner(Rules::d3d, none, z), 1, 0), "3/16");
  EXPECT_EQ(depth(corner(Rules::opengl, none, z), 1, 0), "19/32");  // (3/16 + 1)/2
}

TEST(Depth, RunsThroughTheDepthRangeInEitherOrder) {
  auto c = corner(Rules::vulkan, {}, {0, 0.5F, 0});
  c.viewport.min_depth = 1;
  c.viewport.max_depth = 0.5F;
  EXPECT_EQ(depth(c, 1, 0), "29/32");  // 1 − (1/2)(3/16)
}

TEST(Depth, IsAPlaneInWindowSpaceWhateverW) {
  // z/w is linear in the window: at u = 2 it is half-way between 0 and 1/2, although w runs from 1
  // to 4.
  const auto c = corner(Rules::vulkan, {}, {0, 0.5F, 0}, 4);
  EXPECT_EQ(depth(c, 1, 0), "3/16");
}

TEST(DepthClamp, BoundsByTheDepthRange) {
  auto c = corner(Rules::vulkan, {}, {2, 2, 2});
  c.depth_clamp = true;
  c.viewport.max_depth = 0.75F;
  EXPECT_EQ(depth(c, 1, 0), "3/4");
}

TEST(Unspecified, GivesEveryValueAsARange) {
  auto c = corner(Rules::vulkan, {{{0}, {4}, {0}}});
  c.attributes.push_back({"f", Interpolation::flat, Location::sample});
  c.attribute_values = {0, 7, 4, 7, 0, 7};
  c.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
  c.basis = cases::Basis::unspecified;
  // All vertices lie on the grid, so that there is one placement and each range is a point.
  EXPECT_EQ(attribute(c, 0, 0), "[1/2, 1/2]");
  EXPECT_EQ(depth(c, 0, 0), "[0, 0]");
  const SceneTruth scene(c, cases::contract_of(c));
  EXPECT_EQ(text(TriangleTruth(scene, 0).attribute(1, 0, 0, 0)), "[7, 7]");
}

TEST(Noperspective, IsFreeWhereSomeWIsNotPositive) {
  auto c = corner(Rules::vulkan, {{{0, 0}, {1, 1}, {0, 0}}}, {}, -1);
  c.attributes[1].interpolation = Interpolation::noperspective;
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  EXPECT_FALSE(truth.is_value_free(0));
  EXPECT_TRUE(truth.is_value_free(1));
  c.positions[1] = {1, -1, 0, 1};
  const SceneTruth positive(c, cases::contract_of(c));
  EXPECT_FALSE(TriangleTruth(positive, 0).is_value_free(1));
}

TEST(Magnitude, IsTheLargestVertexValue) {
  const auto c = corner(Rules::vulkan, {{{-3}, {1}, {2}}});
  const SceneTruth scene(c, cases::contract_of(c));
  EXPECT_EQ(TriangleTruth(scene, 0).attribute_magnitude(0).to_string(), "3");
}

}  // namespace
}  // namespace rastercheck::oracle::values_test
