// Pictures whose colours are multiplied by alpha, and blended over the background: calculated by
// hand, and as a plain program makes them (cases/drawn_picture.h).

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <half.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "cases/names.h"
#include "oracle/internal/painting.h"
#include "oracle/picture_judge.h"
#include "oracle/stored_values.h"
#include "tests/oracle/open_case.h"
#include "tests/oracle/pictures.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::picture_alpha_test {
namespace {

using cases::Alpha;
using cases::Blend;
using cases::PictureLayout;
using cases::Storage;
using records::JudgedPicture;
using records::PictureMask;
using records::PixelVerdict;
using testing::ElementsAre;

// --- By hand -------------------------------------------------------------------------------------

/// A triangle on the left of two pixels.
cases::Case left_of_two() {
  return small_case(cases::Rules::vulkan, 2, 1,
                    {{{-1, -1, 0.5F, 1}, {0, -1, 0.5F, 1}, {-1, 9, 0.5F, 1}}});
}

/// A picture of channel R, whose colour is `color` with `alpha` where it is drawn.
PictureLayout layout_of(Storage storage, Alpha alpha, const char* color, const char* opacity) {
  PictureLayout layout;
  layout.storage = storage;
  layout.alpha = alpha;
  layout.channels = {{"R", color, 0.75F}, {"A", opacity, 0.5F}};
  return layout;
}

PictureMask mask_by(const cases::Case& c, const PictureLayout& layout) {
  const SceneTruth scene(c, cases::contract_of(c));
  return mask_of(scene, perfect_picture(scene, layout).view);
}

TEST(PictureAlpha, MultipliesColoursAndTheBackground) {
  const PictureMask mask =
      mask_by(left_of_two(), layout_of(Storage::float32, Alpha::premultiplied, "3", "-0.5"));
  EXPECT_EQ(mask.least, (std::vector<float>{-1.5F, -0.5F, 0.375F, 0.5F}));
  EXPECT_EQ(mask.greatest, mask.least);
  EXPECT_EQ(mask.freedom.one_value, 1U);
}

// 0.1F · 0.7F needs 48 bits. The float32 nearest to it is the only one that one rounding gives.
TEST(PictureAlpha, RoundsProductsOnce) {
  const PictureMask mask =
      mask_by(left_of_two(), layout_of(Storage::float32, Alpha::premultiplied, "0.1", "0.7"));
  EXPECT_EQ(mask.least[0], 0.1F * 0.7F);
  EXPECT_EQ(mask.greatest[0], 0.1F * 0.7F);
}

// Kills: taking both ends from one corner; not swapping the ends if a factor is negative.
TEST(PictureAlpha, ProductsOfRangesHaveTheirEndsAtCorners) {
  const ValueSpan product = product_of({-2, 3, false}, {-5, 0.5, false});
  EXPECT_NEAR(product.lo, -15, 0x1p-40);
  EXPECT_NEAR(product.hi, 10, 0x1p-40);
  EXPECT_TRUE(product_of({}, exactly(1)).is_free);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(product_of(exactly(0), {1, infinite, false}).is_free);
}

/// The codes of 8 bits that a channel may hold in pixel x of left_of_two(): found by trying all.
std::vector<int> permitted_codes(const PictureLayout& layout, std::size_t x, std::size_t channel) {
  const cases::Case c = left_of_two();
  const SceneTruth scene(c, cases::contract_of(c));
  ShownPicture shown = perfect_picture(scene, layout);
  std::vector<int> codes;
  for (int code = 0; code < 256; ++code) {
    shown.file.values[x * layout.channels.size() + channel] = static_cast<float>(code);
    const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
    if (judged.pixels[x] == PixelVerdict::right) codes.push_back(code);
  }
  return codes;
}

/// A picture of channels R and A that is blended over its background.
PictureLayout blended_layout(Storage storage, Alpha alpha, const char* color, const char* opacity,
                             float red, float background_alpha) {
  PictureLayout layout;
  layout.storage = storage;
  layout.alpha = alpha;
  layout.blend = Blend::over;
  layout.channels = {{"R", color, red}, {"A", opacity, background_alpha}};
  return layout;
}

// 0.8 and 0.4 are the codes 204 and 102. Straight, the colour is 255 (0.125 + 0.75 · 0.8) = 184.875
// and alpha 255 (0.25 + 0.75 · 0.4) = 140.25. Premultiplied, 0.8 · 0.4 is stored as 82 (81.6), and
// the colour is 255 · 0.125 + 0.75 · 82 = 93.375.
TEST(PictureAlpha, BlendsOverTheStoredBackground) {
  const auto straight = blended_layout(Storage::unorm8, Alpha::straight, "0.5", "0.25", 0.8F, 0.4F);
  EXPECT_THAT(permitted_codes(straight, 0, 0), ElementsAre(185));
  EXPECT_THAT(permitted_codes(straight, 0, 1), ElementsAre(140));
  EXPECT_THAT(permitted_codes(straight, 1, 0), ElementsAre(204));
  const auto multiplied =
      blended_layout(Storage::unorm8, Alpha::premultiplied, "0.5", "0.25", 0.8F, 0.4F);
  EXPECT_THAT(permitted_codes(multiplied, 0, 0), ElementsAre(93));
  EXPECT_THAT(permitted_codes(multiplied, 0, 1), ElementsAre(140));
  EXPECT_THAT(permitted_codes(multiplied, 1, 0), ElementsAre(82));
}

// A quarter encodes to 136.96, and half to 187.52 (IEC 61966-2-1). Alpha is not encoded; 127.5 may
// become 127 or 128. Kills: blending codes, which gives 94 and 127.
TEST(PictureAlpha, BlendsLinearNumbersAndEncodesOnce) {
  const auto over_black = blended_layout(Storage::srgb8, Alpha::straight, "0.5", "0.5", 0, 0);
  EXPECT_THAT(permitted_codes(over_black, 0, 0), ElementsAre(137));
  EXPECT_THAT(permitted_codes(over_black, 0, 1), ElementsAre(127, 128));
  const auto over_white = blended_layout(Storage::srgb8, Alpha::straight, "0", "0.5", 1, 0);
  EXPECT_THAT(permitted_codes(over_white, 0, 0), ElementsAre(188));
  // Half of the background's code 188, which stands for 0.50289, encodes to 137.32.
  const auto over_grey = blended_layout(Storage::srgb8, Alpha::straight, "0", "0.5", 0.5F, 0);
  EXPECT_THAT(permitted_codes(over_grey, 0, 0), ElementsAre(137));
}

// Integers clamp before blending: a straight 3 to 1, times 0.5; a premultiplied 3 · 0.5 to 1.
TEST(PictureAlpha, ClampsWhatIsBlendedIntoIntegers) {
  EXPECT_THAT(
      permitted_codes(blended_layout(Storage::unorm8, Alpha::straight, "3", "0.5", 0, 0), 0, 0),
      ElementsAre(127, 128));
  EXPECT_THAT(permitted_codes(
                  blended_layout(Storage::unorm8, Alpha::premultiplied, "3", "0.5", 0, 0), 0, 0),
              ElementsAre(255));
  auto sum = blended_layout(Storage::unorm8, Alpha::straight, "-1", "7", 0.4F, 0.4F);
  sum.blend = Blend::additive;
  EXPECT_THAT(permitted_codes(sum, 0, 0), ElementsAre(102));
  EXPECT_THAT(permitted_codes(sum, 0, 1), ElementsAre(255));
}

// 0.25 · 3 + 0.75 · 0.75 = 1.3125, within the error of float32: 2^-21 (0.25 · 3 + 1.25 · 0.75).
TEST(PictureAlpha, FloatsMayDifferByTheRoundingsOfABlend) {
  const PictureMask mask = mask_by(
      left_of_two(), blended_layout(Storage::float32, Alpha::straight, "3", "0.25", 0.75F, 0.5F));
  EXPECT_NEAR(mask.least[0], 1.3125 - 0x1p-21 * 1.6875, 0x1p-23);
  EXPECT_NEAR(mask.greatest[0], 1.3125 + 0x1p-21 * 1.6875, 0x1p-23);
  EXPECT_EQ(mask.least[2], 0.75F);
}

// Kills: ignoring layers that a depth test removes but a blend may have seen; counting a triangle
// beside another as one over it.
TEST(PictureAlpha, DoesNotJudgeBlendsOfSeveralTriangles) {
  for (const bool is_tested : {false, true}) {
    cases::Case c = left_of_two();
    c.positions.insert(c.positions.end(),
                       {{-1, -1, 0.25F, 1}, {0, -1, 0.25F, 1}, {-1, 9, 0.25F, 1}});
    c.triangles.push_back({3, 4, 5});
    c.depth_test = is_tested ? cases::DepthTest::less : cases::DepthTest::none;
    const SceneTruth scene(c, cases::contract_of(c));
    const auto layout = blended_layout(Storage::unorm8, Alpha::straight, "0.5", "0.25", 0.8F, 0.4F);
    ShownPicture shown = perfect_picture(scene, layout);
    shown.file.values[0] = 17;
    const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
    EXPECT_EQ(judged.pixels, (std::vector{PixelVerdict::not_judged, PixelVerdict::right}));
    EXPECT_EQ(judged.freedom.layered, 1U);
    const PictureMask mask = mask_of(scene, shown.view);
    EXPECT_EQ(mask.freedom.layered, 1U);
    EXPECT_TRUE(std::isinf(mask.least[0]));
    EXPECT_EQ(mask.least[2], 0.8F);
    shown.view.blend = Blend::off;
    EXPECT_EQ(judge_picture(scene, shown.view, shown.file).wrong(), 1U);
  }
}

// The 8 corners, calculated by hand: a s + (1 − a) d for a in [0.25, 0.5], s in [1, 2], d in [-1,
// 1].
TEST(PictureAlpha, BlendsOfRangesHaveTheirEndsAtCorners) {
  const ValueSpan range = mixed({{1, 2, false}, {0.25, 0.5, false}, {-1, 1, false}, true, true});
  EXPECT_NEAR(range.lo, -0.5, 0x1p-19);
  EXPECT_NEAR(range.hi, 1.5, 0x1p-19);
  EXPECT_LT(range.lo, -0.5);
  EXPECT_TRUE(mixed({exactly(3e38), exactly(1), exactly(1), true, true}).is_free);
}

// Computes a blend in float32 by both forms that the bound is derived for, fused or not.
RC_GTEST_PROP(PictureAlpha, BlendsInFloatsStayWithinTheBound, ()) {
  const float s = ordinary_float(2);
  const float a = *rc::gen::arbitrary<bool>() ? std::abs(ordinary_float(1)) : ordinary_float(4);
  const auto code = static_cast<float>(*rc::gen::inRange(0, 256));
  const float d = *rc::gen::arbitrary<bool>() ? ordinary_float(2) : code * (1.0F / 255);
  const double exact_d = d == code * (1.0F / 255) ? code / 255.0 : double{d};
  const ValueSpan range = mixed({exactly(s), exactly(a), exactly(exact_d), true, true});
  const float rest = 1 - a;
  const float product = a * s;
  const float difference = s - d;
  for (const float blend :
       {product + rest * d, std::fma(a, s, rest * d), std::fma(rest, d, product),
        d + a * difference, std::fma(a, difference, d)}) {
    RC_ASSERT(blend >= range.lo);
    RC_ASSERT(blend <= range.hi);
  }
}

// --- As a plain program makes them ---------------------------------------------------------------

PictureLayout random_style() {
  PictureLayout layout = random_layout();
  layout.alpha = one_of({Alpha::straight, Alpha::premultiplied, Alpha::premultiplied});
  layout.blend = one_of({Blend::off, Blend::over, Blend::over, Blend::additive});
  layout.channels = {{"R", "a0", 0.5F}, {"A", "a2", 0.3F}, {"G", "0.7", {}}, {"D", "depth", {}}};
  return layout;
}

/// Makes attributes lie in [0, 1], as colours mostly do.
void make_colors(cases::Case& c) {
  for (float& value : c.attribute_values) value = std::abs(std::fmod(value, 1.0F));
}

// Kills: a product that is not widened by its rounding; a background that is not multiplied, or is
// blended before it is stored; the alpha of another triangle; samples that are not blended.
RC_GTEST_PROP(PictureAlpha, CallsFaultlessPicturesRight, ()) {
  cases::Case c = two_triangles();
  if (*rc::gen::arbitrary<bool>()) make_colors(c);
  const SceneTruth scene(c, cases::contract_of(c));
  const PictureLayout layout = random_style();
  const ShownPicture shown = perfect_picture(scene, layout);
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  RC_CLASSIFY(judged.freedom.background < judged.pixels.size(), "draws something");
  RC_CLASSIFY(judged.freedom.layered > 0, "draws layers");
  RC_ASSERT(judged.wrong() == 0U);
  RC_ASSERT(judged.count(PixelVerdict::right) + judged.freedom.layered == judged.pixels.size());
  RC_ASSERT(layout.blend != Blend::off || judged.freedom.layered == 0U);
}

// Kills: ranges of products and blends that leave out what a placement gives.
RC_GTEST_PROP(PictureAlpha, CallsFaultlessPicturesRightUnderOpenContracts, ()) {
  cases::Case c = open_case();
  if (*rc::gen::arbitrary<bool>()) make_colors(c);
  const SceneTruth scene(c, open_contract(c));
  const PictureLayout layout = random_style();
  const ShownPicture shown = perfect_picture(scene, layout);
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  RC_CLASSIFY(judged.freedom.background < judged.pixels.size(), "draws something");
  RC_ASSERT(judged.wrong() == 0U);
}

/// Another stored value: any other integer, or a float with one bit flipped.
float damaged(Storage storage, float value) {
  switch (storage) {
    case Storage::float32:
      return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^
                                  (1U << *rc::gen::inRange(0, 32)));
    case Storage::float16: {
      Imath::half half(value);
      half.setBits(static_cast<std::uint16_t>(half.bits() ^ (1U << *rc::gen::inRange(0, 16))));
      return half;
    }
    case Storage::unorm16:
      return static_cast<float>(static_cast<int>(value) ^ *rc::gen::inRange(1, 65536));
    case Storage::unorm8:
    case Storage::srgb8:
      break;
  }
  return static_cast<float>(static_cast<int>(value) ^ *rc::gen::inRange(1, 256));
}

