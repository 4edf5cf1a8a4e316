#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "reports/format.h"

namespace rastercheck::reports::registry_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;

// Kills: a registration that the linker dropped; listing the formats in the linker's order.
TEST(Formats, AreListedByName) {
  const std::vector<std::string> names = format_names();
  EXPECT_THAT(names, IsSupersetOf({"html", "json", "junit", "markdown", "sarif"}));
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  ASSERT_EQ(formats().size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(formats()[i].name, names[i]);
}

// The contents of a run's folder, as CONTRACT states. Kills: a file in every run that few users
// want.
TEST(Formats, AreWrittenByEveryRunOrOnRequest) {
  EXPECT_THAT(default_format_names(), ElementsAre("html", "json", "junit", "markdown"));
}

// Kills: two formats of which one overwrites the other's file.
TEST(Formats, HaveAFileEach) {
  std::set<std::string_view> files;
  for (const Format& format : formats()) {
    EXPECT_TRUE(files.insert(format.file_name).second) << format.file_name;
  }
}

TEST(FindFormat, KnowsNamesOnly) {
  EXPECT_EQ(find_format("html").value().file_name, "report.html");
  EXPECT_EQ(find_format("json").value().file_name, "run.json");
  EXPECT_EQ(find_format("markdown").value().file_name, "summary.md");
  const Result<Format> none = find_format("run.json");
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().file, "run.json");
  EXPECT_THAT(
      none.error().reason,
      AllOf(StartsWith(
                "unknown report format; the formats are: bencher, benchmark, cases, html, json"),
            EndsWith(format_names().back())));
}

}  // namespace
}  // namespace rastercheck::reports::registry_test
