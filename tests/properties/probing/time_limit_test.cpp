// A probe that is ended by its time limit says what it found until then, and what it did not. The
// tests count questions for the time, not seconds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "properties/probing/probe.h"
#include "tests/properties/probing/bent.h"

namespace rastercheck::properties::time_limit_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

ProbeOptions quick() {
  ProbeOptions options;
  options.cases = 1;
  options.asked = {cases::Coverage(cases::Snapping{8}), cases::Basis::ideal,
                   cases::TieRule::top_left};
  return options;
}

/// Probes `cpu` until the time was asked for this often.
records::Probe ended_after(std::uint64_t questions, std::uint64_t* asked = nullptr) {
  ProbeOptions options = quick();
  auto count = std::make_shared<std::uint64_t>(0);
  options.is_time_up = [count, questions] { return ++*count > questions; };
  const auto backend = backends::make_backend("cpu");
  Result<records::Probe> result = probe("cpu", **backend, options, {});
  EXPECT_TRUE(result.has_value());
  if (asked != nullptr) *asked = *count;
  return std::move(result).value_or(records::Probe());
}

std::vector<std::string> names_of(const std::vector<records::Unmeasured>& all) {
  std::vector<std::string> names;
  for (const records::Unmeasured& one : all) names.push_back(one.what);
  return names;
}

constexpr std::uint64_t kNeverUp = 1000000000;

// Kills: rows or terms of a measure that was cut short, and measures that nobody mentions.
TEST(TimeLimit, KeepsWholeMeasuresOnly) {
  std::uint64_t all = 0;
  const records::Probe whole = ended_after(kNeverUp, &all);
  EXPECT_THAT(whole.unmeasured, IsEmpty());
  const std::vector<std::string> names = names_of(ended_after(0).unmeasured);
  ASSERT_EQ(names.size(), whole.measures);
  std::vector<std::size_t> left;
  const std::uint64_t steps = names.size();
  for (std::uint64_t i = 1; i < steps; ++i) {
    const records::Probe part = ended_after(all * i / steps);
    ASSERT_LE(part.rows.size(), whole.rows.size());
    EXPECT_TRUE(std::equal(part.rows.begin(), part.rows.end(), whole.rows.begin()));
    const std::vector<std::string> lacking = names_of(part.unmeasured);
    EXPECT_TRUE(std::equal(lacking.rbegin(), lacking.rend(), names.rbegin()));
    EXPECT_FALSE(part.terms.smooth);  // measured last
    EXPECT_EQ(part.measures + lacking.size(), names.size());
    left.push_back(lacking.size());
  }
  EXPECT_TRUE(std::is_sorted(left.rbegin(), left.rend()));
  EXPECT_GT(left.front(), 4U);
  EXPECT_LT(left.back(), 4U);
}

TEST(TimeLimit, LeavesTermsOutThatWereNotMeasured) {
  const records::Probe probe = ended_after(0);
  EXPECT_THAT(probe.rows, IsEmpty());
  EXPECT_EQ(probe.measures, 0U);
  EXPECT_FALSE(probe.terms.coverage || probe.terms.tie_rule || probe.terms.basis);
  EXPECT_THAT(probe.unmeasured[0].keys,
              ElementsAre("coverage", "is_on_grid", "sample_position", "conservative"));
  EXPECT_THAT(probe.unmeasured[1].keys, ElementsAre("tie_rule"));
}

// Kills: measures that go on drawing.
TEST(TimeLimit, DrawsNothingOnceTheTimeIsUp) {
  std::uint64_t all = 0;
  ended_after(kNeverUp, &all);
  for (const std::uint64_t questions : {all / 5, all / 2}) {
    auto count = std::make_shared<std::uint64_t>(0);
    auto late = std::make_shared<std::uint64_t>(0);
    Bending bending;
    bending.before = [=](cases::Case c) {
      *late += *count > questions ? 1U : 0U;
      return c;
    };
    Bent backend(bending);
    ProbeOptions options = quick();
    options.is_time_up = [=] { return ++*count > questions; };
    ASSERT_TRUE(probe("bent", backend, options, {}).has_value());
    EXPECT_GT(*count, questions);
    EXPECT_EQ(*late, 0U);
  }
}

TEST(TimeLimit, TellsWhichMeasureComesNext) {
  const std::vector<std::string> names = names_of(ended_after(0).unmeasured);
  std::vector<std::string> told;
  const auto backend = backends::make_backend("cpu");
  const auto progress = [&](std::uint64_t done, std::uint64_t all, const std::string& what) {
    EXPECT_EQ(done, told.size());
    EXPECT_EQ(all, names.size());
    told.push_back(what);
  };
  ASSERT_TRUE(probe("cpu", **backend, quick(), progress).has_value());
  EXPECT_EQ(told, names);
}

}  // namespace
}  // namespace rastercheck::properties::time_limit_test