// Kills: a range that holds more than the permitted values; masks that leave one out.
RC_GTEST_PROP(PictureAlpha, SeesAnyDamageWhereOneValueIsPermitted, ()) {
  cases::Case c = two_triangles();
  c.framebuffer.samples = 1;
  make_colors(c);
  const SceneTruth scene(c, cases::contract_of(c));
  PictureLayout layout = random_style();
  layout.rounding = cases::StoreRounding::nearest;
  ShownPicture shown = perfect_picture(scene, layout);
  const PictureMask mask = mask_of(scene, shown.view);
  const std::size_t channels = layout.channels.size();
  std::vector<std::size_t> single;  // values that must be as they are
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < mask.least.size(); ++i) {
    if (mask.least[i] != mask.greatest[i]) continue;
    single.push_back(i);
    if (mask.pixels[i / channels] == records::PixelFreedom::one_value) drawn.push_back(i);
  }
  if (!drawn.empty()) single = drawn;
  RC_PRE(!single.empty());
  const std::size_t at = *rc::gen::elementOf(single);
  float& value = shown.file.values[at];
  RC_PRE(!std::isnan(value));
  const Storage storage = shown.view.channels[at % channels].storage;
  const auto is_step = *rc::gen::arbitrary<bool>();
  const auto up = *rc::gen::arbitrary<bool>();
  const float before = value;
  value = is_step ? next_stored(storage, value, up) : damaged(storage, value);
  RC_PRE(value != before);  // the last integer, or a zero of the other sign
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  RC_CLASSIFY(!drawn.empty(), "of a triangle");
  RC_LOG() << cases::name_of(storage) << " " << before << " to " << value << ", permitted "
           << mask.least[at] << " to " << mask.greatest[at];
  RC_ASSERT(judged.wrong() == 1U);
  RC_ASSERT(judged.pixels[at / channels] != PixelVerdict::right);
}

}  // namespace
}  // namespace rastercheck::oracle::picture_alpha_test
