#include "reports/summary_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::summary_table_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A law whose p99 lies in a bucket that ends just above 0.4585.
records::LawSummary row() {
  records::LawSummary row;
  row.law = "constants-stay-constant";
  row.backend = "cpu";
  row.cases = {12, 3, 1};
  row.judged.fragments = 1000;
  row.judged.not_judged["left free"] = 250;
  row.counts = {1, 2, 3, 4};
  row.levels.samples = {3, 1, 0};
  row.ideal.worst = {0.5, 0.5};
  row.ideal.p99 = {0.4204482076268573, 0.4585020216023356};
  row.verdict = records::LawVerdict::violated;
  return row;
}

// Kills: an upper bound that is rounded down.
TEST(SummaryTable, HasARowForEachLawAndBackend) {
  EXPECT_EQ(summary_table({row()}, true, {}),
            "constants-stay-constant  cpu  12  1000  20%  0.5  ≤ 0.459  –  violated\n");
  EXPECT_THAT(summary_table({row()}, false, {}), StartsWith("property  "));
}

TEST(NotableRows, LeaveOutWhatHeld) {
  std::vector<records::LawSummary> rows(5, row());
  rows[0].verdict = records::LawVerdict::held;
  rows[1].verdict = records::LawVerdict::not_checked;
  rows[2].verdict = records::LawVerdict::known;
  rows[3].verdict = records::LawVerdict::thin;
  const std::vector<records::LawSummary> notable = notable_rows(rows);
  ASSERT_EQ(notable.size(), 3U);
  EXPECT_EQ(notable[0].verdict, records::LawVerdict::known);
  EXPECT_EQ(notable[1].verdict, records::LawVerdict::thin);
  EXPECT_EQ(notable[2].verdict, records::LawVerdict::violated);
}

// Kills: laws or causes of one backend counted for another.
TEST(VerdictLines, CountLawsOfEachBackend) {
  records::Run run;
  run.plan.backends = {"cpu", "gl:softpipe", "unasked"};
  run.causes.resize(3);
  for (records::Cause& cause : run.causes) cause.backend = "gl:softpipe";
  run.causes[0].backend = "cpu";
  std::vector<records::LawSummary> rows(6, row());
  for (records::LawSummary& one : rows) one.backend = "gl:softpipe";
  rows[0].backend = "cpu";
  rows[1].verdict = records::LawVerdict::held;
  rows[2].verdict = records::LawVerdict::known;
  rows[3].verdict = records::LawVerdict::not_checked;
  EXPECT_EQ(verdict_lines(run, rows, false),
            "cpu: 1 property violated (1 cause).\n"
            "gl:softpipe: 2 properties violated (2 causes), 1 violated in known ways only, 1 held, "
            "1 not checked.\n");
  run.plan.backends = {"cpu"};
  EXPECT_EQ(verdict_lines(run, rows, true),
            "cpu: \x1b[1m\x1b[31m1 property violated (1 cause)\x1b[0m.\n");
}

TEST(KnownText, CountsTheCasesOfWhatWasSeen) {
  records::Run run = sample_run();
  EXPECT_EQ(known_text(run), "");
  add_known_defects(run);
  EXPECT_EQ(known_text(run), "Known defects of cpu: driver-1 in 3 cases.\n");
}

TEST(NotJudgedText, AddsUpLawsOfABackend) {
  EXPECT_EQ(
      not_judged_text({row(), row()}),
      "Not judged on cpu: 20% of the fragments and values of all properties, 500 left free.\n");
  records::LawSummary all = row();
  all.judged.not_judged.clear();
  EXPECT_EQ(not_judged_text({all}), "");
}

TEST(PowerText, AddsUpLawsOfABackend) {
  EXPECT_EQ(power_text({row()}), "");
  records::LawSummary some = row();
  some.power = {{records::Defect::crack, {900, 4}}, {records::Defect::values_nan, {200, 200}}};
  EXPECT_EQ(power_text({row(), some}),
            "Made wrong on purpose on cpu: 1,100 drawings, 204 noticed.\n");
}

