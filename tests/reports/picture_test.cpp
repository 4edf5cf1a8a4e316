#include "reports/picture.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace rastercheck::reports::picture_test {
namespace {

constexpr Color kBackground{242, 242, 238};
constexpr Color kMagenta{255, 0, 255};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

cases::Case blank(cases::Rules rules, int width, int height) {
  cases::Case c;
  c.rules = rules;
  c.framebuffer = {width, height, 4};
  return c;
}

struct Fragment {
  int x;
  int y;
  int sample;
  float depth;
  std::vector<float> values;
};

cases::Fragments drawn(const std::vector<Fragment>& fragments) {
  cases::Fragments framebuffer;
  framebuffer.attribute_count = fragments.front().values.size();
  for (const Fragment& f : fragments) {
    framebuffer.triangle.push_back(0);
    framebuffer.x.push_back(static_cast<std::uint16_t>(f.x));
    framebuffer.y.push_back(static_cast<std::uint16_t>(f.y));
    framebuffer.sample.push_back(static_cast<std::uint8_t>(f.sample));
    framebuffer.depth.push_back(f.depth);
    framebuffer.attributes.insert(framebuffer.attributes.end(), f.values.begin(), f.values.end());
  }
  return framebuffer;
}

// With a single depth, the light has no effect. Kills: swapping the two attributes.
TEST(DrawPicture, TheCornersOfThePlaneAreThoseOfTheRange) {
  const Image image =
      draw_picture(blank(cases::Rules::vulkan, 5, 1), drawn({{0, 0, 0, 0.5F, {-2, 10}},
                                                             {1, 0, 0, 0.5F, {6, 10}},
                                                             {2, 0, 0, 0.5F, {-2, 30}},
                                                             {3, 0, 0, 0.5F, {6, 30}}}));
  EXPECT_EQ(image.at(0, 0), (Color{52, 92, 132}));
  EXPECT_EQ(image.at(1, 0), (Color{226, 150, 104}));
  EXPECT_EQ(image.at(2, 0), (Color{124, 178, 158}));
  EXPECT_EQ(image.at(3, 0), (Color{246, 222, 168}));
  EXPECT_EQ(image.at(4, 0), kBackground);
}

TEST(DrawPicture, WindowYPointsUpInOpenglOnly) {
  const cases::Fragments lowest = drawn({{1, 0, 0, 0.5F, {1}}});
  const Image up = draw_picture(blank(cases::Rules::opengl, 2, 3), lowest);
  EXPECT_NE(up.at(1, 2), kBackground);
  EXPECT_EQ(up.at(1, 0), kBackground);
  for (const cases::Rules rules : {cases::Rules::vulkan, cases::Rules::d3d}) {
    const Image down = draw_picture(blank(rules, 2, 3), lowest);
    EXPECT_NE(down.at(1, 0), kBackground);
    EXPECT_EQ(down.at(1, 2), kBackground);
  }
}

// Two pixels span the range; the third shows which of several fragments was chosen.
TEST(DrawPicture, ShowsTheNearestFragmentOfTheFirstSampleThatHasOne) {
  const auto third = [](const std::vector<Fragment>& more) {
    std::vector<Fragment> all{{0, 0, 0, 0.5F, {0, 0}}, {2, 0, 0, 0.5F, {1, 0}}};
    all.insert(all.end(), more.begin(), more.end());
    return draw_picture(blank(cases::Rules::vulkan, 5, 1), drawn(all)).at(4, 0);
  };
  const Color zero = third({{4, 0, 0, 0.5F, {0, 0}}});
  const Color one = third({{4, 0, 0, 0.5F, {1, 0}}});
  ASSERT_NE(zero, one);
  EXPECT_EQ(third({{4, 0, 0, 0.75F, {1, 0}}, {4, 0, 0, 0.5F, {0, 0}}}), zero);
  EXPECT_EQ(third({{4, 0, 0, 0.5F, {0, 0}}, {4, 0, 0, 0.75F, {1, 0}}}), zero);
  EXPECT_EQ(third({{4, 0, 3, 0.25F, {1, 0}}, {4, 0, 1, 0.5F, {0, 0}}}), zero);
  EXPECT_EQ(third({{4, 0, 0, kNan, {1, 0}}, {4, 0, 0, 0.5F, {0, 0}}}), zero);
  EXPECT_EQ(third({{4, 0, 0, 0.5F, {1, 0}}, {4, 0, 0, 0.5F, {0, 0}}}), one);
}

TEST(DrawPicture, WhatIsNoNumberIsMagentaAndScalesNothing) {
  const std::vector<Fragment> good{{0, 0, 0, 0.5F, {0, 0}}, {2, 0, 0, 0.5F, {1, 1}}};
  std::vector<Fragment> bad = good;
  bad.push_back({4, 0, 0, 0.5F, {kNan, 0}});
  bad.push_back({5, 0, 0, 0.5F, {0, -kInfinity}});
  bad.push_back({6, 0, 0, kInfinity, {0, 0}});
  const Image image = draw_picture(blank(cases::Rules::vulkan, 8, 1), drawn(bad));
  for (const int column : {4, 5, 6}) EXPECT_EQ(image.at(column, 0), kMagenta) << column;
  const Image without = draw_picture(blank(cases::Rules::vulkan, 8, 1), drawn(good));
  for (const int column : {0, 2}) EXPECT_EQ(image.at(column, 0), without.at(column, 0)) << column;
}

int lightness(const Color& color) { return color[0] + color[1] + color[2]; }

// For a ridge seen from above, the left side faces the light. Kills: an inverted relief.
TEST(DrawPicture, LightComesFromTheUpperLeft) {
  const auto slope_lightness = [](cases::Rules rules, float dx, float dy) {
    std::vector<Fragment> fragments;
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 5; ++x) {
        const float depth = 0.5F + static_cast<float>(x - 2) * dx + static_cast<float>(y - 2) * dy;
        fragments.push_back({x, y, 0, depth, {1}});
      }
    }
    return lightness(draw_picture(blank(rules, 5, 5), drawn(fragments)).at(2, 2));
  };
  constexpr float kStep = 1.0F / 32;
  using cases::Rules;
  // Depth increases to the left, so the surface faces left.
  EXPECT_GT(slope_lightness(Rules::vulkan, -kStep, 0), slope_lightness(Rules::vulkan, kStep, 0));
  EXPECT_GT(slope_lightness(Rules::vulkan, 0, -kStep), slope_lightness(Rules::vulkan, 0, kStep));
  EXPECT_LT(slope_lightness(Rules::opengl, 0, -kStep), slope_lightness(Rules::opengl, 0, kStep));
}

// Kills: an index beyond the picture.
TEST(DrawPicture, IgnoresFragmentsOutside) {
  const Image image = draw_picture(blank(cases::Rules::opengl, 2, 2),
                                   drawn({{2, 1, 0, 0.5F, {1}}, {0, 2, 0, 0.5F, {1}}}));
  EXPECT_EQ(image, Image::filled(2, 2, kBackground));
  EXPECT_EQ(draw_picture(blank(cases::Rules::vulkan, 2, 2), {}), Image::filled(2, 2, kBackground));
}

TEST(DrawPicture, TakesTheDepthWhereThereAreNoAttributes) {
  const Image image = draw_picture(blank(cases::Rules::vulkan, 3, 1),
                                   drawn({{0, 0, 0, 0.25F, {}}, {2, 0, 0, 0.75F, {}}}));
  EXPECT_LT(image.at(0, 0)[0], image.at(2, 0)[0]);  // from blue to apricot
}

}  // namespace
}  // namespace rastercheck::reports::picture_test
