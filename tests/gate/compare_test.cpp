#include "gate/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "tests/records/sample_sections.h"

namespace rastercheck::gate::compare_test {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::Stage;
using records::Stratum;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

records::Comparison compared(const records::BaselineSection& before,
                             const records::BaselineSection& after) {
  const Result<records::Comparison> comparison = compare(before, after);
  EXPECT_TRUE(comparison) << to_string(comparison.error());
  return comparison.value_or(records::Comparison());
}

const records::EntryChange& entry_of(const records::Comparison& comparison,
                                     const records::EntryKey& key) {
  static const records::EntryChange kNone;
  const auto found =
      std::find_if(comparison.entries.begin(), comparison.entries.end(),
                   [&key](const records::EntryChange& one) { return one.key == key; });
  EXPECT_NE(found, comparison.entries.end()) << to_string(key);
  return found == comparison.entries.end() ? kNone : *found;
}

std::string refusal(const records::BaselineSection& before, const records::BaselineSection& after) {
  const Result<records::Comparison> comparison = compare(before, after);
  return comparison ? "" : comparison.error().reason;
}

/// Changes one entry of the sample so that it becomes worse, and returns the only figure that
/// changed. Also expects that this figure is the only one that is better if the sections are
/// exchanged.
records::FigureChange only_change(const records::EntryKey& key,
                                  const std::function<void(records::EntryFigures&)>& change) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  change(after.entries[key]);
  const records::EntryChange worse = entry_of(compared(before, after), key);
  const records::EntryChange better = entry_of(compared(after, before), key);
  EXPECT_EQ(worse.change, records::Change::worse);
  EXPECT_EQ(better.change, records::Change::better);
  EXPECT_THAT(worse.figures, SizeIs(1));
  EXPECT_THAT(better.figures, SizeIs(1));
  if (worse.figures.size() != 1 || better.figures.size() != 1) return {};
  EXPECT_EQ(better.figures[0].before, worse.figures[0].after);
  EXPECT_EQ(better.figures[0].after, worse.figures[0].before);
  EXPECT_EQ(refused(compared(before, after)), 1U);
  EXPECT_EQ(refused(compared(after, before)), 0U);
  return worse.figures[0];
}

TEST(Compare, OfTheSameIsSilent) {
  const records::BaselineSection section = records::sample_section();
  const records::Comparison first = compared(section, section);
  EXPECT_EQ(count_of(first, records::Change::same), 3U);
  EXPECT_EQ(first.entries.size(), 3U);
  EXPECT_THAT(first.growths, IsEmpty());
  EXPECT_EQ(first.changed_cases, 0U);
  EXPECT_EQ(first.compared_cases, 23U);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(compared(section, section), first);
}

// Kills: comparing with a tolerance.
TEST(Compare, SeesOneUlpOfTheWorst) {
  const records::FigureChange change =
      only_change(records::kSampleSliver, [](records::EntryFigures& figures) {
        const double next = std::nextafter(0.625, 1.0);
        figures.worst = {next, next};
      });
  EXPECT_EQ(change.figure, records::Figure::worst);
  EXPECT_EQ(change.before.size, (records::Enclosure{0.625, 0.625}));
}

// Kills: comparing only one end of an enclosure.
TEST(Compare, SeesEitherEndOfAnEnclosureGrow) {
  const double next = std::nextafter(0.625, 1.0);
  only_change(records::kSampleSliver, [next](records::EntryFigures& figures) {
    figures.worst = {0.625, next};
  });
  const records::BaselineSection before = [next] {
    records::BaselineSection section = records::sample_section();
    section.entries[records::kSampleSliver].worst = {0.625, next};
    return section;
  }();
  records::BaselineSection after = before;
  after.entries[records::kSampleSliver].worst = {next, next};
  EXPECT_EQ(entry_of(compared(before, after), records::kSampleSliver).change,
            records::Change::worse);
}

// The median of four is the second: 1/4, in the bucket (…, 1/4]. The next bucket ends at 2^(-15/8).
TEST(Compare, SeesOneBucketOfAQuantile) {
  const records::FigureChange change =
      only_change(records::kSampleAll, [](records::EntryFigures& figures) {
        figures.histogram = {};
        for (const double error : {0.0, 0.26, 0.5, 0.625}) figures.histogram.add(error);
      });
  EXPECT_EQ(change.figure, records::Figure::p50);
  EXPECT_EQ(change.before.size->hi, 0.25);
  EXPECT_EQ(change.after.size->lo, 0.25);
}

