// Cases written for another machine, and the drawings that come back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "backends/drawn/draw_file.h"
#include "backends/drawn/drawn_file.h"
#include "backends/drawn/folder.h"
#include "backends/drawn/fragment_picture.h"
#include "cases/files.h"
#include "cases/json.h"
#include "tests/temporary_folder.h"

namespace rastercheck::backends::drawn_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two triangles that share an edge, in 2 x 2 pixels, with one attribute.
cases::Case two_triangles() {
  cases::Case c;
  c.framebuffer = {2, 2, 1};
  c.viewport = {0, 0, 2, 2, 0, 1};
  c.rules = cases::Rules::d3d;
  c.attributes = {{"u", cases::Interpolation::noperspective, cases::Location::center}};
  c.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}};
  c.attribute_values = {1, 2, 3, 4};
  c.triangles = {{0, 1, 2}, {0, 2, 3}};
  return c;
}

/// Builds the bytes of a file of 32-bit words.
class File {
 public:
  explicit File(std::string begin) : bytes_(std::move(begin)) {}
  File& words(const std::vector<std::uint32_t>& words) {
    for (const std::uint32_t word : words) {
      bytes_.append(reinterpret_cast<const char*>(&word), sizeof word);
    }
    return *this;
  }
  File& floats(const std::vector<float>& numbers) {
    for (const float number : numbers) words({std::bit_cast<std::uint32_t>(number)});
    return *this;
  }
  File& text(const std::string& text) {
    bytes_ += text;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// A drawing of two_triangles(): the first triangle covers pixel (1, 0), the second covers nothing.
File right_drawing() {
  File file("RCDRAWN1");
  file.words({2, 0, 0, 0, 2, 1, 0}).words({0, 1}).floats({9, 0.25F, 9, 7});
  file.words({0, 0, 0, 0, 0, 0});
  return file;
}

std::string fault_of(const std::string& bytes, const cases::Case& c = two_triangles()) {
  const Result<cases::Fragments> drawn = parse_drawn(bytes, "it.drawn", c);
  return drawn ? "" : to_string(drawn.error());
}

TEST(DrawFile, HasTheMembersOfADrawInTheirOrder) {
  cases::Case c = two_triangles();
  c.scissor = cases::Scissor{-1, 0, 3, 2};
  c.viewport.min_depth = 0.5F;
  File expected("RCDRAW1\n");
  // rules, width, height, samples
  expected.words({2, 2, 2, 1}).floats({0, 0, 2, 2, 0.5F, 1});
  // scissor; cull, front_face, depth_test, depth_clamp; coverage EXACT … basis IDEAL
  expected.words({0xffffffff, 0, 3, 2, 0, 0, 0, 0, 1, 0, 0, 1, 1, 4, 1, 0, 2}).floats({1});
  expected.floats({0.5F, 0.5F});
  expected.floats({-1, -1, 0, 1, 1, -1, 0, 1, 1, 1, 0, 1, -1, 1, 0, 1});
  expected.words({1, 1}).floats({1, 2, 3, 4}).words({0, 1, 2, 0, 2, 3});
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), expected.bytes());
}

// Kills: words that programs compiled before them would take for sample positions.
TEST(DrawFile, HasWordsOfBiasAndFormatIfTheCaseHasOne) {
  cases::Case c = two_triangles();
  const std::string plain = draw_file(c, cases::contract_of(c));
  constexpr std::size_t kHead = 8 + 28 * 4;
  const auto with_words = [&](const std::vector<float>& bias, std::uint32_t bits) {
    File words("");
    words.floats(bias).words({bits});
    return "RCDRAW2\n" + plain.substr(8, kHead - 8) + words.bytes() + plain.substr(kHead);
  };
  c.depth_bias = {3, -0.5F, 0.25F};
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), with_words({3, -0.5F, 0.25F}, 0));
  c.depth_format = cases::DepthFormat::unorm24;
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), with_words({3, -0.5F, 0.25F}, 24));
  c.depth_bias = {};
  c.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), with_words({0, 0, 0}, 16));
  c.depth_format = cases::DepthFormat::float32;
  c.depth_bias.clamp = 0.25F;  // of nothing
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), plain);
}

// Kills: lines that programs draw as triangles without an area.
TEST(DrawFile, HasWordsOfLinesAndPoints) {
  cases::Case c = two_triangles();
  const std::string plain = draw_file(c, cases::contract_of(c));
  constexpr std::size_t kHead = 8 + 28 * 4;
  const auto with_words = [&](std::uint32_t primitive, std::uint32_t mode) {
    File words("");
    words.floats({0, 0, 0}).words({0, primitive, mode}).floats({2.5F, 7});
    return "RCDRAW3\n" + plain.substr(8, kHead - 8) + words.bytes() + plain.substr(kHead);
  };
  c.line_width = 2.5F;
  c.point_size = 7;
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), plain);
  c.primitive = cases::Primitive::lines;
  c.line_mode = cases::LineMode::bresenham;
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), with_words(1, 2));
  c.line_mode = cases::LineMode::parallelogram;
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), with_words(1, 1));
  c.primitive = cases::Primitive::points;
  c.line_mode = cases::LineMode::rectangular;
  EXPECT_EQ(draw_file(c, cases::contract_of(c)), with_words(2, 0));
}

