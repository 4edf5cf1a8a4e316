#include "reports/compare_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/annotations.h"
#include "tests/records/sample_look.h"
#include "tests/reports/sample_gate.h"

namespace rastercheck::reports::compare_text_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(ComparisonText, NamesWhatIsWorseWhereAndInWhichStage) {
  EXPECT_EQ(comparison_text(sample_gate(), false),
            "Regression: 2 of 3 entries worse than the baseline of cpu on x86_64; 1 the same.\n"
            "1 of 23 cases drew different bits; errors grew in 1.\n\n"
            "Worse:\n"
            "  values are <within> bounds: smooth\n"
            "    cases that grew 0 → 1\n"
            "  values are <within> bounds: smooth, sliver\n"
            "    worst 0.625 → 0.75 ULP\n"
            "    cases that grew 0 → 1\n\n"
            "Cases whose errors grew most:\n"
            "  values are <within> bounds:\n"
            "    random case 12\n"
            "    smooth, sliver, triangle 0, pixel (3, 5), sample 0, attribute 0\n"
            "    error 0.625 → 0.75 ULP\n"
            "    exact 1/3 (about 0.333333333)\n"
            "    now   0.5 (0x1p-1)\n"
            "    then  0.25 (0x1p-2)\n"
            "    rastercheck replay out/grown/values-are--within--bounds-cpu-random-12.json\n"
            "    rastercheck explain out/grown/values-are--within--bounds-cpu-random-12.json "
            "--pixel 3,5 --sample 0 --triangle 0\n\n"
            "Stages whose part of the errors grew most:\n"
            "  smooth, sliver: set-up, mean 0.25 → 1.25 ULP, 25% → 62.5% of all parts\n\n"
            "If this change is intended, accept the new numbers:\n"
            "  rastercheck baseline approve --reason '…' b.json out/run.json\n");
}

TEST(ComparisonText, SaysWhatBecameOfACase) {
  records::BaselineSection after = records::sample_section();
  after.laws[records::kSampleLaw].cases[records::kSampleCase].outcome =
      records::CaseOutcome::violated;
  after.entries[records::kSampleCoverage].cases.violations = 1;
  EXPECT_THAT(comparison_text(gate_of(records::sample_section(), after), false),
              AllOf(HasSubstr("coverage\n    violations 0 → 1\n    cases that grew 0 → 1\n"),
                    HasSubstr("\n    random case 12\n    outcome: held → violated\n")));
}

TEST(ComparisonText, IsShortWhereQuiet) {
  EXPECT_EQ(comparison_text(sample_gate(), true),
            "Regression: 2 of 3 entries worse than the baseline of cpu on x86_64; 1 the same.\n"
            "\n"
            "Worse:\n"
            "  values are <within> bounds: smooth\n"
            "    cases that grew 0 → 1\n"
            "  values are <within> bounds: smooth, sliver\n"
            "    worst 0.625 → 0.75 ULP\n"
            "    cases that grew 0 → 1\n");
}

TEST(ComparisonText, OfTheSameSaysSoAndNothingElse) {
  EXPECT_EQ(comparison_text(gate_of(records::sample_section(), records::sample_section()), false),
            "No regression: 3 entries compared with the baseline of cpu on x86_64; 3 the same.\n"
            "All 23 cases drew the same bits.\n");
}

TEST(ComparisonText, AsksToTightenTheBaseline) {
  const std::string text =
      comparison_text(gate_of(sample_grown_section(), records::sample_section()), false);
  EXPECT_THAT(text,
              AllOf(HasSubstr("No regression: 3 entries compared"), HasSubstr("; 1 better, 2"),
                    HasSubstr("\nBetter:\n  values are <within> bounds: smooth, sliver\n"
                              "    worst 0.75 → 0.625 ULP\n"),
                    HasSubstr("To hold later runs to the new numbers, accept them"),
                    Not(HasSubstr("grew most"))));
}

TEST(ComparisonText, SaysWhatAPolicyAllows) {
  Gate gate = sample_gate();
  for (const std::size_t worse : {1U, 2U}) {
    gate.comparisons[0].entries[worse].allowed_because = "known (until 2026-12-31)";
  }
  gate.policy = {{"p.json: /allow/1 expired"}, {"p.json: /allow/2 unused"}};
  const std::string text = comparison_text(gate, false);
  EXPECT_THAT(text, AllOf(HasSubstr("No regression: 3 entries compared"),
                          HasSubstr("2 worse, but allowed"), HasSubstr("\nWorse, but allowed:\n"),
                          HasSubstr("    allowed: known (until 2026-12-31)\n"),
                          HasSubstr("\nExpired: p.json: /allow/1 expired\n"),
                          HasSubstr("Unused, so it can be removed: p.json: /allow/2")));
}

