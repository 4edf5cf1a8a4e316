#include "reports/cause_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::cause_text_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string command_of(const records::Counterexample& one) {
  return "replay " + std::to_string(one.source.found->index);
}

TEST(CauseText, SaysHowManyThereAre) {
  const records::Run run = sample_run();
  EXPECT_EQ(cause_counts(run), "2 counterexamples, 1 cause");
}

TEST(CauseText, NamesTheBackendWhereThereAreSeveral) {
  records::Run run = sample_run();
  run.plan.backends = {"cpu", "method:clip-space"};
  EXPECT_THAT(cause_line(run, run.causes.at(0)), testing::EndsWith("property, on cpu"));
  run.plan.backends = {"cpu"};
  EXPECT_EQ(cause_line(run, run.causes.at(0)),
            "values are wrong where a pixel has several samples: 2 counterexamples of 1 property");
}

TEST(CauseText, HasWhatWasTriedAndTheFirstCounterexample) {
  const std::string text = causes_text(sample_run(), &command_of);
  EXPECT_THAT(text, StartsWith("\nCause 1: values are wrong"));
  EXPECT_THAT(text, HasSubstr("\n  It holds once values are corrected.\n"));
  EXPECT_THAT(text, HasSubstr("replay 3\n"));
  EXPECT_THAT(text, testing::Not(HasSubstr("replay 41\n")));
}

TEST(CauseText, EndsWithALineAndACommandOfEach) {
  records::Run run = sample_run();
  run.causes[0].hint = std::nullopt;
  EXPECT_THAT(causes_list(run, &command_of),
              testing::EndsWith("2 counterexamples of 1 property, on cpu\n     replay 3\n"));
}

TEST(CauseText, HasAHintWhereThereIsOne) {
  records::Run run = sample_run();
  const std::string line =
      "int: it draws as if <y> points in the other direction (1 of 2 wrong drawings)";
  EXPECT_THAT(causes_text(run, &command_of), HasSubstr("\n  H" + line + ".\n"));
  EXPECT_THAT(causes_list(run, &command_of), HasSubstr("\n     h" + line + "\n"));
  run.causes[0].hint = records::Hint{"x and y are exchanged", 1, 1};
  EXPECT_EQ(hint_text(run.causes[0]),
            "it draws as if x and y are exchanged (its one wrong drawing)");
  run.causes[0].hint = std::nullopt;
  EXPECT_THAT(causes_list(run, &command_of), testing::Not(HasSubstr("hint")));
}

TEST(CauseText, RunsOfBeforeHaveCounterexamplesWithoutACause) {
  records::Run run = sample_run();
  EXPECT_THAT(without_cause(run), ElementsAre());
  run.causes[0].counterexamples = {1};
  EXPECT_THAT(without_cause(run), ElementsAre(0U));
}

}  // namespace
}  // namespace rastercheck::reports::cause_text_test
