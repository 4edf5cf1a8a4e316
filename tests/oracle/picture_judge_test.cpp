// Judged pictures: pictures that a faultless program makes are right in every format, and one step
// in one channel is found wherever the case permits only one value.

#include "oracle/picture_judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "cases/names.h"
#include "oracle/stored_values.h"
#include "tests/oracle/pictures.h"
#include "tests/oracle/random_case.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::picture_judge_test {
namespace {

using cases::PictureLayout;
using cases::Storage;
using records::JudgedPicture;
using records::PixelFreedom;
using records::PixelVerdict;

// Kills: rows upside down; a neighbouring channel read instead of the right one; samples left out
// of a mean; a slack too small for the rounding of the store; showing the triangle drawn first
// instead of the one drawn last.
RC_GTEST_PROP(PictureJudge, CallsFaultlessPicturesRightInEveryStorage, ()) {
  const cases::Case c = two_triangles();
  const SceneTruth scene(c, cases::contract_of(c));
  PictureLayout layout = random_layout();
  layout.channels = {{"R", "a0", {}}, {"B", "coverage", {}}, {"G", "a1", 0.5F}, {"D", "depth", {}}};
  if (c.framebuffer.samples == 1) layout.channels.push_back({"T", "triangle", {}});
  const ShownPicture shown = perfect_picture(scene, layout);
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  RC_CLASSIFY(judged.freedom.background < judged.pixels.size(), "draws something");
  RC_ASSERT(judged.wrong() == 0U);
  RC_ASSERT(judged.count(PixelVerdict::right) == judged.pixels.size());
}

// Kills: a range that holds more than the permitted values.
RC_GTEST_PROP(PictureJudge, SeesOneStepWhereOneValueIsPermitted, ()) {
  cases::Case c = two_triangles();
  c.framebuffer.samples = 1;
  const SceneTruth scene(c, cases::contract_of(c));
  PictureLayout layout = random_layout();
  layout.rounding = cases::StoreRounding::nearest;
  layout.channels = {{"R", "a0", {}}, {"G", "a1", 0.5F}};
  ShownPicture shown = perfect_picture(scene, layout);
  const records::PictureMask mask = mask_of(scene, shown.view);
  const std::size_t pixel = *rc::gen::inRange<std::size_t>(0, mask.pixels.size());
  RC_PRE(mask.pixels[pixel] != PixelFreedom::may_differ);
  const std::size_t channel = *rc::gen::inRange<std::size_t>(0, 2);
  const std::size_t at = pixel * 2 + channel;
  RC_PRE(mask.least[at] == mask.greatest[at]);  // a background may lie between two codes
  float& value = shown.file.values[at];
  RC_PRE(!std::isnan(value));
  const auto up = *rc::gen::arbitrary<bool>();
  const float before = value;
  value = next_stored(*layout.storage, value, up);
  RC_PRE(value != before);
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  RC_LOG() << cases::name_of(*layout.storage) << " " << before << " to " << value << ", permitted "
           << mask.least[at] << " to " << mask.greatest[at];
  RC_ASSERT(judged.wrong() == 1U);
  RC_ASSERT(judged.worst.at(0).steps == 1);
  RC_ASSERT(judged.pixels[pixel] != PixelVerdict::right);
}

// Kills: bounds that leave out a permitted picture.
RC_GTEST_PROP(PictureJudge, MasksHoldFaultlessPictures, ()) {
  const cases::Case c = two_triangles();
  const SceneTruth scene(c, cases::contract_of(c));
  PictureLayout layout = random_layout();
  layout.channels = {{"R", "a0", {}}, {"G", "a2", 0.25F}};
  const ShownPicture shown = perfect_picture(scene, layout);
  const records::PictureMask mask = mask_of(scene, shown.view);
  for (std::size_t i = 0; i < shown.file.values.size(); ++i) {
    const float value = shown.file.values[i];
    const bool is_any = std::isinf(mask.least[i]) && std::isinf(mask.greatest[i]);
    if (is_any) continue;
    const bool is_encoded = layout.resolve == cases::ResolveOf::stored &&
                            c.framebuffer.samples > 1 && *layout.storage == Storage::srgb8;
    const auto number =
        static_cast<float>(number_of_stored(is_encoded ? Storage::unorm8 : *layout.storage, value));
    RC_ASSERT(number >= mask.least[i]);
    RC_ASSERT(number <= mask.greatest[i]);
  }
}

// Judge and mask find how much a pixel leaves open in different ways: the judge asks the codes next
// to the stored one first. Kills: a neighbouring code forgotten, at the ends of a storage, too.
RC_GTEST_PROP(PictureJudge, CountsFreedomAsMasksDoWhateverThePictureShows, ()) {
  cases::Case c = two_triangles();
  c.framebuffer.samples = 1;
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth.constant = one_of({0.5F, 0x1p14F, 0x1p20F});
  const SceneTruth scene(c, contract);
  PictureLayout layout = random_layout();
  layout.channels = {{"R", "a0", {}}, {"G", "a1", 0.5F}};
  ShownPicture shown = perfect_picture(scene, layout);
  if (*rc::gen::arbitrary<bool>()) {
    for (float& value : shown.file.values) value = next_stored(*layout.storage, value, true);
  }
  const records::PictureFreedom judged = judge_picture(scene, shown.view, shown.file).freedom;
  const records::PictureFreedom masked = mask_of(scene, shown.view).freedom;
  RC_CLASSIFY(masked.one_value > 0, "one value");
  RC_CLASSIFY(masked.may_differ > 0, "several values");
  RC_ASSERT(judged.one_value == masked.one_value);
  RC_ASSERT(judged.may_differ == masked.may_differ);
  RC_ASSERT(judged.background == masked.background);
}

// --- Kinds of wrong pixels -----------------------------------------------------------------------

/// A far triangle of colour 1 behind the left half of a near one of colour 0; 4 × 2 pixels.
cases::Case near_and_far() {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 2,
                             {{{-1, -1, 0.25F, 1}, {3, -1, 0.25F, 1}, {-1, 3, 0.25F, 1}}},
                             {{{0.0F}, {0.0F}, {0.0F}}});
  // Pixels of columns 0 and 1.
  c.positions.insert(c.positions.end(), {{-1, -3, 0.5F, 1}, {-1, 3, 0.5F, 1}, {0.0F, 0, 0.5F, 1}});
  c.attribute_values.insert(c.attribute_values.end(), {1, 1, 1});
  c.triangles.push_back({3, 4, 5});
  c.depth_test = cases::DepthTest::less;
  c.viewport.width = 3;  // column 3 is background
  return c;
}

