// Pictures whose colours are multiplied by alpha, and blended over the background: calculated by
// hand, and as a plain program makes them (cases/drawn_picture.h).

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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

// Kills: ends taken of one corner; the order of ends where a factor is negative.
TEST(PictureAlpha, ProductsOfRangesHaveTheirEndsAtCorners) {
  const ValueSpan product = product_of({-2, 3, false}, {-5, 0.5, false});
  EXPECT_NEAR(product.lo, -15, 0x1p-40);
  EXPECT_NEAR(product.hi, 10, 0x1p-40);
  EXPECT_TRUE(product_of({}, exactly(1)).is_free);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(product_of(exactly(0), {1, infinite, false}).is_free);
}

// --- As a plain program makes them ---------------------------------------------------------------

PictureLayout random_style() {
  PictureLayout layout = random_layout();
  layout.alpha = one_of({Alpha::straight, Alpha::premultiplied, Alpha::premultiplied});
  layout.channels = {{"R", "a0", 0.5F}, {"A", "a2", 0.3F}, {"G", "0.7", {}}, {"D", "depth", {}}};
  return layout;
}

/// Makes attributes lie in [0, 1], as colours mostly do.
void make_colors(cases::Case& c) {
  for (float& value : c.attribute_values) value = std::abs(std::fmod(value, 1.0F));
}

// Kills: a product that is not widened by its rounding; a background that is not multiplied; the
// alpha of another triangle.
RC_GTEST_PROP(PictureAlpha, CallsFaultlessPicturesRight, ()) {
  cases::Case c = two_triangles();
  if (*rc::gen::arbitrary<bool>()) make_colors(c);
  const SceneTruth scene(c, cases::contract_of(c));
  const PictureLayout layout = random_style();
  const ShownPicture shown = perfect_picture(scene, layout);
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  RC_CLASSIFY(judged.freedom.background < judged.pixels.size(), "draws something");
  RC_ASSERT(judged.wrong() == 0U);
  RC_ASSERT(judged.count(PixelVerdict::right) == judged.pixels.size());
}

// Kills: ranges of products that leave out what a placement gives.
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

// Kills: a range that holds more than the permitted values; masks that leave one out.
RC_GTEST_PROP(PictureAlpha, SeesOneStepWhereOneValueIsPermitted, ()) {
  cases::Case c = two_triangles();
  c.framebuffer.samples = 1;
  make_colors(c);
  const SceneTruth scene(c, cases::contract_of(c));
  PictureLayout layout = random_style();
  layout.rounding = cases::StoreRounding::nearest;
  ShownPicture shown = perfect_picture(scene, layout);
  const PictureMask mask = mask_of(scene, shown.view);
  const std::size_t channels = layout.channels.size();
  const std::size_t pixel = *rc::gen::inRange<std::size_t>(0, mask.pixels.size());
  const std::size_t at = pixel * channels + *rc::gen::inRange<std::size_t>(0, channels);
  RC_PRE(mask.least[at] == mask.greatest[at]);
  float& value = shown.file.values[at];
  RC_PRE(!std::isnan(value));
  const auto up = *rc::gen::arbitrary<bool>();
  const float before = value;
  value = next_stored(*layout.storage, value, up);
  RC_PRE(value != before);
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  RC_CLASSIFY(judged.pixels[pixel] != PixelVerdict::extra, "of a triangle");
  RC_LOG() << cases::name_of(*layout.storage) << " " << before << " to " << value << ", permitted "
           << mask.least[at] << " to " << mask.greatest[at];
  RC_ASSERT(judged.wrong() == 1U);
  RC_ASSERT(judged.pixels[pixel] != PixelVerdict::right);
}

}  // namespace
}  // namespace rastercheck::oracle::picture_alpha_test
