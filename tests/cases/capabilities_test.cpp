#include "cases/capabilities.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cases/capabilities_json.h"
#include "cases/json.h"

namespace rastercheck::cases::capabilities_test {
namespace {

Case plain() {
  Case c;
  c.framebuffer = {8, 4, 1};
  c.viewport = {0, 0, 8, 4, 0, 1};
  c.positions = {{0, 0, 0.5F, 1}, {1, 0, 0.5F, 1}, {0, 1, 0.5F, 1}, {0, 0, 5, -1}};
  c.triangles = {{0, 1, 2}};
  c.attributes = {{"a", Interpolation::smooth, Location::sample}};
  c.attribute_values = {1, 2, 3, 4};
  return c;
}

TEST(Capabilities, OfEverythingLackNothing) {
  Case c = plain();
  c.triangles[0][0] = 3;  // behind the eye, and beyond the far plane
  c.viewport = {0.5F, 3, -7.25F, 2, 0.5F, 0};
  c.framebuffer.samples = 16;
  c.depth_test = DepthTest::less;
  c.depth_bias = {1, 1, 0};
  c.depth_format = DepthFormat::unorm16;
  EXPECT_EQ(lacked_by({}, c), "");
  EXPECT_TRUE(Capabilities().is_everything());
}

/// Makes a plain case with one change, and returns what a backend without the feature says about
/// it.
template <typename Change>
std::string without(Feature feature, const Change& change) {
  Capabilities has;
  has.lacks = {feature};
  Case c = plain();
  EXPECT_EQ(lacked_by(has, c), "") << to_string(feature);
  EXPECT_FALSE(needs(c, feature));
  change(c);
  EXPECT_TRUE(needs(c, feature));
  EXPECT_EQ(lacked_by({}, c), "");
  return lacked_by(has, c);
}

// Kills: looking for a feature in the wrong place. The features that only plugins can lack are
// tested in library_test.cpp.
TEST(Capabilities, NameTheFeatureThatIsLacking) {
  EXPECT_EQ(without(Feature::viewport, [](Case& c) { c.viewport.x = 1; }),
            "viewports other than the whole framebuffer");
  EXPECT_EQ(without(Feature::viewport_fractions, [](Case& c) { c.viewport.height = 3.5F; }),
            "fractional viewports");
  EXPECT_EQ(without(Feature::nonpositive_w, [](Case& c) { c.triangles[0][2] = 3; }),
            "vertices with w <= 0");
  EXPECT_EQ(without(Feature::depth_bias, [](Case& c) { c.depth_bias.slope = 0x1p-149F; }),
            "depth bias");
  EXPECT_EQ(without(Feature::unorm_depth, [](Case& c) { c.depth_format = DepthFormat::unorm24; }),
            "depths stored in a unorm format");
  EXPECT_EQ(without(Feature::scissor,
                    [](Case& c) {
                      c.scissor = Scissor{0, 0, 8, 4};
                    }),
            "scissors");
}

TEST(Capabilities, AreOfRulesSizesAndNumbersOfThings) {
  Capabilities has;
  has.rules = {Rules::opengl};
  EXPECT_EQ(lacked_by(has, plain()), "Vulkan's rules");
  has = {};
  has.sample_counts = {1, 4};
  Case c = plain();
  c.framebuffer.samples = 2;
  EXPECT_EQ(lacked_by(has, c), "2 samples");
  has = {};
  has.max_size = 7;
  EXPECT_EQ(lacked_by(has, plain()), "framebuffers of 8 pixels");
  has = {};
  has.max_viewport = 7;
  EXPECT_EQ(lacked_by(has, plain()), "viewports of 8 pixels");
  has = {};
  has.max_attributes = 0;
  EXPECT_EQ(lacked_by(has, plain()), "1 attributes");
  has = {};
  has.max_clip_distances = 1;
  c = plain();
  c.clip_distance_count = 2;
  EXPECT_EQ(lacked_by(has, c), "2 clip distances");
}

TEST(Capabilities, AreOfTrianglesUnlessTheySayMore) {
  Case c;
  c.framebuffer = {4, 4, 1};
  c.primitive = Primitive::lines;
  EXPECT_EQ(lacked_by({}, c), "lines");
  Capabilities has;
  has.primitives = {Primitive::triangles, Primitive::lines};
  EXPECT_EQ(lacked_by(has, c), "");
  EXPECT_TRUE(has_meaning(has));
  c.primitive = Primitive::points;
  EXPECT_EQ(lacked_by(has, c), "points");
  has.primitives = {};
  EXPECT_FALSE(has_meaning(has));
}

// Kills: a limit that excludes too much. A clamp alone changes no depth.
TEST(Capabilities, NeedNoBiasForAClampAlone) {
  Capabilities has;
  has.lacks = {Feature::depth_bias, Feature::unorm_depth};
  Case c = plain();
  c.depth_bias.clamp = 0.5F;
  EXPECT_EQ(lacked_by(has, c), "");
}

TEST(Capabilities, ComeBackAsTheyWere) {
  Capabilities has;
  has.primitives = {Primitive::triangles, Primitive::points};
  has.rules = {Rules::vulkan, Rules::d3d};
  has.sample_counts = {1, 8};
  has.lacks = {Feature::depth_range, Feature::depth_bias, Feature::unorm_depth, Feature::centroid};
  has.max_size = 4096;
  has.max_viewport = 8192;
  has.max_attributes = 3;
  has.max_clip_distances = 0;
  has.numbers = {0x1p-30F, 0x1p24F};
  for (const Capabilities& one : {has, Capabilities()}) {
    const std::string text = json_line(json_of(one));
    EXPECT_EQ(read_json(text, "file", &read_as<Capabilities>).value(), one) << text;
  }
}

TEST(Capabilities, HaveMeaning) {
  Capabilities nothing;
  nothing.rules.clear();
  EXPECT_FALSE(has_meaning(nothing));
  nothing = {};
  nothing.sample_counts = {3};
  EXPECT_FALSE(has_meaning(nothing));
  nothing = {};
  nothing.numbers = {2, 4};
  EXPECT_FALSE(has_meaning(nothing));
  nothing = {};
  nothing.rules = {Rules::vulkan, Rules::opengl};
  EXPECT_FALSE(has_meaning(nothing));
  nothing = {};
  nothing.lacks = {Feature::flat, Feature::flat};
  EXPECT_FALSE(has_meaning(nothing));
  nothing = {};
  nothing.max_size = kMaxSize + 1;
  EXPECT_FALSE(has_meaning(nothing));
  nothing = {};
  nothing.max_attributes = kMaxAttributes + 1;
  EXPECT_FALSE(has_meaning(nothing));
  const auto sorted =
      read_json(R"({"lacks": ["culling", "nonpositive_w"]})", "file", &read_as<Capabilities>);
  ASSERT_TRUE(sorted);
  EXPECT_EQ(sorted->lacks, (std::vector{Feature::nonpositive_w, Feature::culling}));
  const auto refused = read_json(R"({"sample_counts": []})", "file", &read_as<Capabilities>);
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_string(refused.error()), "file: /: is inconsistent or excludes every case");
}

}  // namespace
}  // namespace rastercheck::cases::capabilities_test
