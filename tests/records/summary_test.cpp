#include "records/summary.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace rastercheck::records::summary_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

WorstError worst(const Enclosure& error, std::uint64_t case_index = 0) {
  WorstError worst;
  worst.error = error;
  worst.case_index = case_index;
  return worst;
}

Record with_ideal(const std::vector<Enclosure>& errors) {
  Record record;
  for (const Enclosure& error : errors) {
    record.errors.ideal.histogram.add(magnitude_bound(error));
    keep(record.errors.ideal.extremes, worst(error));
    record.errors.ideal.sum.add(error);
  }
  return record;
}

Run small_run() {
  records::Run run;
  run.plan.laws = {"b", "a"};
  run.plan.backends = {"gl", "cpu"};
  return run;
}

LawSummary summary_of(const RecordSet& records) {
  records::Run run;
  run.plan.laws = {"law"};
  run.plan.backends = {"cpu"};
  run.records = records;
  return summarize(run).front();
}

// Kills: counting defects of one law or stratum only; adding up different backends.
TEST(PowerByBackend, AddsUpLawsAndStrata) {
  records::Run run = small_run();
  const auto power_of = [&run](const char* law, const char* backend, const char* stratum) -> auto& {
    return run.records[{law, backend, AttributeKind::coverage, stratum}].power;
  };
  power_of("a", "cpu", "grid")[Defect::crack] = {3, 1};
  power_of("a", "cpu", "sliver")[Defect::crack] = {1, 1};
  power_of("b", "cpu", "grid")[Defect::values_nan] = {2, 2};
  const auto all = power_by_backend(summarize(run));
  EXPECT_EQ(all, (std::map<std::string, Power>{
                     {"cpu", {{Defect::crack, {4, 2}}, {Defect::values_nan, {2, 2}}}}}));
}

// Kills: the order of the records, which is alphabetical.
TEST(Summarize, HasARowForEveryLawAndBackendInTheOrderOfTheRun) {
  std::vector<std::string> order;
  for (const LawSummary& row : summarize(small_run())) order.push_back(row.law + row.backend);
  EXPECT_EQ(order, (std::vector<std::string>{"bgl", "bcpu", "agl", "acpu"}));
  EXPECT_TRUE(summarize({}).empty());
}

TEST(Summarize, TakesTheRecordsOfItsLawAndBackend) {
  records::Run run = small_run();
  run.records[{"a", "cpu", AttributeKind::coverage, ""}].cases = {5, 0, 1};
  run.records[{"b", "gl", AttributeKind::coverage, ""}].cases = {7, 0, 0};
  run.records[{"c", "gl", AttributeKind::coverage, ""}].cases = {100, 0, 100};
  std::vector<std::uint64_t> checked;
  for (const LawSummary& row : summarize(run)) checked.push_back(row.cases.checked);
  EXPECT_EQ(checked, (std::vector<std::uint64_t>{7, 0, 0, 5}));
}

TEST(Summarize, AddsStrata) {
  RecordSet records;
  Record& one = records[{"law", "cpu", AttributeKind::coverage, "grid"}];
  one.cases = {5, 1, 2};
  one.counts = {1, 2, 3, 4};
  one.labels = {{"tie", 3}};
  Record& other = records[{"law", "cpu", AttributeKind::coverage, "sliver"}];
  other.cases = {50, 10, 20};
  other.counts = {10, 20, 30, 40};
  other.labels = {{"tie", 1}, {"clipped", 2}};
  const LawSummary row = summary_of(records);
  EXPECT_EQ(row.cases, (CaseCounts{55, 11, 22}));
  EXPECT_EQ(row.counts, (Counts{11, 22, 33, 44}));
  EXPECT_EQ(row.labels, (std::map<std::string, std::uint64_t>{{"clipped", 2}, {"tie", 4}}));
}

// A fragment has several values but is counted once. Kills: counting values as fragments.
TEST(Summarize, CountsFragmentsByTheirCoverage) {
  RecordSet records;
  for (const AttributeKind kind : {AttributeKind::coverage, AttributeKind::smooth}) {
    ClassCounts& classes = records[{"law", "cpu", kind, ""}].errors.classes;
    classes[FragmentClass::correct] = 10;
    classes[FragmentClass::missing] = 3;
  }
  const LawSummary row = summary_of(records);
  EXPECT_EQ(row.judged.fragments, 13U);
  EXPECT_EQ(row.classes[FragmentClass::correct], 20U);
  EXPECT_EQ(row.classes[FragmentClass::missing], 6U);
}

