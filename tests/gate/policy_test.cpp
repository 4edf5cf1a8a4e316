#include "gate/policy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <vector>

#include "gate/compare.h"
#include "tests/records/sample_sections.h"

namespace rastercheck::gate::policy_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kToday = "2026-03-01";

/// A comparison with the sample: the worst error of the sliver is now 3/4, and one more value of
/// all strata of its kind is misrounded.
std::vector<records::Comparison> two_worse() {
  records::BaselineSection after = records::sample_section();
  after.entries[records::kSampleSliver].worst = {0.75, 0.75};
  after.entries[records::kSampleAll].histogram.add(1);
  Result<records::Comparison> comparison = compare(records::sample_section(), after);
  EXPECT_TRUE(comparison);
  return {comparison.value_or(records::Comparison())};
}

Policy policy_of(const Allowance& allowance) {
  Policy policy{"p.json", {allowance}};
  policy.allow[0].reason = "known";
  if (policy.allow[0].until.empty()) policy.allow[0].until = kToday;
  return policy;
}

/// How many of the two worse entries are still refused.
std::uint64_t refused_under(const Allowance& allowance) {
  std::vector<records::Comparison> comparisons = two_worse();
  apply(policy_of(allowance), kToday, comparisons);
  return refused(comparisons);
}

TEST(Policy, AllowsEntriesThatMatch) {
  EXPECT_EQ(refused_under({}), 0U);
  Allowance allowance;
  allowance.law = "values*bounds";
  allowance.kind = "smooth";
  allowance.stratum = "sliver";
  EXPECT_EQ(refused_under(allowance), 1U);
  allowance.stratum = "all";
  EXPECT_EQ(refused_under(allowance), 1U);
  allowance.kind = "depth";
  EXPECT_EQ(refused_under(allowance), 2U);
  EXPECT_EQ(refused_under({.law = "other*"}), 2U);
  EXPECT_EQ(refused_under({.backend = "gl"}), 2U);
  EXPECT_EQ(refused_under({.backend = "c?u"}), 0U);
}

// Kills: a limit that is ignored, or that refuses errors below it.
TEST(Policy, AllowsGrowthUpToItsLimit) {
  Allowance allowance;
  allowance.stratum = "sliver";
  allowance.worst = 0.75;
  EXPECT_EQ(refused_under(allowance), 1U);
  allowance.worst = 0.7499;
  EXPECT_EQ(refused_under(allowance), 2U);
}

// Kills: a limit on the size of errors that also allows wrong samples and non-finite values.
TEST(Policy, OfALimitAllowsNothingThatCameOutWrong) {
  const auto refused_of = [](const std::function<void(records::EntryFigures&)>& change,
                             const records::EntryKey& key, std::optional<double> worst) {
    records::BaselineSection after = records::sample_section();
    change(after.entries[key]);
    std::vector<records::Comparison> comparisons{compare(records::sample_section(), after).value()};
    Policy policy;
    policy.allow = {Allowance{"*", "*", "*", "*", "why", "2026-12-31", worst}};
    apply(policy, kToday, comparisons);
    return refused(comparisons);
  };
  const auto missing = [](records::EntryFigures& figures) {
    ++figures.classes[records::FragmentClass::missing];
  };
  const auto violated = [](records::EntryFigures& figures) { ++figures.cases.violations; };
  const auto larger = [](records::EntryFigures& figures) { figures.worst = {0.75, 0.75}; };
  const auto not_finite = [](records::EntryFigures& figures) {
    figures.worst = {0.75, 0.75};
    figures.histogram.add_non_finite(1);
  };
  EXPECT_EQ(refused_of(larger, records::kSampleSliver, 0.75), 0U);
  EXPECT_EQ(refused_of(missing, records::kSampleCoverage, 0.75), 1U);
  EXPECT_EQ(refused_of(missing, records::kSampleAll, 0.75), 1U);
  EXPECT_EQ(refused_of(violated, records::kSampleCoverage, 0.75), 1U);
  EXPECT_EQ(refused_of(not_finite, records::kSampleSliver, 0.75), 1U);
  for (const auto& change : {std::function<void(records::EntryFigures&)>(missing), {violated}}) {
    EXPECT_EQ(refused_of(change, records::kSampleCoverage, std::nullopt), 0U);
  }
}

