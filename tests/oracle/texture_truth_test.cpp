// Texels of exact coordinates, filtered colours and levels that can be calculated by hand.

#include "oracle/texture_truth.h"

#include <gtest/gtest.h>

#include <vector>

namespace rastercheck::oracle::texture_truth_test {
namespace {

using cases::Filter;
using cases::Wrap;

/// A texture with equal values in all four channels.
cases::Texturing gray(int width, int height, const std::vector<std::uint8_t>& values,
                      Filter filter) {
  cases::Texturing texturing;
  texturing.texture.width = width;
  texturing.texture.height = height;
  for (const std::uint8_t value : values) {
    texturing.texture.texels.insert(texturing.texture.texels.end(), 4, value);
  }
  texturing.filter = filter;
  return texturing;
}

cases::TextureBounds units(float count) {
  cases::TextureBounds bounds;
  bounds.bilinear = count;
  bounds.trilinear = count;
  return bounds;
}

int index_of(double coordinate, int size, Wrap wrap) {
  return texel_index(Rational(coordinate), size, wrap).index;
}

TEST(TexelIndex, WrapsOnBothSides) {
  for (int i = -12; i < 12; ++i) {
    const double s = (i + 0.5) / 4;
    EXPECT_EQ(index_of(s, 4, Wrap::repeat), (i + 12) % 4) << i;
    EXPECT_EQ(index_of(s, 4, Wrap::clamp), i < 0 ? 0 : i > 3 ? 3 : i) << i;
    const int within = (i + 16) % 8;
    EXPECT_EQ(index_of(s, 4, Wrap::mirror), within < 4 ? within : 7 - within) << i;
  }
}

TEST(TexelIndex, BeginsAtTheBorder) {
  const TexelIndex at = texel_index(Rational(-0.25), 4, Wrap::repeat);
  EXPECT_EQ(at.index, 3);
  EXPECT_TRUE(at.is_on_border);
  EXPECT_TRUE(at.is_beyond);
  const TexelIndex below = texel_index(Rational(0.25 - 0x1p-50), 4, Wrap::repeat);
  EXPECT_EQ(below.index, 0);
  EXPECT_FALSE(below.is_on_border);
  EXPECT_FALSE(below.is_beyond);
}

TEST(TexelIndex, IsExactFarAway) {
  EXPECT_EQ(index_of(0x1p120, 3, Wrap::repeat), 0);
  EXPECT_EQ(index_of(0x1p52 + 1, 3, Wrap::repeat), 0);
  EXPECT_EQ(index_of(0x1p51 + 0.5, 3, Wrap::repeat), 1);
  EXPECT_EQ(index_of(-0x1p120, 3, Wrap::clamp), 0);
  EXPECT_EQ(index_of(0x1p120, 3, Wrap::clamp), 2);
}

TEST(TextureTruth, FiltersBetweenCentres) {
  const TextureTruth truth(gray(2, 1, {0, 255}, Filter::bilinear));
  const auto red = [&truth](double s) {
    return truth.bilinear(Rational(s), Rational(0.25), {}, units(1))[0];
  };
  EXPECT_EQ(red(0.25).exact.lo, Rational(0));
  EXPECT_EQ(red(0.5).exact.lo, Rational(0.5));
  EXPECT_EQ(red(0.625).exact.hi, Rational(0.75));
  EXPECT_EQ(red(0).exact.lo, Rational(0.5));  // beside the last texel
  EXPECT_EQ(red(0.5).allowed.lo, Rational(0.5 - 0x1p-24));
  EXPECT_EQ(red(0.5).allowed.hi, Rational(0.5 + 0x1p-24));
}

TEST(TextureTruth, BoundsGrowWithCoordinates) {
  const TextureTruth truth(gray(2, 1, {0, 255}, Filter::bilinear));
  cases::TextureBounds bounds;
  bounds.coordinate_share = 0x1p-10F;
  const auto color =
      truth.bilinear(Rational(0.5), Rational(-3), {Rational(2), Rational(1)}, bounds);
  EXPECT_EQ(color[0].allowed.hi, Rational(0.5 + 2 * 2 * 0x1p-10 + 3 * 0x1p-10));
}

// Five texels become two: each takes 0.4 of the third texel, 254 · 0.4 = 101.6. A single row stays
// as it is.
ValueRange range(double least, double greatest) { return {Rational(least), Rational(greatest)}; }

std::vector<int> texels_within(const TextureTruth& truth, const CoordinateRanges& at,
                               const cases::PictureBounds& bounds = {}) {
  std::vector<int> values;
  for (const TextureTruth::Color& color : truth.nearest_within(at, bounds)) {
    values.push_back(color[0]);
  }
  return values;
}

TEST(TextureTruth, TakesInOneTexelOfARangeBeyondAClampedEnd) {
  cases::Texturing texturing = gray(4, 2, {1, 2, 3, 4, 5, 6, 7, 8}, Filter::nearest);
  texturing.wrap_s = texturing.wrap_t = cases::Wrap::clamp;
  const TextureTruth truth(texturing);
  EXPECT_EQ(texels_within(truth, {range(1e9, 2e9), range(-1e9, 0.25)}), (std::vector<int>{4}));
  EXPECT_EQ(texels_within(truth, {range(-1e9, 0.3), range(1, 1e30)}), (std::vector<int>{5, 6}));
}

TEST(TextureTruth, TakesInTheTexelsOfARange) {
  const TextureTruth truth(gray(4, 2, {1, 2, 3, 4, 5, 6, 7, 8}, Filter::nearest));
  const ValueRange low = range(0.25, 0.25);  // row 0
  EXPECT_EQ(texels_within(truth, {range(0.25, 0.25), low}), (std::vector<int>{2}));
  EXPECT_EQ(texels_within(truth, {range(0.24, 0.26), low}), (std::vector<int>{1, 2}));
  EXPECT_EQ(texels_within(truth, {range(0.1, 0.1), range(0.4, 0.6)}), (std::vector<int>{1, 5}));
  EXPECT_EQ(texels_within(truth, {range(0.9, 1.1), low}), (std::vector<int>{4, 1}));
  EXPECT_TRUE(texels_within(truth, {range(0, 1), low}).empty());  // columns 0 to 4
  cases::PictureBounds bounds;
  bounds.texel_distance = 0x1p-4F;
  EXPECT_EQ(texels_within(truth, {range(0.25, 0.25), low}, bounds), (std::vector<int>{1, 2}));
  EXPECT_EQ(texels_within(truth, {range(0.27, 0.27), low}, bounds), (std::vector<int>{2}));
  bounds.texel_distance = 0;
  bounds.texel_share = 0.25F;  // 1.75 texels are 1.3125 to 2.1875
  EXPECT_EQ(texels_within(truth, {range(0.4375, 0.4375), range(0, 0)}, bounds),
            (std::vector<int>{2, 3}));
}

TEST(TextureTruth, FindsTheExtremesOfABilinearRange) {
  // Along s: 0 up to 1/8, then up to 255 at 3/8, down to 51 at 5/8.
  const TextureTruth truth(gray(4, 1, {0, 255, 51, 51}, Filter::bilinear));
  const ValueRange row = range(0.5, 0.5);
  const auto within = [&](double least, double greatest) {
    return truth.bilinear_within({range(least, greatest), row}, {}, units(0));
  };
  const auto around = within(0.25, 0.5);
  ASSERT_TRUE(around);
  EXPECT_EQ((*around)[0].allowed.lo, Rational(0.5));
  EXPECT_EQ((*around)[0].allowed.hi, Rational(1));
  const auto one = within(0.25, 0.25);
  ASSERT_TRUE(one);
  EXPECT_EQ((*one)[1].allowed.lo, Rational(0.5));
  EXPECT_EQ((*one)[1].allowed.hi, Rational(0.5));
  const auto wider = truth.bilinear_within({range(0.25, 0.25), row}, {}, units(0x1p22F));
  EXPECT_EQ((*wider)[0].allowed.hi, Rational(0.75));
  EXPECT_FALSE(within(-2, 2));
}

TEST(TextureTruth, HalvesOddLevelsByWhatIsCovered) {
  const TextureTruth truth(gray(5, 1, {0, 0, 127, 10, 20}, Filter::trilinear));
  EXPECT_EQ(truth.level_count(), 3U);
  const auto at_level = [&truth](double s, double level) {
    return truth.trilinear(Rational(s), Rational(0.5), {level, level}, {}, units(0))[2].exact;
  };
  // (1/2 · 127) / (5/2) = 25.4; (63.5 + 10 + 20) / 2.5 = 37.4; (25 + 37) / 2 = 31.
  EXPECT_EQ(at_level(0.25, 1).lo.to_string(), "5/51");
  EXPECT_EQ(at_level(0.75, 1).lo.to_string(), "37/255");
  EXPECT_EQ(at_level(0.1, 2).lo.to_string(), "31/255");
  EXPECT_EQ(at_level(0.25, 1.5).lo.to_string(), "28/255");
  EXPECT_EQ(at_level(0.25, 7).hi.to_string(), "31/255");
}

TEST(TextureTruth, RoundsHalvesUp) {
  const TextureTruth truth(gray(2, 1, {0, 1}, Filter::trilinear));
  EXPECT_EQ(
      truth.trilinear(Rational(0.5), Rational(0.5), {1, 1}, {}, units(0))[0].exact.lo.to_string(),
      "1/255");
}

// At 0.625, level 0 is 0, level 1 (texels 0 and 128) is 96, and level 2 is 64. So the colour is 48
// at λ = 1/2 and 80 at λ = 3/2.
TEST(TextureTruth, TakesInWholeLevelsOfARange) {
  const TextureTruth truth(gray(4, 1, {0, 0, 0, 255}, Filter::trilinear));
  const auto range =
      truth.trilinear(Rational(0.625), Rational(0.5), {0.5, 1.5}, {}, units(0))[0].exact;
  EXPECT_TRUE(range.is_open);
  EXPECT_EQ(range.lo.to_string(), "16/85");
  EXPECT_EQ(range.hi.to_string(), "32/85");
}

TEST(TextureTruth, EnclosesTheLevelOfDetail) {
  const TextureTruth truth(gray(16, 8, std::vector<std::uint8_t>(128), Filter::trilinear));
  const ScaledDerivatives s{{Rational(0.25), Rational(0)}, {Rational(1), Rational(0)}};
  const ScaledDerivatives t{{Rational(0), Rational(-0.5)}, {Rational(0), Rational(1)}};
  EXPECT_EQ(truth.level_of_detail(s, t, {}), (records::Enclosure{2, 2}));
  const Derivatives zero{Rational(0), Rational(0)};
  EXPECT_EQ(truth.level_of_detail({zero, zero}, {zero, zero}, {}), (records::Enclosure{0, 0}));
  cases::TextureBounds bounds;
  bounds.derivative_share = 0.25F;  // of the scale, which is 4 times the slope: 0 to 8 texels
  const records::Enclosure wide = truth.level_of_detail(s, t, bounds);
  EXPECT_EQ(wide.lo, 1);
  EXPECT_EQ(wide.hi, 3);
}

}  // namespace
}  // namespace rastercheck::oracle::texture_truth_test