// Kills: a law on values that holds although none of them was judged.
TEST(Summarize, HoldsOnlyWhereSomethingWasJudged) {
  RecordSet records;
  Record& coverage = records[{"law", "cpu", AttributeKind::coverage, ""}];
  coverage.cases = {1, 0, 0};
  coverage.errors.classes[FragmentClass::correct] = 10;
  EXPECT_EQ(summary_of(records).verdict, LawVerdict::held);
  Record& depth = records[{"law", "cpu", AttributeKind::depth, ""}];
  depth.errors.not_judged[NotJudged::without_bound] = 10;
  EXPECT_EQ(summary_of(records).verdict, LawVerdict::not_checked);
  depth.errors.classes[FragmentClass::correct] = 1;
  EXPECT_EQ(summary_of(records).verdict, LawVerdict::held);
  coverage.errors.not_judged[NotJudged::not_promised] = 10;
  EXPECT_EQ(summary_of(records).verdict, LawVerdict::not_checked);
}

TEST(Summarize, TheWorstIsTheLargestMagnitudeOfAllKinds) {
  RecordSet records;
  records[{"law", "cpu", AttributeKind::depth, ""}] = with_ideal({{0.25, 0.25}, {-0.5, -0.5}});
  records[{"law", "cpu", AttributeKind::smooth, "grid"}] = with_ideal({{-3.5, -3.25}});
  records[{"law", "cpu", AttributeKind::smooth, "sliver"}] = with_ideal({{2, 2}});
  records[{"law", "cpu", AttributeKind::flat, ""}] = with_ideal({{0, 0}});
  const LawSummary row = summary_of(records);
  EXPECT_EQ(row.ideal.values, 5U);
  EXPECT_EQ(row.ideal.worst, (Enclosure{3.25, 3.5}));
  EXPECT_EQ(row.ideal.worst_at->error, (Enclosure{-3.5, -3.25}));
  EXPECT_EQ(row.excess.values, 0U);
  EXPECT_FALSE(row.excess.worst.has_value());
  EXPECT_FALSE(row.excess.p99.has_value());
}

TEST(Summarize, TheWorstMayBeOnEitherSideOrUnbounded) {
  const auto worst_of = [](const std::vector<Enclosure>& errors) {
    return summary_of({{{"law", "cpu", AttributeKind::depth, ""}, with_ideal(errors)}})
        .ideal.worst.value();
  };
  EXPECT_EQ(worst_of({{0.5, 0.5}, {-0.25, -0.25}}), (Enclosure{0.5, 0.5}));
  EXPECT_EQ(worst_of({{-0.25, 0.5}}), (Enclosure{0, 0.5}));
  EXPECT_EQ(worst_of({{1, kInfinity}, {2, 2}}), (Enclosure{1, kInfinity}));
  EXPECT_EQ(worst_of({{0, 0}}), (Enclosure{0, 0}));
}

// 99 of 100 values are 1/4, so the 99th is 1/4. With one value more, it is not. Kills: quantiles of
// a single stratum.
TEST(Summarize, P99IsOfAllKindsAndStrata) {
  RecordSet records;
  const std::size_t quarter = Histogram::bucket_of(0.25);
  records[{"law", "cpu", AttributeKind::depth, ""}].errors.ideal.histogram.add_to_bucket(quarter,
                                                                                         60);
  records[{"law", "cpu", AttributeKind::smooth, "a"}].errors.ideal.histogram.add_to_bucket(quarter,
                                                                                           39);
  Histogram& last = records[{"law", "cpu", AttributeKind::smooth, "b"}].errors.ideal.histogram;
  last.add(8);
  EXPECT_EQ(summary_of(records).ideal.p99, Histogram::borders(quarter));
  last.add(8);
  EXPECT_EQ(summary_of(records).ideal.p99, Histogram::borders(Histogram::bucket_of(8)));
}