// 1 value of 4 is off by more than 1/2. Kills: shares computed in double; counts compared as if
// they were shares.
TEST(Compare, SeesSharesExactly) {
  constexpr std::uint64_t kMany = std::uint64_t{1} << 60;
  const auto with = [](std::uint64_t misrounded, std::uint64_t others) {
    records::BaselineSection section = records::sample_section();
    records::Histogram histogram;
    histogram.add_to_bucket(records::Histogram::bucket_of(0.625), misrounded);
    histogram.add_to_bucket(records::Histogram::bucket_of(0.0), others);
    section.entries[records::kSampleAll].histogram = histogram;
    return section;
  };
  const auto change = [&](const records::BaselineSection& before,
                          const records::BaselineSection& after) {
    return entry_of(compared(before, after), records::kSampleAll);
  };
  EXPECT_EQ(change(with(1, 3), with(2, 6)).change, records::Change::same);
  EXPECT_EQ(change(with(kMany + 1, 3 * kMany - 1), with(kMany, 3 * kMany)).change,
            records::Change::better);
  const records::EntryChange worse = change(with(kMany, 3 * kMany), with(kMany + 1, 3 * kMany - 1));
  ASSERT_THAT(worse.figures, SizeIs(1));
  EXPECT_EQ(worse.figures[0].figure, records::Figure::misrounded);
  EXPECT_EQ(worse.figures[0].after, (records::FigureValue{std::nullopt, kMany + 1, 4 * kMany}));
  EXPECT_EQ(change(with(kMany, 3 * kMany), with(kMany - 1, 3 * kMany + 1)).change,
            records::Change::better);
}

TEST(Compare, SeesOneMismatchOfAClass) {
  const records::FigureChange change =
      only_change(records::kSampleCoverage,
                  [](records::EntryFigures& figures) { ++figures.classes[FragmentClass::extra]; });
  EXPECT_EQ(change.figure, records::Figure::mismatches);
  EXPECT_EQ(figure_name(change), "extra");
  EXPECT_EQ(change.after.count, 1U);
}

// Kills: not noticing that a contract was loosened, so that fewer values are judged than before.
TEST(Compare, HoldsTheShareThatWasJudged) {
  const auto change_of = [](std::optional<std::uint64_t> was, std::optional<std::uint64_t> is) {
    records::BaselineSection before = records::sample_section();
    records::BaselineSection after = before;
    before.entries[records::kSampleCoverage].not_judged = was;
    after.entries[records::kSampleCoverage].not_judged = is;
    return entry_of(compared(before, after), records::kSampleCoverage);
  };
  ASSERT_EQ(change_of(1, 2).figures.size(), 1U);
  EXPECT_EQ(change_of(1, 2).figures[0].figure, records::Figure::not_judged);
  EXPECT_EQ(change_of(1, 2).change, records::Change::worse);
  EXPECT_EQ(change_of(2, 1).change, records::Change::better);
  EXPECT_EQ(change_of(2, 2).change, records::Change::same);
  EXPECT_EQ(change_of(std::nullopt, 2).change, records::Change::same);  // from an older file
}

TEST(Compare, SeesViolationsAndCasesThatAreNoLongerChecked) {
  EXPECT_EQ(only_change(records::kSampleCoverage,
                        [](records::EntryFigures& figures) { ++figures.cases.violations; })
                .figure,
            records::Figure::violations);
  EXPECT_EQ(only_change(records::kSampleCoverage,
                        [](records::EntryFigures& figures) { ++figures.cases.known; })
                .figure,
            records::Figure::known);
  EXPECT_EQ(only_change(records::kSampleCoverage,
                        [](records::EntryFigures& figures) { --figures.cases.checked; })
                .figure,
            records::Figure::checked);
}

// Kills: a test that became weaker and is called better, or goes unnoticed.
TEST(Compare, FewerDefectsNoticedAreWorse) {
  const records::FigureChange change = only_change(
      records::kSampleCoverage, [](records::EntryFigures& figures) { --figures.power.noticed; });
  EXPECT_EQ(change.figure, records::Figure::noticed);
  EXPECT_EQ(change.change, records::Change::worse);
}

