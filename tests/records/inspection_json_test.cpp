#include "records/inspection_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "cases/case_writer.h"
#include "cases/json.h"
#include "tests/records/random_inspection.h"

namespace rastercheck::records::inspection_json_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

Inspection small_inspection() {
  Inspection inspection;
  inspection.occasion = Occasion::worst;
  inspection.law = "law";
  inspection.backend = "cpu";
  inspection.counterexample = 7;
  inspection.kind = AttributeKind::smooth;
  inspection.stratum = Stratum::sliver;
  inspection.source.framebuffer = {8, 4, 1};
  inspection.source.viewport = {0, 0, 8, 4, 0, 1};
  inspection.source.positions = {{-0.0F, 0, 0, 1}};
  inspection.source.triangles = {{0, 0, 0}};
  inspection.pattern = {{0.5, 0.25}};
  inspection.place.triangle = 1;
  inspection.place.x = 3;
  inspection.place.y = 2;
  inspection.attribute = 4;
  inspection.q_matrix = {{{"1", "0", "-1/2"}, {"0", "1", "0"}, {"2", "3", "4"}}};
  inspection.outlines = {{{0.5, 1}, {8, -1}}, {}};
  inspection.left = 2;
  inspection.top = 1;
  inspection.width = 2;
  inspection.height = 3;
  InspectedSample sample;
  sample.place.x = 3;
  sample.place.y = 2;
  sample.verdict = Verdict::permitted;
  sample.reason = Reason::nonpositive_w;
  sample.is_drawn = true;
  sample.distance = {0, 0.25};
  sample.edges = {{{1, 1}, {-2, -1.5}, {0, 0}}};
  InspectedValue depth;
  depth.actual = -0.0F;
  InspectedValue value;
  value.attribute = 4;
  value.exact = "1/3";
  value.nearest = 0.25;
  value.actual = 0x1.0cccccp+4F;
  value.scale_error = {0.7, 0.7};
  value.local_error = {-1, std::numeric_limits<double>::infinity()};
  value.excess = {0, 0};
  value.kappa = {1, 1};
  value.kappa_d = {3, 4};
  sample.values = {depth, value};
  InspectedSample outside;
  outside.place.x = 2;
  outside.place.y = 1;
  inspection.samples = {sample, outside};
  inspection.splits = {{std::nullopt, {}, {0, 0}, true},
                       {4, {{Stage::set_up, {0.5, 0.5}}, {Stage::left_open, {-1, 0}}}, {0, 1}}};
  inspection.coverage_stage = Stage::snap;
  return inspection;
}

// Kills: any change of the format; readers of old files would not notice it.
TEST(InspectionToJson, WritesTheFormat) {
  json written = cases::json_of(small_inspection());
  EXPECT_EQ(written["case"], json::parse(cases::to_json(small_inspection().source)));
  written.erase("case");
  EXPECT_EQ(written, json::parse(R"({
    "occasion": "worst", "property": "law", "backend": "cpu", "counterexample": 7, "kind": "smooth",
    "stratum": "sliver", "pattern": [[0.5, 0.25]], "triangle": 1, "x": 3, "y": 2, "sample": 0,
    "attribute": 4, "q_matrix": [["1", "0", "-1/2"], ["0", "1", "0"], ["2", "3", "4"]],
    "outlines": [[[0.5, 1.0], [8.0, -1.0]], []], "left": 2, "top": 1, "width": 2, "height": 3,
    "samples": [
      {"x": 3, "y": 2, "sample": 0, "verdict": "permitted", "reason": "w <= 0", "is_drawn": true,
       "distance": [0.0, 0.25], "edges": [[1.0, 1.0], [-2.0, -1.5], [0.0, 0.0]],
       "values": [{"actual": "-0x0p+0"},
                  {"attribute": 4, "exact": "1/3", "nearest": 0.25, "actual": "0x1.0cccccp+4",
                   "scale_error": [0.7, 0.7], "local_error": [-1.0, "inf"], "excess": [0.0, 0.0],
                   "kappa": [1.0, 1.0], "kappa_d": [3.0, 4.0]}]},
      {"x": 2, "y": 1, "sample": 0, "verdict": "forbidden", "reason": "outside",
       "is_drawn": false}],
    "splits": [{"parts": [], "total": [0.0, 0.0], "is_traced": true},
               {"attribute": 4, "parts": [{"stage": "set-up", "error": [0.5, 0.5]},
                                          {"stage": "left open", "error": [-1.0, 0.0]}],
                "total": [0.0, 1.0], "is_traced": false}],
    "coverage_stage": "snap"})"));
}

TEST(InspectionToJson, OmitsAbsentMembers) {
  const json written = cases::json_of(Inspection());
  for (const char* key : {"kind", "stratum", "attribute", "q_matrix", "coverage_stage"}) {
    EXPECT_FALSE(written.contains(key)) << key;
  }
  EXPECT_EQ(written.size(), 17U);
}

Result<Inspection> read(const json& document) {
  return cases::read_json(json{{"inspections", json::array({document})}}.dump(), "run.json",
                          [](const cases::JsonNode& root) {
                            return cases::read_as<Inspection>(root["inspections"].elements()[0]);
                          });
}