// Kills: mixing kinds or strata; the mean of magnitudes; counting 1/2 as misrounded.
TEST(Summarize, PrecisionIsByKindAndStratum) {
  RecordSet records;
  Record depth = with_ideal({{-0.5, -0.5}, {0.25, 0.25}, {0.75, 0.75}, {0.5, 0.5}});
  depth.errors.strata[Stratum::ordinary] = depth.errors.ideal;
  depth.errors.strata[Stratum::clipped] = with_ideal({{0, 0}}).errors.ideal;
  merge(depth.errors.ideal, depth.errors.strata[Stratum::clipped]);
  records[{"law", "cpu", AttributeKind::depth, "a"}] = depth;
  records[{"law", "cpu", AttributeKind::depth, "b"}] = with_ideal({{-3, -3}});
  records[{"law", "cpu", AttributeKind::smooth, "a"}] = Record();
  const std::vector<Precision> rows = summary_of(records).precision;

  ASSERT_EQ(rows.size(), 3U);
  const Precision& all = rows[0];
  EXPECT_EQ(all.kind, AttributeKind::depth);
  EXPECT_EQ(all.stratum, std::nullopt);
  EXPECT_EQ(all.values, 6U);
  EXPECT_EQ(all.min, (Enclosure{-3, -3}));
  EXPECT_EQ(all.max, (Enclosure{0.75, 0.75}));
  EXPECT_TRUE(contains(all.mean.value(), -2.0 / 6));
  EXPECT_EQ(all.p50, Histogram::borders(Histogram::bucket_of(0.5)));
  EXPECT_EQ(all.p99, Histogram::borders(Histogram::bucket_of(3)));
  EXPECT_EQ(all.p999, Histogram::borders(Histogram::bucket_of(3)));
  EXPECT_EQ(all.misrounded, 2U);

  EXPECT_EQ(rows[1].stratum, Stratum::clipped);
  EXPECT_EQ(rows[1].values, 1U);
  EXPECT_EQ(rows[1].min, (Enclosure{0, 0}));
  EXPECT_EQ(rows[1].max, (Enclosure{0, 0}));
  EXPECT_EQ(rows[1].mean, (Enclosure{0, 0}));
  EXPECT_EQ(rows[1].misrounded, 0U);

  EXPECT_EQ(rows[2].stratum, Stratum::ordinary);
  EXPECT_EQ(rows[2].min, (Enclosure{-0.5, -0.5}));
  EXPECT_TRUE(contains(rows[2].mean.value(), 0.25));
  EXPECT_EQ(rows[2].misrounded, 1U);
}

// Kills: showing the mean of the values that happen to be summed as the mean of all.
TEST(Summarize, OfValuesThatAreNotAllSummedThereIsNoMean) {
  Record old = with_ideal({{1, 1}});
  old.errors.ideal.histogram.add(2);
  Record large = with_ideal({{1, 1}, {0x1p41, 0x1p41}});
  for (const Record& record : {old, large}) {
    const auto rows = summary_of({{{"law", "cpu", AttributeKind::flat, ""}, record}}).precision;
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].values, 2U);
    EXPECT_EQ(rows[0].mean, std::nullopt);
  }
}

TEST(Summarize, MeansOfStagesAreByKindAndStratum) {
  Record record;
  auto& stages = record.errors.stages;
  stages[Stratum::sliver][Stage::set_up].add({3, 3});
  stages[Stratum::ordinary][Stage::set_up].add({1, 1});
  stages[Stratum::ordinary][Stage::set_up].add({0.5, 0.5});
  stages[Stratum::ordinary][Stage::rounding].add({0x1p41, 0x1p41});
  RecordSet records;
  records[{"law", "cpu", AttributeKind::smooth, "a"}] = record;
  const LawSummary summary = summary_of(records);
  ASSERT_EQ(summary.stages.size(), 5U);
  const auto expect_row = [&](std::size_t i, std::optional<Stratum> stratum, Stage stage,
                              std::uint64_t values, std::optional<double> mean) {
    const StageMean& row = summary.stages[i];
    EXPECT_EQ(row.kind, AttributeKind::smooth);
    EXPECT_EQ(row.stratum, stratum) << i;
    EXPECT_EQ(row.stage, stage) << i;
    EXPECT_EQ(row.values, values) << i;
    EXPECT_EQ(row.mean.has_value(), mean.has_value()) << i;
    if (row.mean && mean) {
      EXPECT_TRUE(contains(*row.mean, *mean)) << i;
      EXPECT_LT(row.mean->hi - row.mean->lo, 0x1p-40) << i;
    }
  };
  expect_row(0, std::nullopt, Stage::set_up, 3, 1.5);
  expect_row(1, std::nullopt, Stage::rounding, 1, std::nullopt);
  expect_row(2, Stratum::sliver, Stage::set_up, 1, 3);
  expect_row(3, Stratum::ordinary, Stage::set_up, 2, 0.75);
  expect_row(4, Stratum::ordinary, Stage::rounding, 1, std::nullopt);
}

