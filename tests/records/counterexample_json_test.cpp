#include "records/counterexample_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cases/case_writer.h"
#include "cases/json.h"

namespace rastercheck::records::counterexample_json_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

Counterexample small_counterexample() {
  Counterexample counterexample;
  counterexample.source.framebuffer = {8, 4, 1};
  counterexample.source.viewport = {0, 0, 8, 4, 0, 1};
  counterexample.source.positions = {{-0.0F, 0, 0, 1}};
  counterexample.source.triangles = {{0, 0, 0}};
  counterexample.source.found = {"law", "cpu", "violated", 1, 2};
  counterexample.violation_count = 12;
  Violation bare;
  bare.exact = "required, inside";
  bare.actual = "not drawn";
  Violation full = bare;
  full.fragment_class = FragmentClass::wrong_sign_of_zero;
  full.kind = AttributeKind::flat;
  full.place.triangle = 1;
  full.place.x = 2;
  full.place.y = 3;
  full.place.sample = 4;
  full.attribute = 5;
  full.error = {0.1, std::numeric_limits<double>::infinity()};
  full.bound = {0.5, 0.5};
  full.distance = {0, 0.25};
  full.note = "n";
  counterexample.violations = {bare, full};
  counterexample.origin = Origin::corpus;
  counterexample.shrinking = {214, true};
  counterexample.explanation = {{DrawnPart::coverage, DrawnPart::values},
                                {DrawnPart::depth},
                                {"a-law"},
                                {"tie"},
                                {"scissor"},
                                {"samples", "w <= 0"},
                                {{"x and y are exchanged"}},
                                false};
  counterexample.close_up = {"y 5 [!]", "x    3"};
  return counterexample;
}

// Kills: any change of the format; readers of old files would not notice it.
TEST(CounterexampleToJson, WritesTheFormat) {
  const json written = cases::json_of(small_counterexample());
  EXPECT_EQ(written["case"], json::parse(cases::to_json(small_counterexample().source)));
  EXPECT_EQ(written["violation_count"], 12);
  EXPECT_EQ(written["violations"], json::parse(R"([
    {"class": "correct", "kind": "coverage", "triangle": 0, "x": 0, "y": 0, "sample": 0,
     "exact": "required, inside", "actual": "not drawn", "note": ""},
    {"class": "wrong sign of zero", "kind": "flat", "triangle": 1, "x": 2, "y": 3, "sample": 4,
     "attribute": 5, "exact": "required, inside", "actual": "not drawn", "error": [0.1, "inf"],
     "bound": [0.5, 0.5], "distance": [0.0, 0.25], "note": "n"}])"));
  EXPECT_EQ(written["origin"], "corpus");
  EXPECT_EQ(written["shrinking"], json::parse(R"({"tries": 214, "is_least": true})"));
  EXPECT_EQ(written["close_up"], json::parse(R"(["y 5 [!]", "x    3"])"));
  EXPECT_EQ(written["explanation"],
            json::parse(R"({"parts": ["coverage", "values"], "wrong": ["depth"],
              "also_violates": ["a-law"], "needs": ["tie"], "inherent": ["scissor"],
              "indifferent": ["samples", "w <= 0"], "hints": ["x and y are exchanged"],
              "fails_again": false})"));
  EXPECT_EQ(written.size(), 7U);
}

TEST(CounterexampleToJson, OmitsAbsentMembers) {
  EXPECT_EQ(cases::json_of(Counterexample()).size(), 4U);
}

Result<Counterexample> read(const json& document) {
  return cases::read_json(
      json{{"counterexamples", json::array({document})}}.dump(), "run.json",
      [](const cases::JsonNode& root) {
        return cases::read_as<Counterexample>(root["counterexamples"].elements()[0]);
      });
}

TEST(CounterexampleFromJson, ReadsWhatWasWritten) {
  const json written = cases::json_of(small_counterexample());
  const Result<Counterexample> again = read(written);
  ASSERT_TRUE(again.has_value()) << to_string(again.error());
  EXPECT_EQ(*again, small_counterexample());
  EXPECT_EQ(cases::json_of(*again), written);
}

// Kills: refusing older files, which have none of these members.
TEST(CounterexampleFromJson, OriginShrinkingAndCloseUpMayBeMissing) {
  json document = cases::json_of(small_counterexample());
  for (const char* key : {"origin", "shrinking", "explanation", "close_up"}) document.erase(key);
  Counterexample expected = small_counterexample();
  expected.origin = Origin::random;
  expected.shrinking.reset();
  expected.explanation.reset();
  expected.close_up.clear();
  EXPECT_EQ(read(document).value(), expected);
}

TEST(CounterexampleFromJson, PlacesAreThoseOfTheWholeFile) {
  json document = cases::json_of(small_counterexample());
  document["case"]["rules"] = "metal";
  EXPECT_EQ(to_string(read(document).error()),
            "run.json: /counterexamples/0/case/rules: must be opengl, vulkan or d3d");
  document = cases::json_of(small_counterexample());
  document["violations"][1]["attribute"] = 4294967296;
  EXPECT_EQ(to_string(read(document).error()),
            "run.json: /counterexamples/0/violations/1/attribute: must be an integer from 0 to "
            "4294967295");
  EXPECT_THAT(to_string(read(json::array()).error()), HasSubstr("must be an object"));
}

}  // namespace
}  // namespace rastercheck::records::counterexample_json_test
