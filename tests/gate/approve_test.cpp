#include "gate/approve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/records/sample_sections.h"

namespace rastercheck::gate::approve_test {
namespace {

using records::AttributeKind;
using records::Stratum;
using testing::ElementsAre;
using testing::IsEmpty;

/// The sample section at another commit: the worst error of the sliver is 3/4, and one fragment is
/// extra.
records::BaselineSection worse_section() {
  records::BaselineSection section = records::sample_section();
  section.taken.commit = "beef";
  section.entries[records::kSampleSliver].worst = {0.75, 0.75};
  section.entries[records::kSampleCoverage].classes[records::FragmentClass::extra] = 1;
  records::CaseFigures& figures = section.laws[records::kSampleLaw].cases[records::kSampleCase];
  figures.found_digest = 8;
  figures.mismatches = 1;
  figures.worst[AttributeKind::smooth][Stratum::sliver] = records::sample_error(0.75);
  return section;
}

struct Approved {
  records::BaselineSection section;
  std::vector<std::string> changes;
};
Approved approved(const records::BaselineSection& before, const records::BaselineSection& current,
                  const EntryPattern& pattern) {
  Approved result{before, {}};
  const Result<records::Comparison> comparison = compare(before, current);
  EXPECT_TRUE(comparison);
  result.changes = approve(result.section, current, *comparison, pattern, "it is meant so");
  return result;
}

TEST(Approve, TakesAllOverAndSaysWhatChanged) {
  records::BaselineSection before = records::sample_section();
  before.key.compiler = "GNU 12.2.0";
  before.approvals = {{"earlier", "0.0.9", "", {"something"}}};
  const Approved result = approved(before, worse_section(), {});
  EXPECT_THAT(result.changes,
              ElementsAre("values are <within> bounds: coverage: extra 0 → 1",
                          "values are <within> bounds: coverage: cases that grew 0 → 1",
                          "values are <within> bounds: smooth: cases that grew 0 → 1",
                          "values are <within> bounds: smooth, sliver: worst 0.625 → 0.75 ULP",
                          "values are <within> bounds: smooth, sliver: cases that grew 0 → 1"));
  records::BaselineSection expected = worse_section();
  expected.key = before.key;
  expected.approvals = {before.approvals[0], {"it is meant so", "0.1.0", "beef", result.changes}};
  EXPECT_EQ(result.section, expected);
}

TEST(Approve, DoesNothingWhereNothingChanged) {
  const records::BaselineSection section = records::sample_section();
  EXPECT_THAT(approved(section, section, {}).changes, IsEmpty());
  EXPECT_EQ(approved(section, section, {}).section, section);
  EXPECT_EQ(approved(section, worse_section(), {.law = "other"}).section, section);
}

// Kills: approving entries or cases that were not chosen.
TEST(Approve, TakesOnlyWhatIsChosen) {
  const Approved result =
      approved(records::sample_section(), worse_section(), {.stratum = "sliver"});
  EXPECT_THAT(result.changes,
              ElementsAre("values are <within> bounds: smooth, sliver: worst 0.625 → 0.75 ULP",
                          "values are <within> bounds: smooth, sliver: cases that grew 0 → 1"));
  records::BaselineSection expected = records::sample_section();
  expected.entries[records::kSampleSliver].worst = {0.75, 0.75};
  expected.laws[records::kSampleLaw]
      .cases[records::kSampleCase]
      .worst[AttributeKind::smooth][Stratum::sliver] = records::sample_error(0.75);
  expected.approvals = {{"it is meant so", "0.1.0", "beef", result.changes}};
  EXPECT_EQ(result.section, expected);
  // Approves the rest next; then nothing differs.
  const Approved rest = approved(result.section, worse_section(), {.kind = "coverage"});
  EXPECT_EQ(rest.section.laws, worse_section().laws);
  EXPECT_EQ(rest.section.entries, worse_section().entries);
}

// Kills: approving a total without the matching errors of its cases, so that the total is worse
// again.
TEST(Approve, TakesATotalWithItsStrataAndCases) {
  records::BaselineSection current = worse_section();
  records::CaseFigures& other =
      current.laws[records::kSampleLaw].cases[{records::Origin::corpus, 0}];
  other.worst[AttributeKind::smooth][Stratum::ordinary] = records::sample_error(0.125);
  other.worst[AttributeKind::depth][Stratum::ordinary] = records::sample_error(0.25);
  const Approved result =
      approved(records::sample_section(), current, {.kind = "smooth", .stratum = "all"});
  EXPECT_THAT(result.changes,
              ElementsAre("values are <within> bounds: smooth: cases that grew 0 → 2",
                          "values are <within> bounds: smooth, sliver: worst 0.625 → 0.75 ULP",
                          "values are <within> bounds: smooth, sliver: cases that grew 0 → 1"));
  const auto worst_of = [](const records::BaselineSection& section) {
    return section.laws.at(records::kSampleLaw).cases.at({records::Origin::corpus, 0}).worst;
  };
  EXPECT_EQ(worst_of(result.section).at(AttributeKind::smooth),
            worst_of(current).at(AttributeKind::smooth));
  EXPECT_FALSE(worst_of(result.section).contains(AttributeKind::depth));
  const records::Comparison left = compare(result.section, current).value();
  EXPECT_EQ(refused(left), 1U);  // coverage
  EXPECT_TRUE(
      std::all_of(left.entries.begin(), left.entries.end(), [](const records::EntryChange& one) {
        return one.key.kind == AttributeKind::coverage || one.change == records::Change::same;
      }));
  EXPECT_EQ(approved(records::sample_section(), current, {.stratum = "all"}).section.laws,
            current.laws);
}

// Kills: approving a case together with an approved entry although the case's own entry, for which
// the baseline keeps no figure, was not approved.
TEST(Approve, LeavesCasesThatGrewToTheirOwnEntries) {
  records::BaselineSection current = records::sample_section();
  ++current.entries[records::kSampleCoverage].classes[records::FragmentClass::extra];
  current.laws[records::kSampleLaw]
      .cases[records::kSampleCase]
      .worst[AttributeKind::smooth][Stratum::sliver] = records::sample_error(0x1.4000000000001p-1);
  const Approved result = approved(records::sample_section(), current, {.kind = "coverage"});
  EXPECT_THAT(result.changes, ElementsAre("values are <within> bounds: coverage: extra 0 → 1"));
  EXPECT_EQ(refused(compare(result.section, current).value()), 2U);
}

// Kills: a case that is reported as violated again each time, although its violation was approved.
TEST(Approve, TakesWhatBecameOfCasesWithTheirCoverage) {
  records::BaselineSection current = records::sample_section();
  current.entries[records::kSampleCoverage].cases = {20, 3, 2, 0};
  auto& cases = current.laws[records::kSampleLaw].cases;
  cases[records::kSampleCase].outcome = records::CaseOutcome::violated;
  cases[records::kSampleCase].worst[AttributeKind::smooth][Stratum::sliver] =
      records::sample_error(0.75);
  cases[{records::Origin::random, 13}].outcome = records::CaseOutcome::violated;  // new
  cases.erase({records::Origin::corpus, 0});
  const records::BaselineSection section =
      approved(records::sample_section(), current, {.kind = "coverage"}).section;
  const auto& taken = section.laws.at(records::kSampleLaw).cases;
  EXPECT_EQ(taken.at(records::kSampleCase).outcome, records::CaseOutcome::violated);
  EXPECT_EQ(taken.at(records::kSampleCase).worst,
            records::sample_section().laws[records::kSampleLaw].cases[records::kSampleCase].worst);
  EXPECT_EQ(taken.size(), 2U);
  EXPECT_TRUE(are_outcomes_known(section, records::kSampleLaw));
  const records::Comparison left = compare(section, current).value();
  EXPECT_EQ(left.entries.at(0).change, records::Change::same);  // coverage
  EXPECT_EQ(refused(left), 2U);                                 // the error that grew
}

// Kills: approving violations without reporting them.
TEST(Approve, CountsViolationsOfLawsThatHaveMoreOrOthers) {
  using enum records::CaseOutcome;
  const records::CaseNumber other{records::Origin::random, 13};
  const auto with = [&other](records::CaseOutcome one, records::CaseOutcome another) {
    records::BaselineSection section = records::sample_section();
    section.laws[records::kSampleLaw].cases[records::kSampleCase].outcome = one;
    section.laws[records::kSampleLaw].cases[other].outcome = another;
    section.entries[records::kSampleCoverage].cases.violations =
        (one == violated ? 1U : 0U) + (another == violated ? 1U : 0U);
    return section;
  };
  const auto taken = [](const records::BaselineSection& before,
                        const records::BaselineSection& after, const EntryPattern& pattern) {
    return violations_taken(compare(before, after).value(), pattern);
  };
  EXPECT_THAT(taken(with(held, held), with(violated, violated), {}),
              ElementsAre(testing::Pair(records::kSampleLaw, 2U)));
  EXPECT_THAT(taken(with(held, violated), with(violated, held), {}),
              ElementsAre(testing::Pair(records::kSampleLaw, 1U)));
  EXPECT_THAT(taken(with(violated, violated), with(violated, held), {}), IsEmpty());
  EXPECT_THAT(taken(with(held, held), with(violated, held), {.kind = "smooth"}), IsEmpty());
}

// Kills: digests that stay old forever, because no changed figure exists that could be approved.
TEST(Approve, TakesOtherBitsOver) {
  records::BaselineSection current = records::sample_section();
  current.laws[records::kSampleLaw].cases[records::kSampleCase].found_digest = 1000;
  const Approved result = approved(records::sample_section(), current, {});
  EXPECT_THAT(result.changes, ElementsAre("1 of 23 cases drew other bits, but no number changed"));
  EXPECT_EQ(result.section.laws, current.laws);
}

TEST(Approve, TakesNewLawsAndDropsThoseThatAreGone) {
  records::BaselineSection current = records::sample_section();
  const records::EntryKey other{"other", AttributeKind::coverage, std::nullopt};
  current.entries[other].cases.checked = 1;
  current.laws["other"].count = 1;
  const Approved added = approved(records::sample_section(), current, {.law = "other"});
  EXPECT_THAT(added.changes, ElementsAre("other: coverage: new"));
  EXPECT_EQ(added.section.entries, current.entries);
  EXPECT_EQ(added.section.laws, current.laws);
  const Approved dropped = approved(current, records::sample_section(), {.law = "other"});
  EXPECT_THAT(dropped.changes, ElementsAre("other: coverage: gone"));
  EXPECT_EQ(dropped.section.laws, records::sample_section().laws);
}

}  // namespace
}  // namespace rastercheck::gate::approve_test
