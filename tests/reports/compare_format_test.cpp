#include "reports/compare_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/approved_file.h"
#include "tests/reports/sample_gate.h"
#include "tests/temporary_folder.h"

namespace rastercheck::reports::compare_format_test {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string kApproved = RASTERCHECK_SOURCE_DIR "/tests/reports/approved/";

std::string written(const char* name) { return find_compare_format(name)->write(sample_gate()); }

TEST(CompareFormats, AreThese) {
  std::vector<std::string> names;
  for (const CompareFormat& format : compare_formats()) names.emplace_back(format.file_name);
  EXPECT_THAT(names, Contains("compare.json"));
  EXPECT_THAT(names, Contains("compare.md"));
  EXPECT_THAT(find_compare_format("xml").error().reason, HasSubstr("json, markdown"));
}

TEST(CompareFormats, HaveTheirApprovedShapes) {
  EXPECT_TRUE(is_approved(written("json"), kApproved + "compare.json"));
  EXPECT_TRUE(is_approved(written("markdown"), kApproved + "compare.md"));
}

TEST(CompareFormats, AreWrittenIntoOneFolder) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_comparison(sample_gate(), folder.path("new/out")));
  EXPECT_EQ(folder.content("new/out/compare.md"), written("markdown"));
  EXPECT_TRUE(nlohmann::json::parse(folder.content("new/out/compare.json"))["regression"]);
  folder.put("file", "");
  EXPECT_FALSE(write_comparison(sample_gate(), folder.path("file")));
}

// Kills: a name that leads out of the folder.
TEST(FileOf, IsAName) {
  records::Comparison comparison;
  comparison.key.backend = "plugin:../x.so";
  records::CaseGrowth growth;
  growth.law = "1/w is";
  growth.index = 7;
  EXPECT_EQ(file_of(comparison, growth), "grown/1-w-is-plugin----x-so-random-7.json");
}

}  // namespace
}  // namespace rastercheck::reports::compare_format_test
