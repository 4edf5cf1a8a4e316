#include "reports/internal/wording.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace rastercheck::reports::wording_test {
namespace {

using records::Enclosure;
using records::LawSummary;
using records::LawVerdict;

TEST(Grouped, SeparatesThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(123456), "123,456");
  EXPECT_EQ(grouped(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
}

TEST(Counted, IsPluralButForOne) {
  EXPECT_EQ(counted(0, "case", "cases"), "0 cases");
  EXPECT_EQ(counted(1, "case", "cases"), "1 case");
  EXPECT_EQ(counted(2000, "case", "cases"), "2,000 cases");
}

TEST(NumberText, HasCertainDigitsOrADash) {
  EXPECT_EQ(number_text(std::nullopt), "–");
  EXPECT_EQ(number_text(Enclosure{0.5, 0.5}), "0.5");
  EXPECT_EQ(number_text(Enclosure{0.12345649, 0.12345651}), "0.12346");
}

// 2^(-9/8) = 0.45850202..., the border of a bucket. Kills: rounding to nearest, which gives 0.458
// or 0.459 by luck.
TEST(AtMostText, RoundsUp) {
  EXPECT_EQ(at_most_text(std::nullopt), "–");
  EXPECT_EQ(at_most_text(Enclosure{0, 0}), "0");
  EXPECT_EQ(at_most_text(Enclosure{0.25, 0.5}), "≤ 0.5");
  EXPECT_EQ(at_most_text(Enclosure{0.4, 0.4581}), "≤ 0.459");
  EXPECT_EQ(at_most_text(Enclosure{0.4, 0.9991}), "≤ 1");
  EXPECT_EQ(at_most_text(Enclosure{900, 1024}), "≤ 1.03e+03");
  EXPECT_EQ(at_most_text(Enclosure{0, 0x1p-20}), "≤ 9.54e-07");
  EXPECT_EQ(at_most_text(Enclosure{0x1p40, std::numeric_limits<double>::infinity()}), "> 1.1e+12");
}

RC_GTEST_PROP(AtMostText, IsNeverBelowAndNeverFarAbove, ()) {
  const auto bits = *rc::gen::inRange<int>(1, 1 << 30);
  const auto exponent = *rc::gen::inRange(-60, 60);
  const double value = std::ldexp(bits, exponent);
  const std::string text = at_most_text(Enclosure{0, value});
  const double shown = std::strtod(text.substr(std::string("≤ ").size()).c_str(), nullptr);
  RC_ASSERT(shown >= value);
  RC_ASSERT(shown <= value * 1.01);
}

// Kills: digits that are not certain; a bound rounded to nearest; showing the ends of an enclosure,
// with 17 digits, in a table.
TEST(MeanText, HasCertainDigitsOrABound) {
  EXPECT_EQ(mean_text(std::nullopt), "–");
  EXPECT_EQ(mean_text(Enclosure{0, 0}), "0");
  EXPECT_EQ(mean_text(Enclosure{-0.25, -0.25}), "-0.25");
  EXPECT_EQ(mean_text(Enclosure{0.123411, 0.123412}), "0.1234");
  EXPECT_EQ(mean_text(Enclosure{0.123411, 0.123491}), "0.123");
  EXPECT_EQ(mean_text(Enclosure{-4.61e-10, 2e-10}), "± 4.7e-10");
  EXPECT_EQ(mean_text(Enclosure{1.2e-10, 3.3e-10}), "± 3.3e-10");
}

TEST(PrecisionCells, AreInTheOrderOfTheColumns) {
  records::Precision precision;
  precision.values = 2000;
  precision.min = {-0.75, -0.75};
  precision.max = {0.5, 0.5};
  precision.mean = {0.125, 0.125};
  precision.p50 = {0, 0};
  precision.p99 = {0.4, 0.5};
  precision.p999 = {0.6, 0.7};
  precision.misrounded = 1;
  EXPECT_EQ(precision_cells(precision),
            (std::array<std::string, 8>{"2,000", "-0.75", "0.125", "0.5", "0", "≤ 0.5", "≤ 0.7",
                                        "0.05%"}));
  EXPECT_EQ(stratum_text(precision), "all");
  precision.stratum = records::Stratum::near_horizon;
  EXPECT_EQ(stratum_text(precision), "near horizon");
}

TEST(HasPrecision, IsTrueIfAnyRowHas) {
  LawSummary with;
  with.precision.emplace_back();
  EXPECT_FALSE(has_precision({}));
  EXPECT_FALSE(has_precision({LawSummary()}));
  EXPECT_TRUE(has_precision({LawSummary(), with}));
}

TEST(Elided, KeepsBothEnds) {
  EXPECT_EQ(elided("1234567890123456", 16), "1234567890123456");
  EXPECT_EQ(elided("1234567890-abcdefghij", 16), "12345678…defghij");
  // Seventeen characters of two bytes each.
  std::string text;
  for (int i = 0; i < 17; ++i) text += "é";
  EXPECT_EQ(elided(text, 17), text);
  EXPECT_EQ(elided(text, 16), "éééééééé…ééééééé");
}

LawSummary row_with(std::uint64_t checked, std::uint64_t violations) {
  LawSummary row;
  row.cases = {checked, 0, violations};
  row.verdict = violations > 0 ? LawVerdict::violated
                : checked > 0  ? LawVerdict::held
                               : LawVerdict::not_checked;
  return row;
}

/// A run of the rows' properties on one backend; each row has a property of its own.
records::Run run_of(std::vector<LawSummary>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].law = "law " + std::to_string(i);
    rows[i].backend = "cpu";
  }
  records::Run run;
  run.plan.backends = {"cpu"};
  return run;
}

