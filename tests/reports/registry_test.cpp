#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "reports/format.h"

namespace rastercheck::reports {
namespace {

// Kills: a registrar that the linker dropped; an order that is the linker's.
TEST(Formats, AreListedByName) {
  std::vector<std::string_view> listed;
  for (const Format& format : formats()) {
    listed.push_back(format.name);
    listed.push_back(format.file_name);
  }
  EXPECT_EQ(listed, (std::vector<std::string_view>{"html", "report.html", "json", "run.json",
                                                   "markdown", "summary.md"}));
}

TEST(FindFormat, KnowsNamesOnly) {
  EXPECT_EQ(find_format("json").value().file_name, "run.json");
  const Result<Format> none = find_format("run.json");
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(to_string(none.error()),
            "run.json: no report format of that name; there are: html, json, markdown");
}

}  // namespace
}  // namespace rastercheck::reports
