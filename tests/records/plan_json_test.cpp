#include "records/plan_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/records/sample_plan.h"

namespace rastercheck::records::plan_json_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Result<Plan> read(const json& document) {
  return cases::read_json(document.dump(), "file", &cases::read_as<Plan>);
}

TEST(PlanJson, ComesBackAsItWas) {
  EXPECT_EQ(read(cases::json_of(sample_plan())).value(), sample_plan());
  EXPECT_EQ(read(cases::json_of(Plan())).value(), Plan());
  Plan large;
  large.seed = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(read(cases::json_of(large)).value(), large);
  Plan none;
  none.backends = {};
  EXPECT_EQ(read(cases::json_of(none)).value(), none);
}

// Kills: writing keys that have their default value.
TEST(PlanJson, LeavesOutWhatIsAsUsual) {
  EXPECT_EQ(cases::json_of(Plan()),
            json::parse(R"({"seed": 0, "cases_per_property": 1000, "backends": ["cpu"]})"));
  EXPECT_EQ(cases::json_of(sample_plan()).size(), 19U);
}

TEST(PlanJson, IsRefusedWithItsPlace) {
  const auto error = [](const char* pointer, const char* value) {
    json document = cases::json_of(sample_plan());
    document[json::json_pointer(pointer)] = json::parse(value);
    const Result<Plan> plan = read(document);
    return plan ? "was read" : to_string(plan.error());
  };
  EXPECT_THAT(error("/seed", "-1"), HasSubstr("file: /seed: must be an integer from 0"));
  EXPECT_THAT(error("/more", "1"), HasSubstr("unknown key 'more'"));
  EXPECT_THAT(error("/backends/1", "1"), HasSubstr("file: /backends/1: must be a string"));
  EXPECT_THAT(error("/scene_size", "0"), HasSubstr("file: /scene_size: must be from 1 to 16384"));
  EXPECT_THAT(error("/scene_size", "1e10"), HasSubstr("file: /scene_size: "));
  EXPECT_THAT(error("/contract", "{}"), HasSubstr("file: /contract: missing key 'file'"));
  EXPECT_THAT(error("/contract/file", "\"\""), HasSubstr("file: /contract/file: "));
  EXPECT_THAT(error("/contract/terms/version", "9"), HasSubstr("/contract/terms/version: "));
  EXPECT_THAT(error("/shard/index", "0"), HasSubstr("file: /shard/index: must be from 1 to 7"));
  EXPECT_THAT(error("/shard/index", "8"), HasSubstr("file: /shard/index: must be from 1 to 7"));
  EXPECT_THAT(error("/shard/count", "0"), HasSubstr("file: /shard/index: "));
  EXPECT_THAT(error("/shard/count", "4097"), HasSubstr("file: /shard/count: must be at most 4096"));
  EXPECT_THAT(error("/keeps_cases", "1"), HasSubstr("file: /keeps_cases: must be"));
  json document = cases::json_of(sample_plan());
  document.erase("seed");
  EXPECT_THAT(to_string(read(document).error()), HasSubstr("missing key 'seed'"));
}

}  // namespace
}  // namespace rastercheck::records::plan_json_test