struct Spoiled {
  PixelVerdict verdict;
  double steps;
};

/// Judges a picture in which this pixel has been replaced by another number.
Spoiled spoiled(int x, int row, float value) {
  const cases::Case c = near_and_far();
  const SceneTruth scene(c, cases::contract_of(c));
  PictureLayout layout;
  layout.channels = {{"Y", "a0", 0.25F}};
  ShownPicture shown = perfect_picture(scene, layout);
  shown.file.values[static_cast<std::size_t>(row * 4 + x)] = value;
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  EXPECT_LE(judged.wrong(), 1U);
  return {judged.pixels[static_cast<std::size_t>(row * 4 + x)],
          judged.worst.empty() ? 0 : judged.worst.front().steps};
}

TEST(PictureJudge, TellsKindsOfWrongPixelsApart) {
  EXPECT_EQ(spoiled(0, 0, 0).verdict, PixelVerdict::right);
  EXPECT_EQ(spoiled(0, 0, 1).verdict, PixelVerdict::wrong_triangle);
  EXPECT_EQ(spoiled(2, 0, 1).verdict, PixelVerdict::wrong_value);  // the far one is not there
  EXPECT_EQ(spoiled(2, 1, 0.25F).verdict, PixelVerdict::missing);
  EXPECT_EQ(spoiled(3, 1, 0).verdict, PixelVerdict::extra);
  EXPECT_EQ(spoiled(3, 1, 0.25F).verdict, PixelVerdict::right);
  EXPECT_EQ(spoiled(1, 1, std::nanf("")).verdict, PixelVerdict::not_a_number);
  EXPECT_EQ(spoiled(1, 1, 0x1p-148F).steps, 2);
}

// A triangle without a promise may be drawn anywhere, so no pixel can be called wrong.
TEST(PictureJudge, DoesNotJudgeWhereATriangleWithoutPromiseMayBe) {
  const cases::Case c = near_and_far();
  cases::Contract contract = cases::contract_of(c);
  contract.numbers.greatest = 2;  // the first triangle reaches to 3
  const SceneTruth scene(c, contract);
  PictureLayout layout;
  layout.channels = {{"Y", "a0", 0.25F}};
  ShownPicture shown = perfect_picture(SceneTruth(c, cases::contract_of(c)), layout);
  shown.file.values[3] = 17;
  const JudgedPicture judged = judge_picture(scene, shown.view, shown.file);
  EXPECT_EQ(judged.unpromised_triangles, 2U);
  EXPECT_EQ(judged.wrong(), 0U);
  EXPECT_GT(judged.count(PixelVerdict::not_judged), 0U);
}

// The mean of four samples, two of which a triangle of colour 1 covers, is 1/2.
TEST(PictureJudge, ResolvesSamples) {
  cases::Case c = small_case(cases::Rules::vulkan, 1, 1,
                             {{{-1, -1, 0.5F, 1}, {0, -1, 0.5F, 1}, {-1, 15, 0.5F, 1}}},
                             {{{1.0F}, {1.0F}, {1.0F}}});
  c.framebuffer.samples = 4;  // the samples at x = 2/16 and 6/16
  const SceneTruth scene(c, cases::contract_of(c));
  PictureLayout layout;
  layout.storage = Storage::unorm8;
  const ShownPicture shown = perfect_picture(scene, layout);
  EXPECT_THAT(shown.file.values.front(), testing::AnyOf(127, 128));
  const records::PictureMask mask = mask_of(scene, shown.view);
  EXPECT_FLOAT_EQ(mask.least.front(), 127 / 255.0F);
  EXPECT_FLOAT_EQ(mask.greatest.front(), 128 / 255.0F);
  EXPECT_EQ(judge_picture(scene, shown.view, shown.file).wrong(), 0U);
}

// Numbers beyond 65520 are infinite in float16, and so is a mean with one of them. Kills: a range
// that becomes NaN, and a search in it that does not end.
TEST(PictureJudge, ResolvesInfiniteSamples) {
  for (const float value : {1e30F, -1e30F}) {
    cases::Case c = small_case(cases::Rules::vulkan, 1, 1,
                               {{{-1, -1, 0.5F, 1}, {0, -1, 0.5F, 1}, {-1, 15, 0.5F, 1}}},
                               {{{value}, {value}, {value}}});
    c.framebuffer.samples = 4;
    const SceneTruth scene(c, cases::contract_of(c));
    PictureLayout layout;
    layout.storage = Storage::float16;
    ShownPicture shown = perfect_picture(scene, layout);
    EXPECT_TRUE(std::isinf(shown.file.values.front()));
    EXPECT_EQ(judge_picture(scene, shown.view, shown.file).wrong(), 0U);
    shown.file.values.front() = 17;
    EXPECT_EQ(judge_picture(scene, shown.view, shown.file).wrong(), 1U);
  }
}

}  // namespace
}  // namespace rastercheck::oracle::picture_judge_test
