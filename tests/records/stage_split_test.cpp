#include "records/stage_split.h"

#include <gtest/gtest.h>

namespace rastercheck::records::stage_split_test {
namespace {

// Kills: returning the last of equally large parts; comparing parts with their signs.
TEST(LargestPart, IsTheFirstOfTheGreatestMagnitude) {
  ErrorSplit split;
  split.parts = {{Stage::set_up, {1, 1}}, {Stage::weights, {-3, -3}}, {Stage::evaluation, {3, 3}}};
  EXPECT_EQ(largest_part(split), Stage::weights);
}

TEST(LargestPart, IsEmptyWithoutErrors) {
  ErrorSplit split;
  EXPECT_EQ(largest_part(split), std::nullopt);
  split.parts = {{Stage::set_up, {0, 0}}, {Stage::rounding, {0, 0}}};
  EXPECT_EQ(largest_part(split), std::nullopt);
}

}  // namespace
}  // namespace rastercheck::records::stage_split_test
