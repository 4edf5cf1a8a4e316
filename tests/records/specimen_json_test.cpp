#include "records/specimen_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cases/json.h"

namespace rastercheck::records::specimen_json_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// Two pixels by one, with two samples each; the third sample is not drawn.
Specimen small() {
  Specimen specimen;
  specimen.key = {"law", "cpu", Origin::corpus, 7};
  specimen.case_name = "a <name>";
  specimen.triangle = 1;
  specimen.left = 3;
  specimen.top = 5;
  specimen.width = 2;
  specimen.height = 1;
  specimen.samples = 2;
  specimen.attributes = 1;
  specimen.drawn = {true, true, false, true};
  specimen.bits = {0x3f000000, 0x40490fdb, 0, 0x80000000, 0, 0, 0x7fc00001, 0xff800000};
  return specimen;
}

Result<std::vector<Specimen>> read(const json& document) {
  return cases::read_json(json{{"specimens", json::array({document})}}.dump(), "run.json",
                          [](const cases::JsonNode& root) {
                            return cases::read_as<std::vector<Specimen>>(root["specimens"]);
                          });
}

// Kills: any change of the format; readers of old baselines would not notice it.
TEST(SpecimenToJson, WritesTheFormat) {
  EXPECT_EQ(cases::json_of(small()), json::parse(R"({
    "property": "law", "backend": "cpu", "origin": "corpus", "index": 7, "name": "a <name>",
    "triangle": 1, "left": 3, "top": 5, "width": 2, "height": 1, "samples": 2, "attributes": 1,
    "rows": ["3f000000:40490fdb 00000000:80000000 - 7fc00001:ff800000"]})"));
  Specimen nameless = small();
  nameless.case_name = "";
  EXPECT_FALSE(cases::json_of(nameless).contains("name"));
}

RC_GTEST_PROP(SpecimenFromJson, ReadsWhatWasWritten, ()) {
  Specimen specimen = small();
  specimen.width = *rc::gen::inRange<std::uint32_t>(1, 4);
  specimen.height = *rc::gen::inRange<std::uint32_t>(1, 4);
  specimen.samples = *rc::gen::element<std::uint32_t>(1, 2, 16);
  specimen.attributes = *rc::gen::inRange<std::uint32_t>(0, 3);
  specimen.drawn.clear();
  specimen.bits.clear();
  for (std::size_t i = 0; i < specimen.sample_count(); ++i) {
    const auto is_drawn = *rc::gen::arbitrary<bool>();
    specimen.drawn.push_back(is_drawn);
    for (std::size_t value = 0; value < specimen.values_per_sample(); ++value) {
      const auto bits = *rc::gen::arbitrary<std::uint32_t>();
      specimen.bits.push_back(is_drawn ? bits : 0);
    }
  }
  const Result<std::vector<Specimen>> again = read(cases::json_of(specimen));
  RC_ASSERT(again.has_value());
  RC_ASSERT(*again == std::vector{specimen});
}

void expect_refused(const std::string& key, const json& value, const std::string& place,
                    const std::string& reason) {
  SCOPED_TRACE(key + " = " + value.dump());
  json document = cases::json_of(small());
  document[key] = value;
  const Result<std::vector<Specimen>> specimens = read(document);
  ASSERT_FALSE(specimens.has_value());
  EXPECT_EQ(specimens.error().place, "/specimens/0" + place);
  EXPECT_THAT(specimens.error().reason, HasSubstr(reason));
}

// Kills: a reader that trusts sizes: "drawn" and "bits" must be as long as the size says.
TEST(SpecimenFromJson, RefusesAnyOtherForm) {
  expect_refused("more", 1, "/more", "");
  expect_refused("width", 0, "", "must have a sample");
  expect_refused("width", 33, "/width", "32");
  expect_refused("samples", 17, "/samples", "16");
  expect_refused("attributes", 33, "/attributes", "32");
  expect_refused("height", 2, "/rows", "must have 2 rows, not 1");
  expect_refused("origin", "somewhere", "/origin", "");
  const char* const of_rows = "must be 4 samples, each \"-\" or 2 groups of eight";
  for (const char* row :
       {"", "- - -", "- - - - -", "- - - - ", "-  - - -", " - - - -", "- - - 3f000000",
        "- - - 3f000000:40490fdb:40490fdb", "- - - 3f00000:040490fdb", "- - - 3F000000:40490fdb",
        "- - - 0x000000:40490fdb", "- - - 3f000000.40490fdb", "- - - --------:40490fdb"}) {
    expect_refused("rows", json::array({row}), "/rows/0", of_rows);
  }
}

}  // namespace
}  // namespace rastercheck::records::specimen_json_test