// Kills: naming a stage although the case was not drawn again; naming the rounding that every value
// has.
TEST(ComparisonText, SaysWhichStageMadeMostOfAGrownError) {
  Gate gate = sample_gate();
  EXPECT_THAT(comparison_text(gate, false), Not(HasSubstr("stage to look at")));
  gate.looks = {records::sample_look()};
  EXPECT_THAT(
      comparison_text(gate, false),
      HasSubstr("    then  0.25 (0x1p-2)\n    stage to look at: set-up, 2.5 ULP of the error\n"));
  gate.looks[0].inspection.splits[0].parts.erase(gate.looks[0].inspection.splits[0].parts.begin());
  EXPECT_THAT(comparison_text(gate, false), Not(HasSubstr("stage to look at")));
  gate.looks = {records::sample_look()};
  gate.looks[0].key.index = 13;
  EXPECT_THAT(comparison_text(gate, false), Not(HasSubstr("stage to look at")));
}

// Kills: naming a part that is not a stage, such as "left open", as the stage to look at.
TEST(ComparisonText, NamesNoStageOfABackendThatTellsNone) {
  using records::Stage;
  records::BaselineSection before = records::sample_section();
  records::BaselineSection after = sample_grown_section();
  before.entries[records::kSampleSliver].stages = {{Stage::transform, records::sample_sum(1, 4)},
                                                   {Stage::left_open, records::sample_sum(1, 4)},
                                                   {Stage::excess, records::sample_sum(1, 4)}};
  after.entries[records::kSampleSliver].stages = {{Stage::transform, records::sample_sum(4, 4)},
                                                  {Stage::left_open, records::sample_sum(8, 4)},
                                                  {Stage::excess, records::sample_sum(16, 4)}};
  Gate gate = gate_of(before, after);
  records::ErrorSplit& split = gate.looks.emplace_back(records::sample_look()).inspection.splits[0];
  split.is_traced = false;
  for (const Stage stage : {Stage::transform, Stage::left_open, Stage::excess}) {
    split.parts = {{stage, {3, 3}}};
    EXPECT_THAT(comparison_text(gate, false),
                AllOf(HasSubstr("error 0.625 → 0.75 ULP"), Not(HasSubstr("stage to look at")),
                      Not(HasSubstr("Stages"))));
    for (const CompareFormat& format : compare_formats()) {
      EXPECT_THAT(format.write(gate),
                  AllOf(Not(HasSubstr("stage to look at")), Not(HasSubstr("part_to_look_at")),
                        Not(HasSubstr("whose part")), Not(HasSubstr("\"grown\""))))
          << format.name;
    }
  }
}

// Kills: 0 as the error of values that may not have been judged.
TEST(ComparisonText, SaysWhereNoErrorIsKnownOfBefore) {
  records::BaselineSection before = records::sample_section();
  before.laws[records::kSampleLaw].cases[records::kSampleCase].worst.clear();
  const Gate gate = gate_of(before, sample_grown_section());
  EXPECT_THAT(comparison_text(gate, false),
              AllOf(HasSubstr("Regression: 2 of 3 entries"),
                    HasSubstr("    error none → 0.75 ULP\n"), Not(HasSubstr("then  "))));
}

// Kills: two numbers that differ but look the same.
TEST(ComparisonText, ShowsAsManyDigitsAsDiffer) {
  records::BaselineSection after = records::sample_section();
  after.entries[records::kSampleSliver].worst = {0x1.4000000000001p-1, 0x1.4000000000001p-1};
  EXPECT_THAT(comparison_text(gate_of(records::sample_section(), after), true),
              HasSubstr("worst 0.625 → 0.6250000000000001 ULP"));
}

TEST(ComparisonText, SaysThatOtherBitsAreNoRegression) {
  records::BaselineSection after = records::sample_section();
  after.laws[records::kSampleLaw].cases[records::kSampleCase].found_digest = 1000;
  EXPECT_THAT(comparison_text(gate_of(records::sample_section(), after), false),
              HasSubstr("\n"
                        "1 of 23 cases drew different bits; errors grew in 0. No number changed, "
                        "so this is not a regression.\n"));
}

TEST(GateAnnotations, NameEachEntryThatIsRefused) {
  const std::string title =
      "::error file=b.json,line=1,title=worse than the baseline of cpu on x86_64::";
  const std::string growth =
      "%0Amost in random case 12; smooth, sliver, triangle 0, pixel (3, 5), sample 0, attribute 0; "
      "error 0.625 → 0.75 ULP; exact 1/3 (about 0.333333333); now   0.5 (0x1p-1); then  0.25 "
      "(0x1p-2)%0Arastercheck replay out/grown/values-are--within--bounds-cpu-random-12.json"
      "%0Arastercheck explain out/grown/values-are--within--bounds-cpu-random-12.json --pixel 3,5 "
      "--sample 0 --triangle 0\n";
  EXPECT_EQ(github_annotations(sample_gate()),
            title + "values are <within> bounds: smooth%0Acases that grew 0 → 1" + growth + title +
                "values are <within> bounds: smooth, sliver%0Aworst 0.625 → 0.75 ULP%0Acases that "
                "grew 0 → 1" +
                growth);
  Gate gate = sample_gate();
  for (const std::size_t worse : {1U, 2U}) {
    gate.comparisons[0].entries[worse].allowed_because = "known";
  }
  EXPECT_EQ(github_annotations(gate), "");
  gate.policy.expired = {"old"};
  EXPECT_EQ(github_annotations(gate), "::warning title=expired::old\n");
}

}  // namespace
}  // namespace rastercheck::reports::compare_text_test