// A line of the policy holds until its day, including that day.
TEST(Policy, ExpiresAndSaysSo) {
  EXPECT_EQ(refused_under({.until = "2026-03-01"}), 0U);
  EXPECT_EQ(refused_under({.until = "2027-01-01"}), 0U);
  std::vector<records::Comparison> comparisons = two_worse();
  const records::PolicyReview review =
      apply(policy_of({.until = "2026-02-28"}), kToday, comparisons);
  EXPECT_EQ(refused(comparisons), 2U);
  EXPECT_THAT(review.expired,
              ElementsAre("p.json: /allow/0 (property '*', backend '*', *, *: known) "
                          "allowed until 2026-02-28"));
  EXPECT_THAT(review.unused, IsEmpty());
}

TEST(Policy, NamesWhatAllowsNothingAnyMore) {
  std::vector<records::Comparison> comparisons = two_worse();
  Policy policy = policy_of({.law = "values*"});
  policy.allow.push_back(policy_of({.stratum = "clipped"}).allow[0]);
  policy.allow.push_back(policy_of({.backend = "gl"}).allow[0]);  // not compared here
  const records::PolicyReview review = apply(policy, kToday, comparisons);
  EXPECT_THAT(review.unused,
              ElementsAre(HasSubstr("/allow/1 (property '*', backend '*', *, clipped")));
  EXPECT_THAT(review.expired, IsEmpty());
  EXPECT_EQ(comparisons[0].entries[1].allowed_because, "known (until 2026-03-01)");
}

// --- The file ------------------------------------------------------------------------------------

Result<Policy> parse(const std::string& allow) {
  return parse_policy(R"({"format": "rastercheck-policy", "version": 1, "allow": [)" + allow + "]}",
                      "p.json");
}

TEST(PolicyFile, IsRead) {
  const Result<Policy> policy = parse(
      R"({"property": "a*", "backend": "cpu", "kind": "smooth", "stratum": "all", "reason": "why",
          "until": "2028-02-29", "worst": 0.75}, {"reason": "other", "until": "0001-01-01"})");
  ASSERT_TRUE(policy) << to_string(policy.error());
  EXPECT_EQ(policy->file, "p.json");
  ASSERT_EQ(policy->allow.size(), 2U);
  EXPECT_EQ(policy->allow[0], (Allowance{"a*", "cpu", "smooth", "all", "why", "2028-02-29", 0.75}));
  EXPECT_EQ(policy->allow[1], (Allowance{"*", "*", "*", "*", "other", "0001-01-01", std::nullopt}));
}

TEST(PolicyFile, RefusesWhatIsNoDay) {
  for (const char* day : {"2026-02-29", "2026-13-01", "2026-00-10", "2026-1-01", "26-01-01", "",
                          "2026-01-32", "2026/01/01", "2026-01-01 ", "-026-01-01", "2026-+1-01"}) {
    const Result<Policy> policy =
        parse(R"({"reason": "why", "until": ")" + std::string(day) + "\"}");
    ASSERT_FALSE(policy) << day;
    EXPECT_EQ(to_string(policy.error()),
              "p.json: /allow/0/until: must be a date such as \"2026-12-31\"");
  }
}

TEST(PolicyFile, RefusesWhatItCannotMean) {
  const auto refusal = [](const std::string& allow) { return to_string(parse(allow).error()); };
  EXPECT_THAT(refusal(R"({"until": "2026-01-01"})"), HasSubstr("/allow/0"));
  EXPECT_THAT(refusal(R"({"reason": " ", "until": "2026-01-01"})"),
              HasSubstr("/allow/0/reason: must not be empty"));
  EXPECT_THAT(refusal(R"({"reason": "why", "until": "2026-01-01", "worst": -1})"),
              HasSubstr("/allow/0/worst"));
  EXPECT_THAT(refusal(R"({"reason": "why", "until": "2026-01-01", "properties": "*"})"),
              HasSubstr("properties"));
  EXPECT_EQ(
      to_string(parse_policy(R"({"format": "rastercheck-policy", "version": 2})", "p").error()),
      "p: /version: version must be 1");
}

}  // namespace
}  // namespace rastercheck::gate::policy_test