// If the numbers of damaged drawings differ, different defects were put into them (drawings that
// were wrong already are not damaged), so the noticed defects cannot be compared.
TEST(Compare, DefectsOfOtherDrawingsAreNotCompared) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  ++after.entries[records::kSampleCoverage].power.drawings;
  --after.entries[records::kSampleCoverage].power.noticed;
  EXPECT_EQ(entry_of(compared(before, after), records::kSampleCoverage).change,
            records::Change::same);
}

// If more samples are drawn where the contract allows either, this is neither better nor worse.
TEST(Compare, CallsMoreCorrectFragmentsTheSame) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  ++after.entries[records::kSampleCoverage].classes[FragmentClass::correct];
  EXPECT_EQ(entry_of(compared(before, after), records::kSampleCoverage).change,
            records::Change::same);
}

// Kills: balancing better figures against worse ones.
TEST(Compare, CallsAnEntryWithBothWorse) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  after.entries[records::kSampleCoverage].cases.violations = 1;
  after.entries[records::kSampleCoverage].cases.checked = 22;
  const records::Comparison comparison = compared(before, after);
  EXPECT_EQ(entry_of(comparison, records::kSampleCoverage).change, records::Change::worse);
  EXPECT_EQ(entry_of(compared(after, before), records::kSampleCoverage).change,
            records::Change::worse);
  EXPECT_EQ(count_of(comparison, records::Change::worse), 1U);
}

TEST(Compare, NamesWhatIsNewAndGone) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  after.entries.erase(records::kSampleSliver);
  const records::EntryKey depth{"another law", AttributeKind::depth, std::nullopt};
  after.entries[depth] = {};
  after.laws["another law"].count = 4;
  const records::Comparison comparison = compared(before, after);
  EXPECT_EQ(entry_of(comparison, records::kSampleSliver).change, records::Change::gone);
  EXPECT_EQ(entry_of(comparison, depth).change, records::Change::appeared);
  EXPECT_THAT(comparison.new_laws, ElementsAre("another law"));
  EXPECT_THAT(compared(after, before).gone_laws, ElementsAre("another law"));
  EXPECT_EQ(refused(comparison), 0U);
}

// Kills: reporting changed bits as a regression, or not at all.
TEST(Compare, SaysThatBitsChangedThoughNoFigureDid) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  after.laws[records::kSampleLaw].cases[{records::Origin::corpus, 0}].found_digest = 10;
  const records::Comparison comparison = compared(before, after);
  EXPECT_EQ(comparison.changed_cases, 1U);
  EXPECT_EQ(comparison.grown_cases, 0U);
  EXPECT_EQ(count_of(comparison, records::Change::same), 3U);
}

// --- Cases ---------------------------------------------------------------------------------------

TEST(CompareCases, ShowBothErrorsOfTheGrownCase) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  records::CaseFigures& figures = after.laws[records::kSampleLaw].cases[records::kSampleCase];
  figures.found_digest = 8;
  figures.worst[AttributeKind::smooth][Stratum::sliver] = records::sample_error(-0.75, 0.5F);
  const records::Comparison comparison = compared(before, after);
  ASSERT_THAT(comparison.growths, SizeIs(1));
  const records::CaseGrowth& growth = comparison.growths[0];
  EXPECT_EQ(growth.law, records::kSampleLaw);
  EXPECT_EQ(growth.index, 12U);
  EXPECT_EQ(growth.stratum, Stratum::sliver);
  EXPECT_EQ(growth.before, records::sample_error(0.625));
  EXPECT_EQ(growth.after, records::sample_error(-0.75, 0.5F));
  EXPECT_EQ(comparison.grown_cases, 1U);
  const records::Comparison back = compared(after, before);
  EXPECT_EQ(back.changed_cases, 1U);
  EXPECT_THAT(back.growths, IsEmpty());
}