TEST(DrawnFile, GivesTheFragmentsOfEachDraw) {
  const auto drawn = parse_drawn(right_drawing().bytes(), "it.drawn", two_triangles());
  ASSERT_TRUE(drawn.has_value()) << to_string(drawn.error());
  ASSERT_EQ(drawn->size(), 1);
  EXPECT_EQ(drawn->place_of(0), (cases::SamplePlace{0, 0, 1, 0}));
  EXPECT_THAT(drawn->depth, ElementsAre(0.25F));
  EXPECT_THAT(drawn->attributes, ElementsAre(7));
}

TEST(DrawnFile, OrdersTheTrianglesOfADepthTest) {
  cases::Case c = two_triangles();
  c.depth_test = cases::DepthTest::less;
  File file("RCDRAWN1");
  file.words({1, 0, 0, 0, 2, 1, 0}).words({2, 1}).floats({0.5F, 0.25F, 7, 8});
  const auto drawn = parse_drawn(file.bytes(), "it.drawn", c);
  ASSERT_TRUE(drawn.has_value()) << to_string(drawn.error());
  EXPECT_THAT(drawn->triangle, ElementsAre(0, 1));
  EXPECT_THAT(drawn->x, ElementsAre(1, 0));
  EXPECT_THAT(drawn->attributes, ElementsAre(8, 7));
}

TEST(DrawnFile, SaysWhyADrawWasNotMade) {
  for (const std::uint32_t status : {1U, 2U}) {
    File file("RCDRAWN1");
    file.words({2, status, 0, 0, 0, 0, 5}).text("lines").text(std::string(3, '\0'));
    const auto drawn = parse_drawn(file.bytes(), "it.drawn", two_triangles());
    ASSERT_FALSE(drawn.has_value());
    EXPECT_EQ(to_string(drawn.error()), "it.drawn: draw 0 was not drawn: lines");
    EXPECT_EQ(drawn.error().failure, status == 1 ? Failure::unsupported : Failure::refused);
  }
}

TEST(DrawnFile, RefusesWhatIsNoDrawingOfTheCase) {
  const std::string right = right_drawing().bytes();
  EXPECT_EQ(fault_of(right), "");
  EXPECT_EQ(fault_of("PNG"), "it.drawn: does not begin with RCDRAWN1");
  for (std::size_t size = 8; size < right.size(); ++size) {
    EXPECT_THAT(fault_of(right.substr(0, size)), HasSubstr("ends too early, in what begins at"));
  }
  EXPECT_EQ(fault_of(right + "more"), "it.drawn: has bytes after the last draw");
  EXPECT_EQ(fault_of(File("RCDRAWN1").words({3}).bytes()), "it.drawn: has 3 draws; the case has 2");
  EXPECT_EQ(fault_of(File("RCDRAWN1").words({2, 9, 0, 0, 0, 0, 0}).bytes()),
            "it.drawn: draw 0 has the unknown status 9");
  EXPECT_EQ(fault_of(File("RCDRAWN1").words({2, 0, 0, 0, 3, 1, 0}).bytes()),
            "it.drawn: draw 0 covers an invalid rectangle: x from 0 to 3, y from 0 to 1, of 2 x 2 "
            "pixels");
  EXPECT_EQ(fault_of(File("RCDRAWN1").words({2, 0, 0, 0, 1, 1, 0, 2, 0, 0}).bytes()),
            "it.drawn: draw 0 shows triangle 1 of 1");
  // A message's length that overflows 32 bits when it is rounded up to whole words.
  EXPECT_THAT(fault_of(File("RCDRAWN1").words({2, 1, 0, 0, 0, 0, 0xffffffff}).bytes()),
              HasSubstr("ends too early"));
}

/// A picture of 2 x 2 samples with these channels.
cases::PictureFile picture(std::vector<std::string> channels, std::vector<float> values) {
  cases::PictureFile file;
  file.width = 2;
  file.height = 2;
  file.stored.assign(channels.size(), cases::Storage::float32);
  file.channels = std::move(channels);
  file.values = std::move(values);
  return file;
}

cases::Case with_depth_test() {
  cases::Case c = two_triangles();
  c.depth_test = cases::DepthTest::less;
  return c;
}

std::string picture_fault(const cases::PictureFile& picture,
                          const cases::Case& c = with_depth_test()) {
  const auto drawn = fragments_of_picture(picture, "it.npy", c);
  return drawn ? "" : to_string(drawn.error());
}

