#include "reports/internal/inspection_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/reports/sample_inspections.h"

namespace rastercheck::reports::inspection_data_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t kEnough = 1'000'000;

json data_of(const records::Inspection& inspection, std::size_t most = kEnough) {
  return json::parse(inspection_data({inspection}, most)[0]);
}

// Kills: a member that the viewer reads under another name.
TEST(InspectionData, HasWhatTheViewerReads) {
  json data = data_of(sample_counterexample_inspection());
  const json samples = data["samples"];
  data.erase("samples");
  EXPECT_EQ(data, json::parse(R"({
    "rules": "vulkan", "attributes": [["u & v", "smooth"]], "pattern": [[0.5, 0.5]],
    "triangle": 0, "x": 3, "y": 4, "sample": 0, "value": 0,
    "q": [["-1/7", "-1/7", "9/7"], ["6/35", "-1/35", "-1/7"], ["-1/35", "6/35", "-1/7"]],
    "outlines": [[[1.0, 1.0], [7.0, 2.0], [2.0, 7.0]]], "left": 0, "top": 0, "width": 8,
    "height": 8, "shortened": false})"));
  ASSERT_EQ(samples.size(), 64U);
  // The missing sample, at (5/2, 11/2). By the q-matrix above, e is 1/7, 9/70 and 51/70.
  EXPECT_EQ(samples[5 * 8 + 2], json::parse(R"([2, 5, 0, "required", "inside", 0, "0.707107",
                            ["0.142857", "0.128571", "0.728571", "1"],
                            [[-1, "181/280", 0.6464285714285715, null, null, null, null, "1",
                              "[2.5, 2.75]"],
                             [0, "111/70", 1.5857142857142856, null, null, null, null, "1",
                              "[2.5, 2.75]"]]])"));
  EXPECT_EQ(samples[0][3], "forbidden");
  EXPECT_EQ(samples[0][8], json::array());
  EXPECT_EQ(samples[2 * 8 + 4][8][1][3], "inf");
}

TEST(InspectionData, OfCoverageNoValueIsChosen) {
  records::Inspection inspection = sample_counterexample_inspection();
  inspection.attribute.reset();
  EXPECT_EQ(data_of(inspection)["value"], -1);
  inspection.splits.clear();
  inspection.q_matrix.reset();
  EXPECT_EQ(data_of(inspection)["value"], json());
  EXPECT_EQ(data_of(inspection)["q"], json());
}

// This holds whether or not the inspected sample is among the samples.
TEST(InspectionData, IsCountedFromThePart) {
  records::Inspection inspection = sample_counterexample_inspection();
  inspection.left = 100;
  inspection.top = 200;
  for (records::InspectedSample& sample : inspection.samples) {
    sample.place.x += 100;
    sample.place.y += 200;
  }
  const json data = data_of(inspection);
  ASSERT_EQ(data["samples"].size(), 64U);
  EXPECT_EQ(data["samples"][5 * 8 + 2][0], 2);
  EXPECT_EQ(data["samples"][5 * 8 + 2][1], 5);
  EXPECT_EQ(data["left"], 100);
}

// Kills: ending the script element within its text; line breaks that are invalid in JavaScript.
TEST(InspectionData, MayStandInAScriptElement) {
  records::Inspection inspection = sample_counterexample_inspection();
  const std::string name = "</script><!-- \xe2\x80\xa8 \xff";
  inspection.source.attributes[0].name = name;
  const std::string data = inspection_data({inspection}, kEnough)[0];
  EXPECT_THAT(data, Not(HasSubstr("<")));
  EXPECT_THAT(data, Not(HasSubstr("\xe2")));
  EXPECT_EQ(json::parse(data)["attributes"][0][0], "</script><!-- \xe2\x80\xa8 \xef\xbf\xbd");
}

/// An inspection with numbers of 200 digits everywhere.
records::Inspection long_inspection() {
  records::Inspection inspection = sample_counterexample_inspection();
  for (records::InspectedSample& sample : inspection.samples) {
    for (records::InspectedValue& value : sample.values) {
      value.exact = std::string(200, '1') + "/" + std::string(200, '3');
    }
  }
  return inspection;
}

TEST(InspectionData, LeavesOutDigitsWhereAllAreTooMany) {
  const std::string whole = inspection_data({long_inspection()}, kEnough)[0];
  const std::string less = inspection_data({long_inspection()}, whole.size() * 2 / 3)[0];
  EXPECT_EQ(json::parse(whole)["shortened"], false);
  EXPECT_LE(less.size(), whole.size() * 2 / 3);
  const json data = json::parse(less);
  EXPECT_EQ(data["shortened"], true);
  const std::string shortened = data["samples"][8 + 1][8][1][1];
  EXPECT_EQ(shortened, std::string(30, '1') + "…" + std::string(29, '1') + "/" +
                           std::string(30, '3') + "…" + std::string(29, '3'));
  // The inspected sample keeps all digits.
  const std::string kept = data["samples"][4 * 8 + 3][8][1][1];
  EXPECT_EQ(kept.size(), 401U);
}

// Keeps the pixels up to 8 pixels away from (20, 3), out of 32 by 8 pixels.
TEST(InspectionData, LeavesOutWhatIsFarNext) {
  records::Inspection inspection = sample_counterexample_inspection();
  inspection.width = 32;
  inspection.place.x = 20;
  inspection.place.y = 3;
  const records::InspectedSample sample = inspection.samples[4 * 8 + 3];
  inspection.samples.clear();
  for (std::uint32_t y = 0; y < 8; ++y) {
    for (std::uint32_t x = 0; x < 32; ++x) {
      inspection.samples.push_back(sample);
      inspection.samples.back().place.x = x;
      inspection.samples.back().place.y = y;
    }
  }
  const std::string whole = inspection_data({inspection}, kEnough)[0];
  const json data = data_of(inspection, whole.size() * 3 / 4);
  EXPECT_EQ(data["left"], 12);
  EXPECT_EQ(data["width"], 17);
  EXPECT_EQ(data["top"], 0);
  EXPECT_EQ(data["height"], 8);
  ASSERT_EQ(data["samples"].size(), 17U * 8);
  EXPECT_EQ(data["samples"][0][0], 0);
  EXPECT_EQ(data["samples"][16][0], 16);
}

TEST(InspectionData, LeavesOutInspectionsAtLast) {
  const std::vector<std::string> data =
      inspection_data({long_inspection(), long_inspection(), long_inspection()}, 1);
  ASSERT_EQ(data.size(), 3U);
  EXPECT_FALSE(data[0].empty());
  EXPECT_TRUE(data[1].empty());
  EXPECT_TRUE(data[2].empty());
}

}  // namespace
}  // namespace rastercheck::reports::inspection_data_test