// Kills: missing an error that grows but stays below the largest error of all.
TEST(CompareCases, MakeTheirEntriesWorse) {
  records::BaselineSection before = records::sample_section();
  auto& small = before.laws[records::kSampleLaw].cases[{records::Origin::random, 0}];
  small.worst[AttributeKind::smooth][Stratum::sliver] = records::sample_error(0.25);
  records::BaselineSection after = before;
  records::CaseFigures& grown = after.laws[records::kSampleLaw].cases[{records::Origin::random, 0}];
  grown.worst[AttributeKind::smooth][Stratum::sliver] = records::sample_error(0x1.0000000000001p-2);
  const records::Comparison comparison = compared(before, after);
  for (const records::EntryKey& key : {records::kSampleAll, records::kSampleSliver}) {
    const records::EntryChange& entry = entry_of(comparison, key);
    EXPECT_EQ(entry.change, records::Change::worse);
    ASSERT_THAT(entry.figures, SizeIs(1));
    EXPECT_EQ(entry.figures[0].figure, records::Figure::grown_cases);
    EXPECT_EQ(entry.figures[0].after.count, 1U);
  }
  EXPECT_EQ(entry_of(comparison, records::kSampleCoverage).change, records::Change::same);
  EXPECT_EQ(refused(comparison), 2U);
  EXPECT_EQ(count_of(compared(after, before), records::Change::same), 3U);

  // For all strata together, only the largest error counts; an error that grows below it does not.
  grown.worst[AttributeKind::smooth] = {{Stratum::ordinary, records::sample_error(0.25)},
                                        {Stratum::sliver, records::sample_error(0.125)}};
  EXPECT_EQ(entry_of(compared(before, after), records::kSampleAll).change, records::Change::same);

  grown = small;
  ++grown.mismatches;
  EXPECT_EQ(entry_of(compared(before, after), records::kSampleCoverage).change,
            records::Change::worse);
  EXPECT_EQ(entry_of(compared(after, before), records::kSampleCoverage).change,
            records::Change::same);
}

/// The sample with cases of these outcomes, and with as many violations in its figures.
records::BaselineSection with_outcomes(
    const std::map<std::uint64_t, records::CaseOutcome>& outcomes) {
  records::BaselineSection section = records::sample_section();
  for (const auto& [index, outcome] : outcomes) {
    section.laws[records::kSampleLaw].cases[{records::Origin::random, index}].outcome = outcome;
    records::CaseCounts& counts = section.entries[records::kSampleCoverage].cases;
    if (outcome == records::CaseOutcome::violated) ++counts.violations;
    if (outcome == records::CaseOutcome::known) ++counts.known;
  }
  return section;
}

/// The number of cases that grew, from the coverage entry. Expects that no other figure of that
/// entry is worse.
std::uint64_t grown_in(const records::BaselineSection& before,
                       const records::BaselineSection& after) {
  const records::EntryChange entry = entry_of(compared(before, after), records::kSampleCoverage);
  std::uint64_t grown = 0;
  for (const records::FigureChange& figure : entry.figures) {
    if (figure.change != records::Change::worse) continue;
    EXPECT_EQ(figure.figure, records::Figure::grown_cases);
    grown += figure.after.count;
  }
  return grown;
}

// Kills: a new violation that is hidden by one that was fixed.
TEST(CompareCases, AreHeldOneByOne) {
  using enum records::CaseOutcome;
  const records::BaselineSection before = with_outcomes({{1, violated}, {2, held}, {3, held}});
  EXPECT_EQ(grown_in(before, with_outcomes({{1, held}, {2, violated}, {3, held}})), 1U);
  EXPECT_EQ(grown_in(before, with_outcomes({{1, held}, {2, held}, {3, held}})), 0U);
  EXPECT_EQ(
      grown_in(with_outcomes({{1, known}, {2, held}}), with_outcomes({{1, held}, {2, known}})), 1U);
  // In a case to which the law did not apply before, a violation is worse. If the law holds, that
  // is not worse, whatever the errors are.
  EXPECT_EQ(grown_in(before, with_outcomes({{1, held}, {2, held}, {3, held}, {4, violated}})), 1U);
  records::BaselineSection after = with_outcomes({{1, violated}, {2, held}, {3, held}, {4, held}});
  after.laws[records::kSampleLaw]
      .cases[{records::Origin::random, 4}]
      .worst[AttributeKind::smooth][Stratum::sliver] = records::sample_error(0.5);
  EXPECT_EQ(count_of(compared(before, after), records::Change::same), 3U);
  EXPECT_EQ(compared(before, after).changed_cases, 1U);
}

