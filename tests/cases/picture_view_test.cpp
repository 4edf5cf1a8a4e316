#include "cases/picture_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cases/drawn_picture.h"

namespace rastercheck::cases::picture_view_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Case case_of(Rules rules) {
  Case c;
  c.rules = rules;
  c.framebuffer = {2, 2, 1};
  c.attributes = {{"u", {}, {}}, {"depth", {}, {}}, {"v", {}, {}}};
  return c;
}

PictureFile file_of(std::vector<std::string> channels) {
  PictureFile picture;
  picture.width = 2;
  picture.height = 2;
  picture.channels = std::move(channels);
  picture.stored.assign(picture.channels.size(), Storage::unorm8);
  return picture;
}

std::string fault_of(const PictureLayout& layout, const PictureFile& file) {
  const Result<PictureView> view = view_of(case_of(Rules::vulkan), layout, file, "a.png");
  return view ? "none" : to_string(view.error());
}

TEST(PictureView, ShowsAttributesInOrderUnlessToldOtherwise) {
  const auto view = view_of(case_of(Rules::vulkan), {}, file_of({"B", "G", "R"}), "a.exr");
  ASSERT_TRUE(view.has_value()) << to_string(view.error());
  EXPECT_EQ(view->channels[2].attribute, 0U);  // R
  EXPECT_EQ(view->channels[1].attribute, 1U);
  EXPECT_EQ(view->channels[0].attribute, 2U);
}

TEST(PictureView, FindsWhatAWordShows) {
  PictureLayout layout;
  layout.channels = {
      {"R", "depth", {}}, {"G", "attribute:depth", {}}, {"B", "0.5", 0.25F}, {"A", "coverage", {}}};
  const auto view = view_of(case_of(Rules::vulkan), layout, file_of({"R", "G", "B", "A"}), "a");
  ASSERT_TRUE(view.has_value()) << to_string(view.error());
  EXPECT_EQ(view->channels[0].shows, Shown::depth);
  EXPECT_EQ(view->channels[0].background, 1);
  EXPECT_EQ(view->channels[1].shows, Shown::attribute);
  EXPECT_EQ(view->channels[1].attribute, 1U);
  EXPECT_EQ(view->channels[2].constant, 0.5F);
  EXPECT_EQ(view->channels[2].background, 0.25F);
  EXPECT_EQ(view->channels[3].constant, 1);
}

TEST(PictureView, RefusesWhatDoesNotFit) {
  EXPECT_THAT(fault_of({}, file_of({"R", "G", "B", "A"})),
              HasSubstr("nothing says what channel A shows"));
  PictureLayout layout;
  layout.channels = {{"R", "w", {}}};
  EXPECT_THAT(fault_of(layout, file_of({"R"})),
              HasSubstr("channel R shows \"w\", which the case has no attribute for"));
  EXPECT_THAT(fault_of(layout, file_of({"G"})), HasSubstr("has no channel R; its channels are G"));
  layout.channels = {{"R", "u", {}}};
  layout.storage = Storage::float16;
  EXPECT_THAT(fault_of(layout, file_of({"R"})), HasSubstr("holds unorm8 numbers, not float16"));
  PictureFile large = file_of({"R"});
  large.width = 3;
  EXPECT_THAT(fault_of(layout, large), HasSubstr("has 3 x 2 pixels, the case 2 x 2"));
}

// A regression: a picture without channels, which has no numbers, crashed the writer.
TEST(PictureView, RefusesPicturesThatShowNothing) {
  Case c = case_of(Rules::vulkan);
  c.attributes.clear();
  const PictureFile planned = planned_picture(c, {});
  const Result<PictureView> view = view_of(c, {}, planned, "a.npy");
  ASSERT_FALSE(view.has_value());
  EXPECT_THAT(to_string(view.error()), HasSubstr("a.npy: would show nothing"));
}

TEST(PictureView, KnowsColoursAndTheirAlpha) {
  PictureLayout layout;
  layout.alpha = Alpha::premultiplied;
  layout.blend = Blend::over;
  layout.channels = {
      {"R", "u", {}}, {"G", "0.5", {}}, {"Z", "depth", {}}, {"M", "coverage", {}}, {"A", "v", {}}};
  const auto view =
      view_of(case_of(Rules::vulkan), layout, file_of({"R", "G", "Z", "M", "A"}), "a");
  ASSERT_TRUE(view.has_value()) << to_string(view.error());
  EXPECT_EQ(view->alpha_channel, 4U);
  std::vector<bool> colors;
  std::vector<bool> blended;
  for (std::size_t c = 0; c < 5; ++c) {
    colors.push_back(view->is_color(c));
    blended.push_back(view->is_blended(c));
  }
  EXPECT_THAT(colors, ElementsAre(true, true, false, false, false));
  EXPECT_THAT(blended, ElementsAre(true, true, false, false, true));
}

TEST(PictureView, RefusesAlphaThatNoChannelShows) {
  PictureLayout layout;
  layout.channels = {{"R", "u", {}}};
  layout.blend = Blend::additive;
  EXPECT_EQ(fault_of(layout, file_of({"R"})), "none");
  layout.blend = Blend::over;
  EXPECT_EQ(fault_of(layout, file_of({"R"})),
            "a.png: has no channel A, which blend over needs; its channels are R");
  layout.alpha = Alpha::premultiplied;
  EXPECT_THAT(fault_of(layout, file_of({"R"})), HasSubstr("which alpha premultiplied needs"));
  for (const char* shown : {"depth", "triangle", "-"}) {
    layout.channels = {{"R", "u", {}}, {"A", shown, {}}};
    EXPECT_THAT(fault_of(layout, file_of({"R", "A"})), HasSubstr("channel A shows no alpha"));
  }
  layout.channels = {{"R", "u", {}}, {"A", "coverage", {}}};
  EXPECT_EQ(fault_of(layout, file_of({"R", "A"})), "none");
}

