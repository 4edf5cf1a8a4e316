#include "records/index_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

namespace rastercheck::records::index_set_test {
namespace {

using testing::ElementsAre;
using Numbers = std::set<std::uint64_t>;

constexpr std::uint64_t kGreatest = std::numeric_limits<std::uint64_t>::max();

IndexSet set_of(const Numbers& numbers) {
  IndexSet set;
  for (const std::uint64_t number : numbers) set.add(number);
  return set;
}

Numbers numbers_in(const IndexSet& set) {
  const auto all = set.first(1000);
  return {all.begin(), all.end()};
}

Numbers some_numbers() {
  Numbers numbers;
  const auto count = *rc::gen::inRange(0, 12);
  for (int i = 0; i < count; ++i) numbers.insert(*rc::gen::inRange<std::uint64_t>(0, 16));
  return numbers;
}

TEST(IndexSet, JoinsNeighbours) {
  EXPECT_EQ(set_of({1, 2, 3, 7}).ranges(), (std::vector<IndexSet::Range>{{1, 3}, {7, 7}}));
  EXPECT_EQ(IndexSet({{4, 9}, {1, 3}, {8, 11}}), IndexSet({{1, 11}}));
  IndexSet joined = set_of({1, 3});
  joined.add(2);
  EXPECT_EQ(joined, IndexSet({{1, 3}}));
}

// Kills: ends that overflow.
TEST(IndexSet, HoldsTheGreatestNumber) {
  IndexSet set = set_of({kGreatest, 0});
  EXPECT_EQ(set.count(), 2U);
  EXPECT_THAT(set.first(9), ElementsAre(0U, kGreatest));
  EXPECT_EQ(without(set, set_of({kGreatest})), set_of({0}));
  EXPECT_EQ(without(set, set_of({0})), set_of({kGreatest}));
}

RC_GTEST_PROP(IndexSet, IsASetHoweverItIsFilled, ()) {
  const auto numbers =
      *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(0, 16));
  IndexSet set;
  for (const std::uint64_t number : numbers) set.add(number);
  const Numbers expected(numbers.begin(), numbers.end());
  RC_ASSERT(set == set_of(expected));
  RC_ASSERT(numbers_in(set) == expected);
  RC_ASSERT(set.count() == expected.size());
  for (std::uint64_t number = 0; number < 18; ++number) {
    RC_ASSERT(set.contains(number) == expected.contains(number));
  }
}

RC_GTEST_PROP(IndexSet, HasTheOperationsOfSets, ()) {
  const Numbers a = some_numbers();
  const Numbers b = some_numbers();
  Numbers shared;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(),
                        std::inserter(shared, shared.end()));
  Numbers rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(rest, rest.end()));
  Numbers all = a;
  all.insert(b.begin(), b.end());
  RC_ASSERT(common(set_of(a), set_of(b)) == set_of(shared));
  RC_ASSERT(without(set_of(a), set_of(b)) == set_of(rest));
  IndexSet merged = set_of(a);
  merged.merge(set_of(b));
  RC_ASSERT(merged == set_of(all));
}

}  // namespace
}  // namespace rastercheck::records::index_set_test