// Cases that are violated now come before all other cases, with their outcomes before and now.
TEST(CompareCases, ThatAreViolatedNowAreShownFirst) {
  using enum records::CaseOutcome;
  const records::BaselineSection before = with_outcomes({{1, violated}, {2, held}});
  records::BaselineSection after = with_outcomes({{1, held}, {2, held}, {4, violated}});
  records::CaseFigures& other = after.laws[records::kSampleLaw].cases[{records::Origin::random, 2}];
  other.found_digest = 5;
  other.mismatches = 9;
  const records::Comparison comparison = compared(before, after);
  ASSERT_THAT(comparison.growths, SizeIs(2));
  EXPECT_EQ(comparison.growths[0].index, 4U);
  EXPECT_EQ(comparison.growths[0].outcome_before, not_applicable);
  EXPECT_EQ(comparison.growths[0].outcome_after, violated);
  EXPECT_EQ(comparison.growths[1].index, 2U);
  EXPECT_EQ(comparison.grown_cases, 2U);
}

// Kills: counting every violation as new if the baseline is from before outcomes were kept.
TEST(CompareCases, OfAnOlderBaselineAreHeldAsFarAsTheyAreKnown) {
  using enum records::CaseOutcome;
  const records::BaselineSection now = with_outcomes({{1, violated}, {2, held}});
  records::BaselineSection older = now;
  older.laws[records::kSampleLaw].cases[{records::Origin::random, 1}].outcome = held;
  EXPECT_FALSE(are_outcomes_known(older, records::kSampleLaw));
  EXPECT_TRUE(are_outcomes_known(now, records::kSampleLaw));
  for (const records::Comparison& comparison : {compared(older, now), compared(now, older)}) {
    EXPECT_EQ(count_of(comparison, records::Change::same), 3U);
    EXPECT_EQ(comparison.changed_cases, 0U);
    EXPECT_THAT(comparison.growths, IsEmpty());
  }
  // If nothing was violated, all outcomes are known.
  EXPECT_TRUE(are_outcomes_known(records::sample_section(), records::kSampleLaw));
}

// Cases with wrong samples or values come before less precise ones, and then the larger growth
// comes first.
TEST(CompareCases, AreOrderedByGrowthAndLimited) {
  records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  const auto set = [](records::BaselineSection& section, std::uint64_t index, double error,
                      std::uint64_t mismatches) {
    records::CaseFigures& figures =
        section.laws[records::kSampleLaw].cases[{records::Origin::random, index}];
    figures.found_digest = section.laws[records::kSampleLaw].cases.size() + mismatches;
    figures.mismatches = mismatches;
    figures.worst[AttributeKind::depth][Stratum::ordinary] = records::sample_error(error);
  };
  for (std::uint64_t i = 0; i < 3; ++i) set(before, i, 0.25, 0);
  set(after, 0, 0.375, 0);
  set(after, 1, 0.5, 0);
  set(after, 2, 0.25, 1);
  const Result<records::Comparison> comparison = compare(before, after, {2});
  ASSERT_TRUE(comparison);
  ASSERT_THAT(comparison->growths, SizeIs(2));
  EXPECT_EQ(comparison->growths[0].index, 2U);
  EXPECT_FALSE(comparison->growths[0].after);
  EXPECT_EQ(comparison->growths[1].index, 1U);
  EXPECT_EQ(comparison->grown_cases, 3U);
}

// Kills: listing a case, or a kind of values of a case, first as the one that grew most, although
// its values may not have been judged before.
TEST(CompareCases, WithoutAnErrorBeforeComeAfterThoseWithOne) {
  records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  const auto figures = [](records::BaselineSection& section,
                          std::uint64_t index) -> records::CaseFigures& {
    return section.laws[records::kSampleLaw].cases[{records::Origin::random, index}];
  };
  for (const std::uint64_t index : {0U, 1U, 2U, 3U}) {
    figures(before, index).found_digest = 100;
    figures(after, index).found_digest = 200;
  }
  figures(after, 0).worst[AttributeKind::smooth][Stratum::ordinary] = records::sample_error(1000);
  figures(after, 1).worst = figures(after, 0).worst;
  figures(after, 1).worst[AttributeKind::flat][Stratum::ordinary] = records::sample_error(-2000);
  figures(before, 2).worst[AttributeKind::depth][Stratum::ordinary] = records::sample_error(0.25);
  figures(after, 2).worst = figures(after, 1).worst;
  figures(after, 2).worst[AttributeKind::depth][Stratum::ordinary] = records::sample_error(0.5);
  figures(after, 3).mismatches = 1;
  const records::Comparison comparison = compared(before, after);
  ASSERT_THAT(comparison.growths, SizeIs(4));
  EXPECT_EQ(comparison.growths[0].index, 3U);
  EXPECT_EQ(comparison.growths[1].index, 2U);
  EXPECT_EQ(comparison.growths[1].kind, AttributeKind::depth);
  EXPECT_EQ(comparison.growths[2].index, 1U);
  EXPECT_EQ(comparison.growths[2].kind, AttributeKind::flat);
  EXPECT_EQ(comparison.growths[3].index, 0U);
  // Each of them still counts as a growth.
  EXPECT_EQ(comparison.grown_cases, 4U);
}