/// The stored values of a picture of one channel, 2 × 2, where pixel (0, 0) of window coordinates
/// shows 0.5.
std::vector<float> rows_of(Rules rules, FirstRow first_row, Storage storage) {
  Case c = case_of(rules);
  PictureLayout layout;
  layout.channels = {{"Y", "u", {}}};
  layout.first_row = first_row;
  layout.storage = storage;
  const PictureFile plan = planned_picture(c, layout);
  const auto view = view_of(c, layout, plan, "a");
  EXPECT_TRUE(view.has_value());
  Fragments drawn;
  drawn.attribute_count = 3;
  drawn.triangle = {0};
  drawn.x = {0};
  drawn.y = {0};
  drawn.sample = {0};
  drawn.depth = {0};
  drawn.attributes = {0.5F, 0, 0};
  return picture_of(*view, plan, drawn).values;
}

// OpenGL's window y points up; 0.5 is 128 of unorm8 and 188 of srgb8 (IEC 61966-2-1).
TEST(DrawnPicture, BeginsWithTheRowThatWasAskedFor) {
  EXPECT_THAT(rows_of(Rules::vulkan, FirstRow::top, Storage::unorm8), ElementsAre(128, 0, 0, 0));
  EXPECT_THAT(rows_of(Rules::vulkan, FirstRow::bottom, Storage::srgb8), ElementsAre(0, 0, 188, 0));
  EXPECT_THAT(rows_of(Rules::opengl, FirstRow::top, Storage::float32), ElementsAre(0, 0, 0.5F, 0));
  EXPECT_THAT(rows_of(Rules::opengl, FirstRow::bottom, Storage::unorm16),
              ElementsAre(32768, 0, 0, 0));
}

/// The stored values of a pixel that a triangle with the attributes u and v covers, and of one
/// where nothing is drawn: R = u and A = v.
std::vector<float> stored_of(const PictureLayout& style, float u, float v, float red, float alpha) {
  Case c = case_of(Rules::vulkan);
  c.framebuffer = {2, 1, 1};
  PictureLayout layout = style;
  layout.channels = {{"R", "u", red}, {"A", "v", alpha}};
  const PictureFile plan = planned_picture(c, layout);
  const auto view = view_of(c, layout, plan, "a");
  EXPECT_TRUE(view.has_value());
  Fragments drawn;
  drawn.attribute_count = 3;
  drawn.triangle = {0};
  drawn.x = {0};
  drawn.y = {0};
  drawn.sample = {0};
  drawn.depth = {0};
  drawn.attributes = {u, 0, v};
  return picture_of(*view, plan, drawn).values;
}

PictureLayout style_of(Storage storage, Alpha alpha) {
  PictureLayout style;
  style.storage = storage;
  style.alpha = alpha;
  return style;
}

// The background is a colour too. 0.5 · 0.25 · 255 = 31.875; 0.75 · 0.5 · 255 = 95.625.
TEST(DrawnPicture, MultipliesColoursByAlphaOnce) {
  EXPECT_THAT(stored_of(style_of(Storage::unorm8, Alpha::straight), 0.5F, 0.25F, 0.75F, 0.5F),
              ElementsAre(128, 64, 191, 128));
  EXPECT_THAT(stored_of(style_of(Storage::unorm8, Alpha::premultiplied), 0.5F, 0.25F, 0.75F, 0.5F),
              ElementsAre(32, 64, 96, 128));
  EXPECT_THAT(stored_of(style_of(Storage::float32, Alpha::premultiplied), 3, -0.5F, 2, 0.25F),
              ElementsAre(-1.5F, -0.5F, 0.5F, 0.25F));
}

// 0.75 is stored as 191; straight: 0.25 · 0.5 + 0.75 · 191/255 = 0.68676 is 175.1, and alpha
// 0.25 + 0.75 · 0.4 = 0.55 is 140.25. Premultiplied: 0.75 · 0.4 is stored as 77 (76.5), and
// 31.875 + 0.75 · 77 = 89.6. sRGB: half of 0.5 over black encodes to 136.96, its alpha is 127.5.
TEST(DrawnPicture, BlendsOverItsBackground) {
  PictureLayout style = style_of(Storage::unorm8, Alpha::straight);
  style.blend = Blend::over;
  EXPECT_THAT(stored_of(style, 0.5F, 0.25F, 0.75F, 0.4F), ElementsAre(175, 140, 191, 102));
  style.blend = Blend::additive;
  EXPECT_THAT(stored_of(style, 0.5F, 0.25F, 0.75F, 0.4F), ElementsAre(255, 166, 191, 102));
  style = style_of(Storage::unorm8, Alpha::premultiplied);
  style.blend = Blend::over;
  EXPECT_THAT(stored_of(style, 0.5F, 0.25F, 0.75F, 0.4F), ElementsAre(90, 140, 77, 102));
  style = style_of(Storage::srgb8, Alpha::straight);
  style.blend = Blend::over;
  EXPECT_THAT(stored_of(style, 0.5F, 0.5F, 0, 0), ElementsAre(137, 128, 0, 0));
}

}  // namespace
}  // namespace rastercheck::cases::picture_view_test
