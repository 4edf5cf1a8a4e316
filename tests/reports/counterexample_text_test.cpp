#include "reports/counterexample_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::counterexample_text_test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CounterexampleText, SaysWhatFailedAndHowToCheckItAgain) {
  const std::string text = counterexample_text(sample_counterexample(3), "rastercheck replay one");
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("values are within bounds\n  on method:float32: beyond bound. It is saved "
                      "before: case 3 of seed 1"),
            HasSubstr("; shrunk in 214 tries.\n"),
            HasSubstr("pixel (3, 5), sample 2, of triangle 0: attribute 'u & v' was drawn as "
                      "16.800001 and must be 16.8; off by 0.7 scale ULP, 0.5 allowed\n    exactly "
                      "84/5 (about 16.8); drawn 16.8000011 (0x1.0cccdp+4)\n"),
            HasSubstr("  … 12 violations in all\n"), HasSubstr("    y 5 [!]\n"),
            EndsWith("  Again: rastercheck replay one\n")));
}

TEST(CounterexampleText, SaysWhatMightGoOn) {
  EXPECT_THAT(counterexample_text(sample_counterexample(4), "x"),
              HasSubstr("; shrunk in 214 tries, which might go on.\n"));
  records::Counterexample whole = sample_counterexample(3);
  whole.shrinking.reset();
  EXPECT_THAT(counterexample_text(whole, "x"), HasSubstr("; as found.\n"));
}

// For coverage, the text gives the verdict and the distance; for a range, both ends.
TEST(CounterexampleText, GivesExactValuesWithDecimals) {
  records::Counterexample missing = sample_counterexample(3);
  missing.violations.erase(missing.violations.begin());
  EXPECT_THAT(
      counterexample_text(missing, "x"),
      HasSubstr("pixel (63, 0), sample 0, of triangle 0: the sample is not drawn and must be "
                "(required, inside); 0.125 pixels from the boundary; its neighbour"));
  records::Counterexample range = sample_counterexample(3);
  range.violations[0].exact = "[1/3, 2/3]";
  EXPECT_THAT(counterexample_text(range, "x"),
              HasSubstr("exactly [1/3, 2/3] (about 0.333333333 to 0.666666667)"));
}

/// A counterexample whose case could not be drawn.
records::Counterexample crashed() {
  records::Counterexample one = sample_counterexample(3);
  records::Violation crash;
  crash.fragment_class = records::FragmentClass::crash;
  crash.exact = "a drawing";
  crash.actual = "none";
  crash.note = "its process ended";
  one.violations = {crash};
  one.violation_count = 1;
  return one;
}

// Kills: giving a sample or an exact answer although nothing was drawn.
TEST(CounterexampleText, SaysOfNoDrawingOnlyWhy) {
  EXPECT_THAT(counterexample_text(crashed(), "x"),
              AllOf(HasSubstr("; shrunk in 214 tries.\n  its process ended\n"),
                    Not(HasSubstr("pixel (")), Not(HasSubstr("exactly"))));
  EXPECT_EQ(violations_text(crashed().violations, 1, {}),
            "  class  of  triangle  x  y  s  exact  actual  error  bound  distance  note\n"
            "  crash  -   -         -  -  -  -      -       -      -      -         "
            "its process ended\n");
}

// Kills: a rounded number; minus zero without its sign; reading the grid as pixels.
TEST(CaseText, ShowsStateVerticesAndTriangles) {
  const std::string text = case_text(sample_case("law", "cpu", 1));
  EXPECT_THAT(text, AllOf(HasSubstr("  64 × 48 pixels of 4 samples, viewport 0 0 64 48, rules "),
                          HasSubstr(", snapped to 8 subpixel bits ("), HasSubstr("grid x"),
                          HasSubstr("-0x0p+0 (-0)"), HasSubstr("0x1p-149 (1.4013e-45)"),
                          EndsWith("  triangle 0 1 2\n")));
  cases::Case exact = sample_case("law", "cpu", 1);
  exact.coverage.reset();
  EXPECT_THAT(case_text(exact), AllOf(HasSubstr("window x"), Not(HasSubstr("subpixel"))));
}

// Kills: filling the screen with vertices.
TEST(CaseText, OnlyCountsMany) {
  cases::Case c = sample_case("law", "cpu", 1);
  c.triangles.assign(20, {0, 1, 2});
  EXPECT_THAT(case_text(c), AllOf(HasSubstr("  64 × 48 pixels"), Not(HasSubstr("grid x")),
                                  EndsWith("  3 vertices and 20 triangles: see the file\n")));
}

TEST(ViolationsText, IsATable) {
  const records::Counterexample one = sample_counterexample(3);
  const std::string text = violations_text(one.violations, one.violation_count, {});
  EXPECT_THAT(text, AllOf(HasSubstr("  class         of"), HasSubstr("  beyond bound  smooth [0]"),
                          HasSubstr("  missing       coverage"), EndsWith("  … 12 in all\n")));
  EXPECT_THAT(violations_text(one.violations, 2, {}), Not(HasSubstr("in all")));
}

}  // namespace
}  // namespace rastercheck::reports::counterexample_text_test