TEST(InspectionFromJson, ReadsWhatWasWritten) {
  const json written = cases::json_of(small_inspection());
  const Result<Inspection> again = read(written);
  ASSERT_TRUE(again.has_value()) << to_string(again.error());
  EXPECT_EQ(*again, small_inspection());
  EXPECT_EQ(cases::json_of(*again), written);
}

// Kills: leaving out a member; numbers that lose bits.
RC_GTEST_PROP(InspectionFromJson, GivesBackAnyInspection, ()) {
  const Inspection inspection = random_inspection();
  const json written = cases::json_of(inspection);
  const Result<Inspection> again = read(written);
  RC_ASSERT(again.has_value());
  RC_ASSERT(*again == inspection);
  RC_ASSERT(cases::json_of(*again) == written);
}

TEST(InspectionFromJson, KeepsWhatIsNoNumber) {
  Inspection inspection = small_inspection();
  InspectedValue& value = inspection.samples[0].values[1];
  for (const char* text : {"nan", "inf", "-inf"}) {
    value.actual = std::stof(text);
    const json written = cases::json_of(inspection);
    EXPECT_EQ(written["samples"][0]["values"][1]["actual"], text);
    const float again = read(written).value().samples[0].values[1].actual.value();
    EXPECT_EQ(std::isnan(again), std::isnan(*value.actual));
    EXPECT_TRUE(std::isnan(again) || again == *value.actual) << text;
  }
  value.actual = -std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(cases::json_of(inspection)["samples"][0]["values"][1]["actual"], "nan");
}

/// A fault that must be refused: the value at a place in a good document is replaced.
struct Fault {
  std::string pointer;
  std::string value;       ///< JSON text; empty: the value is removed
  std::string reason;      ///< part of the expected reason
  std::string place = {};  ///< within the inspection; empty: same as the pointer
};

/// Used in the test's name, which would otherwise contain addresses that differ in every run.
void PrintTo(const Fault& fault, std::ostream* out) {
  *out << (fault.value.empty() ? "without " + fault.pointer : fault.pointer + " = " + fault.value);
}

class BadInspection : public ::testing::TestWithParam<Fault> {};

TEST_P(BadInspection, IsRefusedWithItsPlace) {
  const Fault& fault = GetParam();
  json document = cases::json_of(small_inspection());
  const json::json_pointer pointer(fault.pointer);
  if (fault.value.empty()) {
    document[pointer.parent_pointer()].erase(pointer.back());
  } else {
    document[pointer] = json::parse(fault.value);
  }
  const Result<Inspection> inspection = read(document);
  ASSERT_FALSE(inspection.has_value());
  const std::string& place = fault.place.empty() ? fault.pointer : fault.place;
  EXPECT_EQ(inspection.error().place, "/inspections/0" + place);
  EXPECT_THAT(inspection.error().reason, HasSubstr(fault.reason));
}

const Fault kFaults[] = {
    {"/more", "1", "unknown key 'more'"},
    {"/occasion", R"("boredom")", "must be counterexample, worst or asked for"},
    {"/kind", R"("rough")", "must be "},
    {"/case/version", "2", "version must be 1"},
    {"/pattern/0", "[1]", "x and y"},
    {"/triangle", "-1", "must be an integer"},
    {"/q_matrix/2", R"(["1", "2"])", "must have 3 elements, not 2"},
    {"/q_matrix", "[]", "must have 3 elements, not 0"},
    {"/outlines/0/1/0", R"("far")", "must be a number"},
    {"/width", "33", "must be an integer from 0 to 32"},
    {"/samples/0/more", "1", "unknown key 'more'"},
    {"/samples/0/verdict", R"("maybe")", "must be required, forbidden or permitted"},
    {"/samples/0/x", "4", "not within the inspected part", "/samples/0"},
    {"/samples/0/y", "0", "not within the inspected part", "/samples/0"},
    {"/samples/0/sample", "1", "not in the sample pattern"},
    {"/samples/0/is_drawn", "1", "must be "},
    {"/samples/0/distance", "[1, 0]", "lower end"},
    {"/samples/0/edges", "[[0, 0]]", "must have 3 elements, not 1"},
    {"/samples/0/values/0/more", "1", "unknown key 'more'"},
    {"/samples/0/values/1/actual", "0.5", "must be a string"},
    {"/samples/0/values/1/actual", R"("0.5")", "must be the hex float"},
    {"/samples/0/values/1/nearest", "null", "must be a number"},
    {"/splits/1/parts/0/stage", R"("green room")", "must be transform"},
    {"/splits/1/parts/0/more", "1", "unknown key 'more'"},
    {"/splits/1/total", "", "missing key 'total'", "/splits/1"},
    {"/coverage_stage", "2", "must be "},
};

INSTANTIATE_TEST_SUITE_P(InspectionFromJson, BadInspection, ::testing::ValuesIn(kFaults));

}  // namespace
}  // namespace rastercheck::records::inspection_json_test
