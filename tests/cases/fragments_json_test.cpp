// Fragments as JSON.

#include "cases/fragments_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace rastercheck::cases::fragments_json_test {
namespace {

using testing::ElementsAre;

Case one_triangle() {
  Case c;
  c.framebuffer = {4, 4, 2};
  c.attributes = {{"u"}};
  c.positions.resize(3);
  c.attribute_values.resize(3);
  c.triangles = {{0, 1, 2}};
  return c;
}

std::string text_of(const std::string& fragments) {
  return R"({"format": "rastercheck-fragments", "version": 1, "fragments": [)" + fragments + "]}";
}

std::string fault_of(const std::string& text) {
  const Result<Fragments> drawn = parse_fragments(text, "it.json", one_triangle());
  return drawn ? "" : to_string(drawn.error());
}

TEST(FragmentsJson, ComesBackBitForBit) {
  Fragments drawn;
  drawn.attribute_count = 1;
  drawn.triangle = {0, 0, 0, 0};
  drawn.x = {0, 1, 2, 2};
  drawn.y = {1, 1, 1, 1};
  drawn.sample = {0, 1, 0, 1};
  drawn.depth = {0.1F, -0.0F, std::numeric_limits<float>::infinity(), 0x1p-149F};
  drawn.attributes = {std::numeric_limits<float>::quiet_NaN(), 1, 2,
                      -std::numeric_limits<float>::infinity()};
  std::string text;
  write_fragments(drawn, "mine", [&text](std::string_view piece) {
    text += piece;
    return true;
  });
  const Result<Fragments> back = parse_fragments(text, "it.json", one_triangle());
  ASSERT_TRUE(back.has_value()) << to_string(back.error());
  EXPECT_EQ(back->x, drawn.x);
  EXPECT_EQ(back->y, drawn.y);
  EXPECT_EQ(back->sample, drawn.sample);
  EXPECT_EQ(back->depth, drawn.depth);
  EXPECT_TRUE(std::signbit(back->depth[1]));
  EXPECT_TRUE(std::isnan(back->attributes[0]));
  EXPECT_EQ(back->attributes[3], drawn.attributes[3]);
}

TEST(FragmentsJson, TakesNumbersAndAnyOrder) {
  const Result<Fragments> drawn =
      parse_fragments(text_of(R"({"triangle": 0, "x": 3, "y": 0, "depth": 0.5, "attributes": [2]},
                 {"triangle": 0, "x": 1, "y": 0, "depth": 0, "attributes": ["0x1p+0"]})"),
                      "it.json", one_triangle());
  ASSERT_TRUE(drawn.has_value()) << to_string(drawn.error());
  EXPECT_THAT(drawn->x, ElementsAre(1, 3));
  EXPECT_THAT(drawn->attributes, ElementsAre(1, 2));
}

TEST(FragmentsJson, RefusesWhatIsNoFragmentOfTheCase) {
  const std::string right = R"({"triangle": 0, "x": 3, "y": 0, "depth": 0, "attributes": [2]})";
  EXPECT_EQ(fault_of(text_of(right)), "");
  EXPECT_EQ(fault_of(text_of(right + "," + right)),
            "it.json: /fragments: pixel 3, 0, sample 0 has two fragments of triangle 0");
  EXPECT_EQ(fault_of(text_of(R"({"triangle": 1, "x": 0, "y": 0, "depth": 0, "attributes": [2]})")),
            "it.json: /fragments/0: triangle 1 of 1");
  EXPECT_EQ(fault_of(text_of(R"({"triangle": 0, "x": 4, "y": 0, "depth": 0, "attributes": [2]})")),
            "it.json: /fragments/0: pixel 4, 0, sample 0 of 4 x 4 pixels, 2 samples");
  EXPECT_EQ(fault_of(text_of(R"({"triangle": 0, "x": 0, "y": 0, "depth": 0})")),
            "it.json: /fragments/0: 0 attributes of 1");
  EXPECT_NE(fault_of(text_of(R"({"triangle": 0, "x": 0, "y": 0, "depth": "deep"})")), "");
  EXPECT_NE(fault_of(R"({"format": "rastercheck-fragments", "version": 2, "fragments": []})"), "");
  EXPECT_NE(fault_of("["), "");
}

}  // namespace
}  // namespace rastercheck::cases::fragments_json_test