TEST(FragmentPicture, NamesOrOrdersItsChannels) {
  const auto by_order =
      fragments_of_picture(picture({"R", "G", "B"}, {0, 9, 9, 2, 0.5F, 6, 0, 9, 9, 1, 0.25F, 5}),
                           "it.npy", with_depth_test());
  const auto by_name = fragments_of_picture(
      picture({"depth", "triangle", "value0"}, {9, 0, 9, 0.5F, 2, 6, 9, 0, 9, 0.25F, 1, 5}),
      "it.exr", with_depth_test());
  for (const auto* drawn : {&by_order, &by_name}) {
    ASSERT_TRUE(drawn->has_value()) << to_string(drawn->error());
    EXPECT_THAT((*drawn)->triangle, ElementsAre(0, 1));
    EXPECT_THAT((*drawn)->x, ElementsAre(1, 1));
    EXPECT_THAT((*drawn)->y, ElementsAre(1, 0));
    EXPECT_THAT((*drawn)->depth, ElementsAre(0.25F, 0.5F));
    EXPECT_THAT((*drawn)->attributes, ElementsAre(5, 6));
  }
}

TEST(FragmentPicture, RefusesWhatIsNoDrawingOfTheCase) {
  const std::vector<float> nothing(12);
  EXPECT_EQ(picture_fault(picture({"R", "G", "B"}, nothing)), "");
  EXPECT_EQ(picture_fault(picture({"R", "G", "B"}, nothing), two_triangles()),
            "it.npy: a picture cannot hold several triangles without a depth test");
  EXPECT_EQ(picture_fault(picture({"R", "G"}, std::vector<float>(8))),
            "it.npy: must have 3 channels: triangle, depth and 1 values");
  for (const float wrong : {-1.0F, 0.5F, 3.0F, std::numeric_limits<float>::quiet_NaN()}) {
    std::vector<float> values = nothing;
    values[3] = wrong;
    EXPECT_THAT(
        picture_fault(picture({"R", "G", "B"}, values)),
        AllOf(HasSubstr("row 0, column 1: "), HasSubstr("is not the index of a triangle plus 1")));
  }
  cases::PictureFile halves = picture({"R", "G", "B"}, nothing);
  halves.stored[1] = cases::Storage::float16;
  EXPECT_EQ(picture_fault(halves), "it.npy: must store float32 numbers");
  cases::PictureFile large = picture({"R", "G", "B"}, nothing);
  large.width = 3;
  EXPECT_EQ(picture_fault(large), "it.npy: is 3 x 2; the case has 2 columns of samples and 2 rows");
}

TEST(DrawnName, IsThatOfAllThatIsDrawn) {
  const cases::Case c = two_triangles();
  cases::Case same = c;
  same.name = "another";
  same.choices = 3;
  same.found = cases::Found();
  EXPECT_EQ(drawn_name(same), drawn_name(c));
  cases::Case other = c;
  other.attribute_values[3] = std::nextafter(4.0F, 5.0F);
  EXPECT_NE(drawn_name(other), drawn_name(c));
}

TEST(CaseFolder, FindsTheDrawingsOfItsCases) {
  const TemporaryFolder temporary;
  const std::string path = temporary.path("cases");
  const cases::Case c = two_triangles();
  Result<CaseFolder> folder = CaseFolder::make(path);
  ASSERT_TRUE(folder.has_value());
  ASSERT_TRUE(folder->add(c, cases::contract_of(c)).has_value());
  ASSERT_TRUE(folder->add(c, cases::contract_of(c)).has_value());
  ASSERT_TRUE(folder->finish({"1.2.3", {}}).has_value());
  EXPECT_EQ(folder->size(), 1);
  EXPECT_EQ(read_drawn_campaign(path)->program, "1.2.3");
  EXPECT_EQ(CaseFolder::make(path).error().reason, "is not an empty folder");

  EXPECT_EQ(count_drawn(path)->drawn, 0);
  const auto missing = read_drawing(path, c);
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().failure, Failure::unsupported);
  EXPECT_THAT(missing.error().reason, HasSubstr("has no drawing of the case: " + drawn_name(c)));

  const std::string drawing = path + "/drawn/" + drawn_name(c);
  ASSERT_TRUE(cases::write_file(drawing + ".drawn", right_drawing().bytes()).has_value());
  EXPECT_EQ(count_drawn(path)->drawn, 1);
  EXPECT_EQ(read_drawing(path, c)->size(), 1);
  ASSERT_TRUE(cases::write_file(drawing + ".json", "{}").has_value());
  EXPECT_THAT(to_string(read_drawing(path, c).error()), HasSubstr("is a drawing of the same case"));
}

}  // namespace
}  // namespace rastercheck::backends::drawn_test