TEST(CompareCases, OfTheCorpusHaveTheirNames) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  records::CaseFigures& figures =
      after.laws[records::kSampleLaw].cases[{records::Origin::corpus, 0}];
  figures.worst[AttributeKind::flat][Stratum::ordinary] = records::sample_error(1);
  const records::Comparison comparison = compared(before, after);
  ASSERT_THAT(comparison.growths, SizeIs(1));
  EXPECT_EQ(comparison.growths[0].name, "the \"first\" case");
  EXPECT_FALSE(comparison.growths[0].before);
}

// --- Stages --------------------------------------------------------------------------------------

// On average, set-up made 1/4 of an error of 1 before, and makes 2 of 3 now; rounding made 3/4
// before and makes 1 now.
TEST(CompareStages, NameTheOneWhosePartGrewMost) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  after.entries[records::kSampleSliver].stages = {{Stage::set_up, records::sample_sum(32, 4)},
                                                  {Stage::rounding, records::sample_sum(16, 4)}};
  const records::EntryChange entry = entry_of(compared(before, after), records::kSampleSliver);
  EXPECT_EQ(entry.grown_stage, Stage::set_up);
  ASSERT_THAT(entry.stages, SizeIs(2));
  EXPECT_TRUE(records::contains(*entry.stages[0].mean_before, 0.25));
  EXPECT_TRUE(records::contains(*entry.stages[0].mean_after, 2));
  EXPECT_NEAR(*entry.stages[0].share_before, 0.25, 0x1p-40);
  EXPECT_NEAR(*entry.stages[0].share_after, 2.0 / 3, 0x1p-40);
  EXPECT_EQ(entry_of(compared(after, before), records::kSampleSliver).grown_stage, std::nullopt);
  EXPECT_EQ(entry_of(compared(before, before), records::kSampleSliver).grown_stage, std::nullopt);
}

// Kills: comparing the parts of stages by size; snapping's part is by far the largest.
TEST(CompareStages, GrowByHowManyTimesLargerTheyAre) {
  records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  before.entries[records::kSampleSliver].stages = {{Stage::snap, records::sample_sum(4000, 4)},
                                                   {Stage::set_up, records::sample_sum(4, 4)}};
  after.entries[records::kSampleSliver].stages = {{Stage::snap, records::sample_sum(4400, 4)},
                                                  {Stage::set_up, records::sample_sum(8, 4)}};
  EXPECT_EQ(entry_of(compared(before, after), records::kSampleSliver).grown_stage, Stage::set_up);
  // A part that was 0 before has grown by a factor greater than any other.
  after.entries[records::kSampleSliver].stages[Stage::evaluation] = records::sample_sum(1, 4);
  EXPECT_EQ(entry_of(compared(before, after), records::kSampleSliver).grown_stage,
            Stage::evaluation);
}

// Kills: naming the error beyond the contract as a stage, for a backend that reports no stages.
TEST(CompareStages, AreOnlyThoseThatABackendTellsOf) {
  records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  before.entries[records::kSampleSliver].stages = {{Stage::excess, records::sample_sum(1, 4)},
                                                   {Stage::transform, records::sample_sum(1, 4)}};
  after.entries[records::kSampleSliver].stages = {{Stage::excess, records::sample_sum(8, 4)},
                                                  {Stage::transform, records::sample_sum(4, 4)}};
  const records::EntryChange entry = entry_of(compared(before, after), records::kSampleSliver);
  EXPECT_EQ(entry.grown_stage, std::nullopt);
  EXPECT_THAT(entry.stages, SizeIs(2));
  before.entries[records::kSampleSliver].stages[Stage::snap] = records::sample_sum(4, 4);
  after.entries[records::kSampleSliver].stages[Stage::snap] = records::sample_sum(4, 4);
  EXPECT_EQ(entry_of(compared(before, after), records::kSampleSliver).grown_stage,
            Stage::transform);
}