TEST(Summarize, AddsLevels) {
  RecordSet records;
  Judgement judgement;
  judgement.levels = {{1, 2, 3}, {4, 5, 6}};
  add(records, {"law", "cpu", AttributeKind::coverage, "a"}, judgement);
  add(records, {"law", "cpu", AttributeKind::coverage, "b"}, judgement);
  EXPECT_EQ(summary_of(records).levels, (Levels{{2, 4, 6}, {8, 10, 12}}));
}

// Kills: treating a law as held that was not checked, or checked on nothing.
TEST(Summarize, VerdictsAreThreeValued) {
  const auto verdict_with = [](const CaseCounts& cases, std::uint64_t correct = 5) {
    Record record;
    record.cases = cases;
    record.errors.classes[FragmentClass::correct] = correct;
    return summary_of({{{"law", "cpu", AttributeKind::coverage, ""}, record}}).verdict;
  };
  EXPECT_EQ(verdict_with({0, 0, 0}, 0), LawVerdict::not_checked);
  EXPECT_EQ(verdict_with({0, 9, 0}, 0), LawVerdict::not_checked);
  EXPECT_EQ(verdict_with({9, 0, 0}, 0), LawVerdict::not_checked);
  EXPECT_EQ(verdict_with({9, 0, 1}, 0), LawVerdict::violated);
  EXPECT_EQ(verdict_with({9, 0, 0}), LawVerdict::held);
  EXPECT_EQ(verdict_with({9, 0, 1}), LawVerdict::violated);
  EXPECT_EQ(verdict_with({9, 0, 0, 2}), LawVerdict::known);
  EXPECT_EQ(verdict_with({9, 0, 1, 2}), LawVerdict::violated);
  EXPECT_EQ(summary_of({}).verdict, LawVerdict::not_checked);
}

// Kills: treating a law as held that has not tested what it claims to test.
TEST(Summarize, TakesUnreachedLabelsForThin) {
  const auto verdict_with = [](std::uint64_t violations, const std::string& backend) {
    records::Run run;
    run.plan.laws = {"law"};
    run.plan.backends = {"cpu"};
    Record record;
    record.cases = {9, 0, violations};
    record.errors.classes[FragmentClass::correct] = 5;
    run.records[{"law", "cpu", AttributeKind::coverage, ""}] = record;
    run.unreached = {{"law", backend, "tie", 1, 4, 9}};
    return summarize(run).front().verdict;
  };
  EXPECT_EQ(verdict_with(0, "cpu"), LawVerdict::thin);
  EXPECT_EQ(verdict_with(1, "cpu"), LawVerdict::violated);
  EXPECT_EQ(verdict_with(0, "another"), LawVerdict::held);
}

/// A run of one law on `cpu`, which held on `checked` of the `asked` cases.
records::Run run_of(std::uint64_t checked, std::uint64_t asked) {
  records::Run run;
  run.plan.laws = {"law"};
  run.plan.backends = {"cpu"};
  Record record;
  record.cases = {checked, asked - checked};
  record.errors.classes[FragmentClass::correct] = 5;
  run.records[{"law", "cpu", AttributeKind::coverage, ""}] = record;
  return run;
}