TEST(NotCheckedText, GathersLawsByReason) {
  records::LawSummary none;
  none.law = "a law";
  none.backend = "cpu";
  none.not_applicable_because = {{"there is no camera", 3}};
  records::LawSummary other = none;
  other.law = "another";
  EXPECT_EQ(not_checked_text({row(), none, other}),
            "Properties that held on few cases, or none:\n"
            "backend  cases  not judged, as      properties\n"
            "cpu      3      there is no camera  a law; another\n");
  EXPECT_EQ(not_checked_text({row()}), "");
}

TEST(SummaryCounts, AddUpAllRows) {
  const std::string text = summary_counts({row(), row()});
  EXPECT_THAT(text, StartsWith("Samples: 2 required, 4 forbidden, 6 permitted, 8 undecided.\n"));
  EXPECT_THAT(text, HasSubstr("Samples decided: "));
  EXPECT_EQ(summary_counts({}), "Samples: 0 required, 0 forbidden, 0 permitted, 0 undecided.\n");
}

// Kills: leaving out an infinite end, which JSON cannot express as a number.
TEST(SummaryJson, HasTheEndsOfEnclosures) {
  records::LawSummary infinite = row();
  infinite.ideal.p99 = {0x1p40, std::numeric_limits<double>::infinity()};
  const json law = json::parse(summary_json(sample_run(), {infinite})).at("properties").at(0);
  EXPECT_EQ(law.at("ideal_error").at("worst"), (json{0.5, 0.5}));
  EXPECT_EQ(law.at("ideal_error").at("p99"), (json{0x1p40, "inf"}));
  EXPECT_EQ(law.at("beyond_contract").at("worst"), nullptr);
  EXPECT_EQ(law.at("violations"), 1);
  EXPECT_EQ(law.at("verdict"), "violated");
}

TEST(SummaryJson, HasPrecisionByKindAndStratum) {
  const records::Run run = sample_run();
  const json document = json::parse(summary_json(run, records::summarize(run)));
  EXPECT_EQ(document.at("seed"), run.plan.seed);
  const json precision = document.at("properties").at(0).at("precision");
  ASSERT_EQ(precision.size(), 3U);
  EXPECT_EQ(precision.at(0).at("stratum"), nullptr);
  // Certified ends are doubles, rounded outwards.
  const json mean = precision.at(0).at("mean");
  EXPECT_LE(mean.at(0), 0.125);
  EXPECT_GE(mean.at(1), 0.125);
  EXPECT_LT(mean.at(1).get<double>() - mean.at(0).get<double>(), 0x1p-50);
  EXPECT_EQ(precision.at(1).at("kind"), "smooth");
  EXPECT_EQ(precision.at(1).at("stratum"), "near horizon");
}

TEST(SummaryJson, HasBackendsSideBySide) {
  records::Run run = sample_run();
  const auto document = [&run] { return json::parse(summary_json(run, records::summarize(run))); };
  const json pairs = document().at("side_by_side");
  ASSERT_EQ(pairs.size(), 1U);
  const json& pair = pairs.at(0);
  EXPECT_EQ(pair.at("first"), "cpu");
  EXPECT_EQ(pair.at("second"), "method:float32");
  EXPECT_EQ(pair.at("same_cases"), 56);
  EXPECT_EQ(pair.at("both_right"), 52);
  EXPECT_EQ(pair.at("only_first_right"), 3);
  EXPECT_EQ(pair.at("only_second_right"), 0);
  EXPECT_EQ(pair.at("neither_right"), 1);
  EXPECT_EQ(pair.at("known_second"), 1);
  EXPECT_EQ(pair.at("properties").at(run.plan.laws[1]).at("only_first_right"), 3);
  run.outcomes.reset();
  EXPECT_FALSE(document().contains("side_by_side"));
}

}  // namespace
}  // namespace rastercheck::reports::summary_table_test
