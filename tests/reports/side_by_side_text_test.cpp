#include "reports/side_by_side_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/format.h"
#include "tests/reports/sample_run.h"

namespace rastercheck::reports::side_by_side_text_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string written(std::string_view format, const records::Run& run) {
  return find_format(format).value().write(run);
}

/// A run in which both backends are right wherever they were judged.
records::Run agreeing() {
  records::Run run = sample_run();
  for (auto& [key, outcomes] : *run.outcomes) outcomes = {records::IndexSet({{0, 9}}), {}, {}, {}};
  run.differences.clear();
  return run;
}

// The counts are worked out by hand: of 60 random cases the second backend was not judged on two
// (43 and 59) and got three others; of the 55 left it is wrong in 17, 41 and 42. In one case of the
// corpus neither is right.
TEST(SideBySideText, SaysWhoIsRightAndWhereTheyDiffer) {
  EXPECT_EQ(side_by_side_text(sample_run(), "out"),
            R"(
Side by side: cpu and method:float32
  Compared on 56 cases, the same on both. cpu was judged on 61 cases in all,
  method:float32 on 59; 3 judged on both were made differently, to fit what each
  can draw.
  both right                52
  only cpu right             3
  only method:float32 right  0
  neither right              1
  Of the wrong cases, 1 on method:float32 is a known defect.
  They differ on 1 property:
    values are within bounds
      only cpu right in 3 cases: random cases 17 “a <b>bold</b> | "case"”, 41,
      42
  The first of these cases, wrong, then right:
)"
            "    rastercheck replay out/differences/values-are-within-bounds-method-float32-wrong-"
            "cpu-right.json --backend method:float32 --timeout 2.5\n"
            "    rastercheck replay out/differences/values-are-within-bounds-method-float32-wrong-"
            "cpu-right.json --backend cpu --timeout 2.5\n"
            R"(Each backend is held to its own contract, so two backends may both be right and
draw different values. A known defect counts as wrong.
)");
}

TEST(SideBySideText, SaysThatBackendsAgree) {
  const std::string text = side_by_side_text(agreeing(), "out");
  EXPECT_THAT(text, AllOf(HasSubstr("  Compared on 20 cases, the same on both.\n"),
                          HasSubstr("  They agree on every property.\n"), Not(HasSubstr("replay")),
                          Not(HasSubstr("known defect."))));
  for (const char* format : {"html", "markdown"}) {
    EXPECT_THAT(written(format, agreeing()), HasSubstr("They agree on every property.")) << format;
  }
}

// Kills: "they agree" about backends that were never judged on the same case.
TEST(SideBySideText, SaysThatThereIsNothingToCompare) {
  records::Run run = agreeing();
  run.outcomes->erase({run.plan.laws[1], "cpu", records::Origin::corpus});
  (*run.outcomes)[{run.plan.laws[1], "method:float32", records::Origin::random}].unlike["cpu"] =
      records::IndexSet({{0, 9}});
  EXPECT_THAT(side_by_side_text(run, "out"),
              AllOf(HasSubstr("  Nothing to compare: no case is the same on both"),
                    Not(HasSubstr("agree")), Not(HasSubstr("both right  "))));
  for (const char* format : {"html", "markdown"}) {
    EXPECT_THAT(written(format, run),
                AllOf(HasSubstr("Nothing to compare"), Not(HasSubstr("They agree"))))
        << format;
  }
}

// Kills: a terminal full of properties.
TEST(SideBySideText, ShowsThreePropertiesAndCountsTheRest) {
  records::Run run = sample_run();
  for (int i = 0; i < 5; ++i) {
    const std::string law = "law " + std::to_string(i);
    run.plan.laws.push_back(law);
    for (auto& [key, outcomes] : sample_outcomes(law, run.plan.backends)) {
      run.outcomes->insert({key, outcomes});
    }
  }
  const std::string text = side_by_side_text(run, "out");
  EXPECT_THAT(text, AllOf(HasSubstr("  They differ on 6 properties:\n"), HasSubstr("\n    law 1\n"),
                          Not(HasSubstr("\n    law 2\n")),
                          HasSubstr("\n    and 3 more, which summary.md and report.html list\n")));
  EXPECT_THAT(written("markdown", run), HasSubstr("\n- law 4: only cpu right in 3 cases "));
}

TEST(SideBySideText, IsNothingForOneBackend) {
  records::Run run = sample_run();
  run.plan.backends.pop_back();
  EXPECT_EQ(side_by_side_text(run, "out"), "");
  EXPECT_THAT(written("html", run), Not(HasSubstr("Side by side")));
  EXPECT_THAT(written("markdown", run), Not(HasSubstr("Side by side")));
}

// Kills: an index that no run has, for a case that was drawn again.
TEST(SideBySideText, NamesACaseThatWasDrawnAgain) {
  records::Run run = sample_run();
  const std::string law = run.plan.laws[1];
  const std::uint64_t again = records::kRedrawn + 5;
  (*run.outcomes)[{law, "cpu", records::Origin::random}].right =
      records::IndexSet({{again, again}});
  (*run.outcomes)[{law, "method:float32", records::Origin::random}].wrong =
      records::IndexSet({{again, again}});
  EXPECT_THAT(side_by_side_text(run, "out"), HasSubstr("random case 5 (drawn again) “"));
}

}  // namespace
}  // namespace rastercheck::reports::side_by_side_text_test
