// The standard sample positions are data. This test copies RULES §4 once more, by hand.

#include "cases/sample_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace rastercheck::cases::sample_pattern_test {
namespace {

constexpr int kCounts[] = {1, 2, 4, 8, 16};

std::vector<std::pair<int, int>> pattern(int samples) {
  std::vector<std::pair<int, int>> positions;
  for (const SamplePosition& p : standard_pattern(samples)) positions.emplace_back(p.x, p.y);
  return positions;
}

using Positions = std::vector<std::pair<int, int>>;

TEST(SamplePattern, IsTheTableOfTheRulesInIndexOrder) {
  EXPECT_EQ(pattern(1), (Positions{{8, 8}}));
  EXPECT_EQ(pattern(2), (Positions{{12, 12}, {4, 4}}));
  EXPECT_EQ(pattern(4), (Positions{{6, 2}, {14, 6}, {2, 10}, {10, 14}}));
  EXPECT_EQ(pattern(8),
            (Positions{{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}));
  EXPECT_EQ(pattern(16), (Positions{{9, 9},
                                    {7, 5},
                                    {5, 10},
                                    {12, 7},
                                    {3, 6},
                                    {10, 13},
                                    {13, 11},
                                    {11, 3},
                                    {6, 14},
                                    {8, 1},
                                    {4, 2},
                                    {2, 12},
                                    {0, 8},
                                    {15, 4},
                                    {14, 15},
                                    {1, 0}}));
}

TEST(SamplePattern, HasAsManyPositionsAsSamplesAllDifferentAndInThePixel) {
  for (const int samples : kCounts) {
    SCOPED_TRACE(samples);
    std::set<std::pair<int, int>> different;
    for (const SamplePosition& p : standard_pattern(samples)) {
      EXPECT_TRUE(p.x >= 0 && p.x <= 15 && p.y >= 0 && p.y <= 15) << p.x << ", " << p.y;
      different.emplace(p.x, p.y);
    }
    EXPECT_EQ(different.size(), static_cast<std::size_t>(samples));
  }
}

// From two samples on, no two samples share a row or a column. This makes near-vertical and
// near-horizontal edges smooth, and a mistyped number breaks it.
TEST(SamplePattern, NoTwoSamplesShareARowOrAColumn) {
  for (const int samples : kCounts) {
    SCOPED_TRACE(samples);
    std::set<int> columns;
    std::set<int> rows;
    for (const SamplePosition& p : standard_pattern(samples)) {
      EXPECT_TRUE(columns.insert(p.x).second) << p.x;
      EXPECT_TRUE(rows.insert(p.y).second) << p.y;
    }
  }
}

TEST(SamplePattern, IsEmptyForCountsThatAreNotInTheTable) {
  for (int samples = -2; samples <= 64; ++samples) {
    if (std::find(std::begin(kCounts), std::end(kCounts), samples) != std::end(kCounts)) continue;
    EXPECT_TRUE(standard_pattern(samples).empty()) << samples;
  }
  EXPECT_TRUE(standard_pattern(std::numeric_limits<int>::min()).empty());
  EXPECT_TRUE(standard_pattern(std::numeric_limits<int>::max()).empty());
}

}  // namespace
}  // namespace rastercheck::cases::sample_pattern_test