// --- Refusals ------------------------------------------------------------------------------------

TEST(CompareRefuses, AnythingElseThanTheSameCasesAndRules) {
  const records::BaselineSection before = records::sample_section();
  const auto with = [&before](const std::function<void(records::BaselineSection&)>& change) {
    records::BaselineSection after = before;
    change(after);
    return refusal(before, after);
  };
  EXPECT_EQ(with([](records::BaselineSection& s) { s.records_version = 1; }),
            "the version of records is 3 in the baseline and 1 now");
  EXPECT_EQ(with([](records::BaselineSection& s) { s.rules_version = 7; }),
            "the version of the rules is 1 in the baseline and 7 now");
  EXPECT_EQ(with([](records::BaselineSection& s) { s.plan.seed = 2; }),
            "the seed is 1 in the baseline and 2 now");
  EXPECT_EQ(with([](records::BaselineSection& s) { s.plan.cases_per_law = 21; }),
            "the number of cases per property is 20 in the baseline and 21 now");
  EXPECT_EQ(with([](records::BaselineSection& s) { s.plan.properties = {}; }),
            "the options are --property *values* in the baseline and none now");
  EXPECT_EQ(with([](records::BaselineSection& s) { s.laws[records::kSampleLaw].count = 24; }),
            "the property 'values are <within> bounds' has 23 cases in the baseline and 24 now");
  EXPECT_THAT(with([](records::BaselineSection& s) { s.laws[records::kSampleLaw].digest = 1; }),
              HasSubstr("their digest was 0123456789abcdef and is 0000000000000001"));
}

// Kills: identifying a contract by its path, so that a changed contract is compared with the old
// one.
TEST(CompareRefuses, WhatIsHeldToAnotherContract) {
  const auto with = [](const std::string& file, bool keeps_constants) {
    records::BaselineSection section = records::sample_section();
    section.plan.contract.emplace().file = file;
    section.plan.contract->terms.keeps_constants = keeps_constants;
    return section;
  };
  EXPECT_THAT(
      refusal(with("lax.json", true), with("lax.json", false)),
      testing::MatchesRegex("the contract is lax.json in the baseline and lax.json now, and "
                            "its terms differ: their digest was [0-9a-f]{16} and is "
                            "[0-9a-f]{16}"));
  EXPECT_EQ(refusal(with("lax.json", true), with("elsewhere/lax.json", true)), "");
  EXPECT_THAT(refusal(with("lax.json", true), records::sample_section()),
              HasSubstr("the contract is lax.json in the baseline and none now"));
}

TEST(CompareRefuses, OtherOptionsAboutKnownDefects) {
  records::BaselineSection after = records::sample_section();
  after.plan.ignores_known = true;
  EXPECT_EQ(refusal(records::sample_section(), after),
            "the options are --property *values* in the baseline and --property *values* "
            "--no-known now");
}

// Kills: comparing a version of the program, a commit or the corpus's folder.
TEST(CompareRefuses, NothingThatIsOnlyRecorded) {
  const records::BaselineSection before = records::sample_section();
  records::BaselineSection after = before;
  after.taken = {"plugin:x.so", "9.9", "other", "sse4", "Clang"};
  after.plan.corpus = "elsewhere";
  after.approvals.push_back({"why", "1", "2", {"3"}});
  EXPECT_EQ(refusal(before, after), "");
}

// Kills: a gate that passes because there was nothing to compare.
TEST(CompareRefuses, NothingAtAll) {
  EXPECT_EQ(to_string(compare(records::Baseline{{records::sample_section()}}, records::Baseline(),
                              {"b.json", "run.json"})
                          .error()),
            "run.json: has no sections, so there is nothing to compare");
}

TEST(CompareRefuses, KeysWithoutASectionInTheBaseline) {
  records::BaselineSection other = records::sample_section();
  other.key.architecture = "aarch64";
  const Result<std::vector<records::Comparison>> comparisons =
      compare(records::Baseline{{records::sample_section()}}, records::Baseline{{other}},
              {"b.json", "run.json"});
  ASSERT_FALSE(comparisons);
  EXPECT_EQ(to_string(comparisons.error()),
            "b.json: has no section for cpu on aarch64, avx2, GNU 12.2.0; it has sections for cpu "
            "on x86_64");
}

}  // namespace
}  // namespace rastercheck::gate::compare_test
