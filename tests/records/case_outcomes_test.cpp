#include "records/case_outcomes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cases/json.h"
#include "records/case_outcomes_json.h"

namespace rastercheck::records::case_outcomes_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

CaseOutcomeSet two_backends() {
  CaseOutcomes first;
  first.right = IndexSet({{0, 6}, {8, 9}});
  CaseOutcomes second;
  second.right = IndexSet({{0, 4}});
  second.wrong = IndexSet({{5, 5}});
  second.known = IndexSet({{7, 9}});
  second.unlike["cpu"] = IndexSet({{3, 5}});
  return {{{"a law", "cpu", Origin::random}, first},
          {{"a law", "gl:llvmpipe", Origin::random}, second}};
}

Result<CaseOutcomeSet> read_back(const json& array) {
  return cases::read_json(array.dump(), "outcomes", &cases::read_as<CaseOutcomeSet>);
}

/// Returns the reader's error for the second entry after a change.
std::string error_after(const char* key, const char* value) {
  json array = cases::json_of(two_backends());
  array[1][key] = json::parse(value);
  const auto read = read_back(array);
  return read ? "was read" : to_string(read.error());
}

TEST(CaseOutcomesJson, IsReadBack) {
  const json array = cases::json_of(two_backends());
  EXPECT_EQ(array[0]["right"], json::parse("[[0, 6], [8, 9]]"));
  EXPECT_FALSE(array[0].contains("wrong"));
  EXPECT_FALSE(array[0].contains("unlike"));
  EXPECT_EQ(array[1]["unlike"], json::parse(R"({"cpu": [[3, 5]]})"));
  EXPECT_EQ(read_back(array).value(), two_backends());
}

// Kills: counts of cases with two outcomes, or of ranges that overlap.
TEST(CaseOutcomesJson, RefusesWhatNoRunHolds) {
  EXPECT_THAT(error_after("wrong", "[[4, 4]]"), HasSubstr("each case must have one outcome"));
  EXPECT_THAT(error_after("known", "[[5, 5]]"), HasSubstr("each case must have one outcome"));
  for (const char* ranges :
       {"[[3, 2]]", "[[5, 6], [1, 2]]", "[[1, 3], [3, 4]]", "[[1, 3], [4, 4]]"}) {
    EXPECT_THAT(error_after("wrong", ranges), HasSubstr("ranges must ascend")) << ranges;
  }
  EXPECT_THAT(error_after("unlike", R"({"cpu": [[6, 6]]})"), HasSubstr("judged cases only"));
  json array = cases::json_of(two_backends());
  array.push_back(array[0]);
  EXPECT_THAT(to_string(read_back(array).error()), HasSubstr("a second entry with the same"));
}

// Kills: outcomes that depend on how the cases were split.
TEST(CaseOutcomes, MergeToTheWhole) {
  std::vector<CaseOutcomeSet> parts;
  for (const auto& [key, all] : two_backends()) {
    for (std::uint64_t index = 0; index < 10; ++index) {
      CaseOutcomes one;
      const IndexSet only({{index, index}});
      one.right = common(all.right, only);
      one.wrong = common(all.wrong, only);
      one.known = common(all.known, only);
      for (const auto& [backend, unlike] : all.unlike) {
        if (unlike.contains(index)) one.unlike[backend] = only;
      }
      parts.push_back({{key, one}});
    }
  }
  for (const std::size_t start : {0U, 7U, 13U}) {
    std::rotate(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(start), parts.end());
    CaseOutcomeSet merged;
    for (const CaseOutcomeSet& part : parts) merge(merged, part);
    EXPECT_EQ(merged, two_backends());
  }
}

TEST(DifferenceFile, NamesBothBackends) {
  Difference difference;
  difference.right = "gl:llvmpipe";
  difference.source.found = cases::Found{"a-law", "gl:softpipe", "", 1, 2};
  EXPECT_EQ(file_of(difference), "differences/a-law-gl-softpipe-wrong-gl-llvmpipe-right.json");
}

}  // namespace
}  // namespace rastercheck::records::case_outcomes_test
