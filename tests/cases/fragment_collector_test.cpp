#include "cases/fragment_collector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace rastercheck::cases::fragment_collector_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Two triangles, 4 × 3 pixels of 2 samples, one attribute.
Case small_case() {
  Case c;
  c.framebuffer = {4, 3, 2};
  c.attributes = {{"u", Interpolation::smooth, Location::sample}};
  c.triangles = {{0, 1, 2}, {0, 1, 2}};
  return c;
}

/// Adds fragments whose depth and attribute say how many were added before.
void add_all(FragmentCollector& collector, const std::vector<SamplePlace>& places) {
  float number = 0;
  for (const SamplePlace& at : places) {
    EXPECT_EQ(collector.add(at, number, std::vector<float>{10 + number}), "");
    ++number;
  }
}

// Kills: an order taken for granted.
TEST(FragmentCollector, SortsByTriangleThenRowThenColumnThenSample) {
  const Case c = small_case();
  FragmentCollector collector(c);
  add_all(collector, {{1, 0, 0, 0}, {0, 2, 1, 1}, {0, 2, 1, 0}, {0, 1, 3, 0}});
  const auto sorted = collector.take();
  ASSERT_TRUE(sorted);
  EXPECT_THAT(sorted->triangle, ElementsAre(0, 0, 0, 1));
  EXPECT_THAT(sorted->y, ElementsAre(1, 2, 2, 0));
  EXPECT_THAT(sorted->x, ElementsAre(3, 1, 1, 0));
  EXPECT_THAT(sorted->sample, ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(sorted->depth, ElementsAre(3, 2, 1, 0));
  EXPECT_THAT(sorted->attributes, ElementsAre(13, 12, 11, 10));
}

TEST(FragmentCollector, KeepsTheRightOrder) {
  const Case c = small_case();
  FragmentCollector collector(c);
  collector.reserve(3);
  add_all(collector, {{0, 0, 1, 0}, {0, 0, 1, 1}, {1, 0, 0, 0}});
  const auto same = collector.take();
  ASSERT_TRUE(same);
  EXPECT_EQ(same->attribute_count, 1U);
  EXPECT_THAT(same->depth, ElementsAre(0, 1, 2));
  EXPECT_THAT(same->attributes, ElementsAre(10, 11, 12));
}

// Kills: duplicates noticed only where sorting is needed, or only where it is not.
TEST(FragmentCollector, RefusesTwoFragmentsAtASample) {
  const Case c = small_case();
  for (const bool is_adjacent : {true, false}) {
    FragmentCollector collector(c);
    add_all(collector, {{0, 0, 1, 0}, {0, 0, is_adjacent ? 1U : 2U, 0}});
    if (!is_adjacent) add_all(collector, {{0, 0, 1, 0}});
    const auto twice = collector.take();
    ASSERT_FALSE(twice);
    EXPECT_EQ(twice.error(), "pixel 1, 0, sample 0 has two fragments of triangle 0");
  }
}

TEST(FragmentCollector, RefusesWhatDoesNotFitTheCase) {
  const Case c = small_case();
  FragmentCollector collector(c);
  const std::vector<float> one{0};
  EXPECT_THAT(collector.add({2, 0, 0, 0}, 0, one), HasSubstr("triangle 2 of 2"));
  EXPECT_THAT(collector.add({0, 3, 0, 0}, 0, one), HasSubstr("pixel 0, 3, sample 0 of 4 x 3"));
  EXPECT_THAT(collector.add({0, 0, 4, 0}, 0, one), HasSubstr("pixel 4, 0"));
  EXPECT_THAT(collector.add({0, 0, 0, 2}, 0, one), HasSubstr("sample 2"));
  EXPECT_THAT(collector.add({0, 0, 0, 0}, 0, {}), HasSubstr("0 attributes of 1"));
  const auto drawn = collector.take();
  ASSERT_TRUE(drawn);
  EXPECT_EQ(drawn->size(), 0U);
}

}  // namespace
}  // namespace rastercheck::cases::fragment_collector_test
