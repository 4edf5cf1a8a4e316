#include "records/side_by_side.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rastercheck::records::side_by_side_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kLaw = "a law";

IndexSet numbers(const std::vector<std::uint64_t>& all) {
  IndexSet set;
  for (const std::uint64_t number : all) set.add(number);
  return set;
}

/// Two backends on random cases 0 to 9 of one law. `b` was not judged on case 9, got a different
/// case as number 8, and has a known defect in case 3.
Run two_backends() {
  Run run;
  run.plan.backends = {"a", "b"};
  run.plan.laws = {"a law without cases", kLaw};
  CaseOutcomes a;
  a.right = numbers({0, 1, 2, 3, 4, 5, 8, 9});
  a.wrong = numbers({6, 7});
  CaseOutcomes b;
  b.right = numbers({0, 1, 7, 8});
  b.wrong = numbers({2, 4, 5, 6});
  b.known = numbers({3});
  b.unlike["a"] = numbers({8});
  run.outcomes.emplace();
  run.outcomes->insert({{kLaw, "a", Origin::random}, a});
  run.outcomes->insert({{kLaw, "b", Origin::random}, b});
  return run;
}

CaseOutcomes& outcomes(Run& run, const char* backend, Origin origin = Origin::random) {
  return (*run.outcomes)[{kLaw, backend, origin}];
}

TEST(SideBySide, SaysWhoIsRight) {
  const std::vector<SideBySide> pairs = side_by_side(two_backends());
  ASSERT_THAT(pairs, SizeIs(1));
  const SideBySide& pair = pairs[0];
  EXPECT_EQ(pair.first, "a");
  EXPECT_EQ(pair.second, "b");
  EXPECT_EQ(pair.counts, (SideCounts{2, 4, 1, 1}));
  ASSERT_THAT(pair.laws, SizeIs(1));
  EXPECT_EQ(pair.laws[0].law, kLaw);
  EXPECT_EQ(pair.laws[0].counts, pair.counts);
  EXPECT_THAT(pair.laws[0].only_first_right,
              ElementsAre(CasePlace{Origin::random, 2}, CasePlace{Origin::random, 3},
                          CasePlace{Origin::random, 4}));
  EXPECT_THAT(pair.laws[0].only_second_right, ElementsAre(CasePlace{Origin::random, 7}));
}

// Kills: comparing different cases of the same number; hiding how many were left out.
TEST(SideBySide, ComparesTheSameCasesOnly) {
  const SideBySide pair = side_by_side(two_backends())[0];
  EXPECT_EQ(pair.judged_first, 10U);
  EXPECT_EQ(pair.judged_second, 9U);
  EXPECT_EQ(pair.unlike, 1U);
  EXPECT_EQ(pair.counts.cases(), 8U);
  EXPECT_EQ(pair.known_first, 0U);
  EXPECT_EQ(pair.known_second, 1U);
}

// Kills: the corpus' case 2 taken for random case 2.
TEST(SideBySide, TellsTheCorpusFromRandomCases) {
  records::Run run = two_backends();
  outcomes(run, "a", Origin::corpus).right = numbers({2, 7});
  outcomes(run, "b", Origin::corpus).wrong = numbers({7});
  const SideBySide pair = side_by_side(run)[0];
  EXPECT_EQ(pair.counts, (SideCounts{2, 5, 1, 1}));
  EXPECT_THAT(pair.laws[0].only_first_right,
              ElementsAre(CasePlace{Origin::corpus, 7}, CasePlace{Origin::random, 2},
                          CasePlace{Origin::random, 3}));
}

TEST(SideBySide, HasEveryTwoOfThreeAndEachWithTheFirstOfMore) {
  records::Run run = two_backends();
  const auto names = [&run] {
    std::vector<std::string> all;
    for (const SideBySide& pair : side_by_side(run)) all.push_back(pair.first + pair.second);
    return all;
  };
  run.plan.backends = {"a", "b", "c"};
  EXPECT_THAT(names(), ElementsAre("ab", "ac", "bc"));
  run.plan.backends = {"a", "b", "c", "d"};
  EXPECT_THAT(names(), ElementsAre("ab", "ac", "ad"));
  run.plan.backends = {"a"};
  EXPECT_THAT(names(), IsEmpty());
}

// Kills: a comparison of what a shard happened to check, or of a run from before outcomes were
// kept.
TEST(SideBySide, IsNothingForAShardOrAnOldRun) {
  records::Run run = two_backends();
  run.plan.shard = {1, 2};
  EXPECT_THAT(side_by_side(run), IsEmpty());
  run = two_backends();
  run.outcomes.reset();
  EXPECT_THAT(side_by_side(run), IsEmpty());
}

TEST(SideBySide, HasTheLargestErrorsOfEachKind) {
  records::Run run = two_backends();
  const auto add = [&run](const char* backend, AttributeKind kind, const char* stratum,
                          double error) {
    ErrorSizes& excess = run.records[{kLaw, backend, kind, stratum}].errors.excess;
    excess.histogram.add(error < 0 ? -error : error);
    WorstError worst;
    worst.error = {error, error};
    keep(excess.extremes, worst);
  };
  add("a", AttributeKind::smooth, "grid", -0.25);
  add("a", AttributeKind::smooth, "sliver", 0.125);
  add("b", AttributeKind::smooth, "grid", 2);
  add("b", AttributeKind::depth, "grid", 0);
  EXPECT_THAT(
      side_by_side(run)[0].errors,
      ElementsAre(SideErrors{AttributeKind::depth, std::nullopt, Enclosure{0, 0}},
                  SideErrors{AttributeKind::smooth, Enclosure{0.25, 0.25}, Enclosure{2, 2}}));
}

}  // namespace
}  // namespace rastercheck::records::side_by_side_test