// Kills: "held" for a law that was judged on 2 cases of 1,000.
TEST(Summarize, TakesFewCasesForThin) {
  const auto verdict_of = [](std::uint64_t checked, std::uint64_t asked) {
    return summarize(run_of(checked, asked)).front().verdict;
  };
  EXPECT_EQ(verdict_of(2, 1000), LawVerdict::thin);
  EXPECT_EQ(verdict_of(19, 1000), LawVerdict::thin);
  EXPECT_EQ(verdict_of(20, 1000), LawVerdict::held);
  EXPECT_EQ(verdict_of(199, 10'000), LawVerdict::thin);  // 2%
  EXPECT_EQ(verdict_of(200, 10'000), LawVerdict::held);
  EXPECT_EQ(verdict_of(7, 7), LawVerdict::held);  // no more cases were asked for
  EXPECT_EQ(verdict_of(6, 7), LawVerdict::thin);
  EXPECT_EQ(thin_sentence(summarize(run_of(2, 1000))), "1 property held on fewer than 20 cases");
  EXPECT_EQ(thin_sentence(summarize(run_of(20, 1000))), "");
  EXPECT_EQ(thin_words(summarize(run_of(2, 1000)).front()), "2 of 1000 cases");
}

TEST(Summarize, TakesFewerCasesThanRequiredForThin) {
  records::Run run = run_of(99, 1000);
  run.plan.require_cases = 100;
  EXPECT_EQ(summarize(run).front().verdict, LawVerdict::thin);
  EXPECT_EQ(thin_sentence(summarize(run)), "1 property held on fewer than 100 cases");
  run.plan.require_cases = 99;
  EXPECT_EQ(summarize(run).front().verdict, LawVerdict::held);
}

TEST(WhyNotChecked, IsWhatHoldsOfMostCases) {
  LawSummary row;
  EXPECT_EQ(why_not_checked(row), "");
  row.not_applicable_because = {{"a", 1}, {"b", 3}, {"c", 2}};
  EXPECT_EQ(why_not_checked(row), "b");
  row.cases.checked = 1;
  EXPECT_EQ(why_not_checked(row), "");
}

TEST(KnownDefects, CountTheCasesOfAllLaws) {
  records::Run run;
  KnownOfBackend known{"gl", "known.json", "1", {KnownDriver{"driver", "1"}, {{}, {}, {}}}};
  for (std::size_t i = 0; i < 3; ++i) known.list.entries[i].id = "driver-" + std::to_string(i);
  run.known = {known};
  run.unexpected = {{"gl", "driver-2", "law", Staleness::wrong_list}};
  for (const char* law : {"law", "another"}) {
    run.records[{law, "gl", AttributeKind::coverage, ""}].known = {{"driver-1", 2}};
    run.records[{law, "cpu", AttributeKind::coverage, ""}].known = {{"driver-0", 7}};
  }
  const std::vector<KnownSummary> all = known_defects(run);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].cases, 0U);  // on another backend
  EXPECT_EQ(all[1].cases, 4U);
  EXPECT_FALSE(all[1].is_passed);
  EXPECT_TRUE(all[2].is_passed);
}

TEST(VerdictOf, IsThatOfAllRows) {
  LawSummary held;
  held.cases = {3, 0, 0};
  held.verdict = LawVerdict::held;
  LawSummary violated;
  violated.cases = {3, 0, 1};
  violated.verdict = LawVerdict::violated;
  EXPECT_EQ(verdict_of({}), LawVerdict::not_checked);
  EXPECT_EQ(verdict_of({LawSummary()}), LawVerdict::not_checked);
  EXPECT_EQ(verdict_of({LawSummary(), held}), LawVerdict::held);
  EXPECT_EQ(verdict_of({held, violated, held}), LawVerdict::violated);
  LawSummary known;
  known.verdict = LawVerdict::known;
  EXPECT_EQ(verdict_of({LawSummary(), known}), LawVerdict::known);
  EXPECT_EQ(verdict_of({held, known}), LawVerdict::held);
  EXPECT_EQ(verdict_of({violated, known}), LawVerdict::violated);
}

TEST(LawVerdict, HasWords) {
  EXPECT_EQ(to_string(LawVerdict::held), "held");
  EXPECT_EQ(to_string(LawVerdict::violated), "violated");
  EXPECT_EQ(to_string(LawVerdict::known), "known");
  EXPECT_EQ(to_string(LawVerdict::not_checked), "not checked");
}

}  // namespace
}  // namespace rastercheck::records::summary_test
