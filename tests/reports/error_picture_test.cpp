#include "reports/error_picture.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace rastercheck::reports::error_picture_test {
namespace {

using cases::Rules;
using records::ErrorMap;
using records::PixelState;

constexpr Color kBackground{242, 242, 238};
constexpr Color kRed{235, 0, 50};
constexpr Color kLeast{27, 26, 84};
constexpr Color kMost{252, 232, 84};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

int lightness(const Color& color) { return color[0] + color[1] + color[2]; }

/// A map that is wide enough to need no margins, with one drawn pixel, at (7, 4).
ErrorMap one_error(float error, PixelState state = PixelState::correct) {
  ErrorMap map{400, 9, {}, {}};
  map.states.resize(3600);
  map.errors.resize(3600);
  map.states[4 * 400 + 7] = state;
  map.errors[4 * 400 + 7] = error;
  return map;
}

Color color_of(float error) { return draw_error_map(one_error(error), Rules::vulkan).at(7, 4); }

// The ends of the ramp, and its middle: the control points are at 2^(-6 + 16/5 k), so 2^2 is
// halfway between the two in the middle. Kills: a ramp over other exponents.
TEST(DrawErrorMap, IsLogarithmicFromOneSixtyFourthToOneThousandTwentyFour) {
  EXPECT_EQ(color_of(0), kLeast);
  EXPECT_EQ(color_of(0x1p-149F), kLeast);
  EXPECT_EQ(color_of(0x1p-6F), kLeast);
  EXPECT_NE(color_of(0x1p-5F), kLeast);
  EXPECT_EQ(color_of(4), (Color{61, 136, 134}));  // the mean of the two in the middle
  EXPECT_NE(color_of(0x1p9F), kMost);
  EXPECT_EQ(color_of(0x1p10F), kMost);
  EXPECT_EQ(color_of(kInfinity), kMost);
  EXPECT_EQ(color_of(kNan), kRed);
}

// Kills: a logarithm that jumps where the exponent changes.
TEST(DrawErrorMap, GrowsLighterWithTheError) {
  int before = lightness(kLeast);
  for (float error = 0x1p-6F; error <= 0x1p10F; error *= 1.0905077F) {
    const int now = lightness(color_of(error));
    EXPECT_GE(now, before) << error;
    EXPECT_LE(now - before, 20) << error;
    before = now;
  }
}

TEST(DrawErrorMap, ViolatedPixelsAreCrossesOverEverythingElse) {
  ErrorMap map = one_error(0, PixelState::violated);
  map.states[4 * 400 + 8] = PixelState::correct;
  const Image image = draw_error_map(map, Rules::vulkan);
  for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    EXPECT_EQ(image.at(7 + dx, 4 + dy), kRed);
  }
  EXPECT_EQ(image.at(8, 5), kBackground);
  EXPECT_EQ(image.at(9, 4), kBackground);
}

TEST(DrawErrorMap, HasRowZeroWhereYPointsTo) {
  ErrorMap map = one_error(0);
  std::swap(map.states[4 * 400 + 7], map.states[7]);
  EXPECT_EQ(draw_error_map(map, Rules::vulkan).at(7, 0), kLeast);
  EXPECT_EQ(draw_error_map(map, Rules::d3d).at(7, 0), kLeast);
  EXPECT_EQ(draw_error_map(map, Rules::opengl).at(7, 8), kLeast);
  EXPECT_EQ(draw_error_map(map, Rules::opengl).at(7, 0), kBackground);
}

// Kills: a legend that a narrow map cuts off.
TEST(DrawErrorMap, HasALegendThatFits) {
  const Image wide = draw_error_map(one_error(0), Rules::vulkan);
  EXPECT_EQ(wide.width, 400);
  EXPECT_GT(wide.height, 9);
  const Image narrow =
      draw_error_map({2, 1, {PixelState::correct, PixelState::empty}, {1, 0}}, Rules::vulkan);
  EXPECT_EQ(narrow.width, 264);
  EXPECT_EQ(narrow.height, wide.height - 8);
  EXPECT_EQ(narrow.at(131, 0), color_of(1));  // in the middle
  EXPECT_EQ(narrow.at(132, 0), kBackground);
  // The bar extends from one end of the ramp to the other.
  int least = 0;
  int most = 0;
  for (int column = 0; column < narrow.width; ++column) {
    least += narrow.at(column, 1 + 12) == kLeast ? 1 : 0;
    most += narrow.at(column, 1 + 12) == kMost ? 1 : 0;
  }
  EXPECT_GE(least, 1);
  EXPECT_GE(most, 1);
}

}  // namespace
}  // namespace rastercheck::reports::error_picture_test
