#include "properties/campaign/findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rastercheck::properties::findings_test {
namespace {

using records::Counterexample;
using testing::ElementsAre;
using testing::SizeIs;

/// A counterexample with only the parts that merging looks at.
Findings found_one(const cases::Found& found, records::Origin origin = records::Origin::random,
                   const std::string& name = "") {
  Findings findings;
  Counterexample one;
  one.source.found = found;
  one.source.name = name;
  one.origin = origin;
  findings.counterexamples = {one};
  return findings;
}

// Kills: one failure that hides another; more failures of one kind than a reader wants.
TEST(Merge, KeepsTheFirstOfEachWayToFail) {
  Findings all;
  for (const std::uint64_t index : {9U, 3U, 8U, 1U, 7U, 5U}) {
    for (const char* law : {"b", "a"}) {
      for (const char* backend : {"y", "x"}) {
        for (const char* verdict : {"missing", "extra"}) {
          merge(all, found_one({law, backend, verdict, 1, index}));
        }
      }
    }
  }
  std::vector<std::string> kept;
  for (const Counterexample& one : all.counterexamples) {
    const cases::Found& found = *one.source.found;
    kept.push_back(found.law + found.backend + found.verdict[0] + std::to_string(found.index));
  }
  EXPECT_THAT(kept, ElementsAre("axe1", "axm1", "aye1", "aym1", "bxe1", "bxm1", "bye1", "bym1"));
}

// Kills: a failure under one condition that is hidden by a failure under another.
TEST(Merge, KeepsTheFirstOfEachKindAndCondition) {
  Findings all;
  for (const std::uint64_t index : {9U, 3U, 8U}) {
    for (const char* kind : {"depth", "smooth"}) {
      for (const char* condition : {"clipped", "ordinary"}) {
        merge(all, found_one({"law", "backend", "beyond bound", 1, index, kind, condition}));
      }
    }
  }
  EXPECT_THAT(all.counterexamples, SizeIs(4));
  for (const Counterexample& one : all.counterexamples) EXPECT_EQ(one.source.found->index, 3U);
}

// Kills: one counterexample for each law although a driver hangs on every large case.
TEST(Merge, KeepsOneHangOfABackend) {
  Findings all;
  for (const std::uint64_t index : {9U, 3U, 8U}) {
    for (const char* law : {"b", "a"}) {
      for (const char* backend : {"y", "x"}) {
        const cases::Found found{law, backend, "hang", 1, index};
        const bool was_to_be_kept = is_kept(all, found, records::Origin::random, "");
        const Findings before = all;
        merge(all, found_one(found));
        EXPECT_TRUE(was_to_be_kept || all == before);
      }
    }
  }
  merge(all, found_one({"b", "x", "missing", 1, 30}));
  std::vector<std::string> kept;
  for (const Counterexample& one : all.counterexamples) {
    const cases::Found& found = *one.source.found;
    kept.push_back(found.law + found.backend + found.verdict[0] + std::to_string(found.index));
  }
  EXPECT_THAT(kept, ElementsAre("axh3", "ayh3", "bxm30"));
}

// Kills: a random case kept in place of a case with a name and a sentence.
TEST(Merge, TakesTheCorpusBeforeSavedCasesAndTheseBeforeOthers) {
  using records::Origin;
  const cases::Found late{"law", "cpu", "missing", 1, 9};
  const cases::Found early{"law", "cpu", "missing", 1, 2};
  Findings all = found_one(early);
  const auto origin = [&all] { return all.counterexamples.at(0).origin; };
  merge(all, found_one(late, Origin::scene));
  EXPECT_EQ(origin(), Origin::scene);
  merge(all, found_one(late, Origin::saved));
  EXPECT_EQ(origin(), Origin::saved);
  merge(all, found_one(late, Origin::corpus, "b"));
  merge(all, found_one(early, Origin::saved));
  EXPECT_EQ(origin(), Origin::corpus);
  merge(all, found_one(late, Origin::corpus, "a"));
  EXPECT_EQ(all.counterexamples.at(0).source.name, "a");
  merge(all, found_one(early, Origin::corpus, "z"));
  EXPECT_EQ(all.counterexamples.at(0).source.name, "z");
  EXPECT_THAT(all.counterexamples, SizeIs(1));
}

// Kills: showing first a counterexample with many triangles, or one of a law that changes the case.
TEST(FirstToRead, IsOfTheCaseAsItStandsAndSmall) {
  const auto one = [](const char* law, std::size_t triangles) {
    Counterexample counterexample;
    counterexample.source.found = cases::Found{law, "cpu", "missing", 1, 2};
    counterexample.source.triangles.resize(triangles);
    return counterexample;
  };
  EXPECT_EQ(first_to_read({one("a", 3), one("b", 2), one("c", 2)}), 1U);
  EXPECT_EQ(first_to_read({one("a", 1), one("coverage-obeys-the-contract", 9), one("c", 1),
                           one("values-stay-within-the-bound", 4)}),
            3U);
  EXPECT_EQ(first_to_read({}), 0U);
}

// Kills: a wrong fill rule, visible as one sample in every mesh, shown after a sample that floats
// cannot decide.
TEST(FirstToRead, PrefersFaultsOfLogicToFaultsOfRounding) {
  const auto one = [](double distance, std::size_t triangles) {
    Counterexample counterexample;
    counterexample.source.found =
        cases::Found{"coverage-obeys-the-contract", "cpu", "missing", 1, 2};
    counterexample.source.triangles.resize(triangles);
    counterexample.violations.resize(1);
    counterexample.violations[0].fragment_class = records::FragmentClass::missing;
    counterexample.violations[0].distance = records::Enclosure{distance, distance};
    return counterexample;
  };
  EXPECT_EQ(first_to_read({one(-3e-7, 1), one(0, 2)}), 1U);
  EXPECT_EQ(first_to_read({one(3e-7, 1), one(0.5, 2)}), 1U);
  EXPECT_EQ(first_to_read({one(3e-7, 1), one(-0.5, 2)}), 1U);
  EXPECT_EQ(first_to_read({one(0, 2), one(0.5, 1)}), 1U);
  EXPECT_EQ(first_to_read({one(3e-7, 2), one(-3e-7, 1)}), 1U);
  // Neither a second sample that is far from the edge nor a wrong value can come from rounding
  // alone.
  Counterexample several = one(3e-7, 2);
  several.violations.push_back(one(0.5, 2).violations[0]);
  EXPECT_EQ(first_to_read({one(3e-7, 1), several}), 1U);
  Counterexample of_a_value = one(3e-7, 2);
  of_a_value.violations[0].fragment_class = records::FragmentClass::beyond_bound;
  EXPECT_EQ(first_to_read({one(3e-7, 1), of_a_value}), 1U);
}

// Kills: of two saved files with the same origin, keeping the one that was read first.
TEST(Merge, TakesTheSameOfTwoWhateverTheOrder) {
  const cases::Found found{"law", "cpu", "missing", 1, 2};
  Findings one = found_one(found, records::Origin::saved);
  Findings other = one;
  other.counterexamples[0].source.framebuffer.width = 7;
  Findings there = one;
  merge(there, other);
  merge(other, one);
  EXPECT_EQ(there, other);
}

TEST(Merge, KeepsTheFirstFault) {
  Findings all;
  merge(all, {});
  EXPECT_EQ(all.fault, std::nullopt);
  for (const char* fault : {"first", "second"}) {
    Findings findings;
    findings.fault = fault;
    merge(all, findings);
  }
  EXPECT_EQ(all.fault, "first");
}

}  // namespace
}  // namespace rastercheck::properties::findings_test