std::string headline_of(std::vector<LawSummary> rows) {
  const records::Run run = run_of(rows);
  return headline(run, rows);
}

// Kills: "all held" although some were not checked.
TEST(Headline, CountsProperties) {
  EXPECT_EQ(headline_of({}), "Nothing was checked");
  EXPECT_EQ(headline_of({row_with(0, 0)}), "Nothing was checked");
  EXPECT_EQ(headline_of({row_with(3, 0), row_with(1, 0)}), "All 2 properties held");
  EXPECT_EQ(headline_of({row_with(3, 0), row_with(0, 0)}), "1 of 2 properties held");
  EXPECT_EQ(headline_of({row_with(3, 1), row_with(3, 0)}), "1 of 2 properties violated");
  LawSummary thin = row_with(3, 0);
  thin.verdict = LawVerdict::thin;
  EXPECT_EQ(headline_of({thin, row_with(0, 0)}), "1 of 2 properties held, on few cases");
}

// Kills: a property counted once for each backend, or by its best verdict.
TEST(Headline, CountsAPropertyOfSeveralBackendsOnce) {
  records::Run run;
  run.plan.backends = {"cpu", "gl"};
  run.causes.resize(3);
  std::vector<LawSummary> rows{row_with(3, 1), row_with(3, 0), row_with(3, 0), row_with(3, 0)};
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].law = i < 2 ? "first" : "second";
  EXPECT_EQ(headline(run, rows), "1 of 2 properties violated, 3 causes");
  std::swap(rows[0], rows[1]);
  EXPECT_EQ(headline(run, rows), "1 of 2 properties violated, 3 causes");
}

// Kills: a green headline although most properties were not checked, or defects are known.
TEST(Mood, IsGoodOnlyIfMostHeld) {
  EXPECT_EQ(mood_of({row_with(3, 0), row_with(3, 0), row_with(0, 0)}), Mood::good);
  EXPECT_EQ(mood_of({row_with(3, 0), row_with(0, 0)}), Mood::mixed);
  EXPECT_EQ(mood_of({row_with(0, 0)}), Mood::mixed);
  EXPECT_EQ(mood_of({row_with(3, 0), row_with(3, 1)}), Mood::bad);
}

// Kills: counting a driver's known defects as held, or as violations.
TEST(Headline, TellsKnownDefects) {
  LawSummary known = row_with(3, 0);
  known.cases.known = 2;
  known.verdict = LawVerdict::known;
  EXPECT_EQ(headline_of({known, row_with(3, 0)}),
            "Nothing new: 1 property violated in 0 known ways");
  EXPECT_EQ(headline_of({known, row_with(3, 1), row_with(0, 0)}), "1 of 3 properties violated");
  EXPECT_EQ(mood_of({known, row_with(3, 0), row_with(3, 0)}), Mood::mixed);
  EXPECT_EQ(verdict_text(known), "known in 2 cases");
  EXPECT_EQ(verdict_text(row_with(3, 1)), "violated in 1 case");
  EXPECT_EQ(verdict_text(row_with(3, 0)), "held");
}

TEST(Totals, AddsRows) {
  LawSummary row = row_with(3, 1);
  row.judged.fragments = 10;
  row.counts = {1, 2, 3, 4};
  row.levels = {{1, 2, 3}, {4, 5, 6}};
  const LawSummary total = totals({row, row, row_with(5, 0)});
  EXPECT_EQ(total.cases, (records::CaseCounts{11, 0, 2}));
  EXPECT_EQ(total.judged.fragments, 20U);
  EXPECT_EQ(total.counts, (records::Counts{2, 4, 6, 8}));
  EXPECT_EQ(total.levels, (records::Levels{{2, 4, 6}, {8, 10, 12}}));
  EXPECT_EQ(total.verdict, LawVerdict::violated);
}

}  // namespace
}  // namespace rastercheck::reports::wording_test
