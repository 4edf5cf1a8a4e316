#include "reports/annotations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::annotations_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(GithubAnnotations, NameTheFileOfEachCounterexample) {
  records::Run run = sample_run();
  run.unreached.clear();
  const std::string text = github_annotations(run, "out");
  EXPECT_THAT(text,
              StartsWith("::error file=out/counterexamples/values-are-within-bounds-method-float32-"
                         "beyond-bound.json,line=1,title=values are within bounds on "
                         "method%3Afloat32::pixel (3, 5), sample 2, of triangle 0: attribute "));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_THAT(text, HasSubstr("%0Arastercheck replay out/counterexamples/"));
}

// Kills: a text that ends the command, or is read as an escape sequence.
TEST(GithubAnnotations, EscapeTexts) {
  records::Run run;
  run.unreached = {{"50%\nof, a: law", "cpu", "tie", 2, 13, 1000}};
  EXPECT_EQ(github_annotations(run, "out"),
            "::error title=label not reached::Not reached: 50%25%0Aof, a: law on cpu: 'tie' in 2 "
            "of 1000 cases; at least 13 were required.\n");
}

TEST(GithubAnnotations, AreNoneWhereAllHeld) { EXPECT_EQ(github_annotations({}, "out"), ""); }

// Kills: reporting an error where only the driver's version is the cause.
TEST(GithubAnnotations, WarnOfPassesUnderAnotherVersion) {
  records::Run run;
  run.unexpected = {{"gl", "driver-1", "a law", records::Staleness::other_version},
                    {"gl", "driver-2", "a law", records::Staleness::wrong_list}};
  const std::string text = github_annotations(run, "out");
  EXPECT_THAT(text, StartsWith("::warning title=unexpected pass::"));
  EXPECT_THAT(text, HasSubstr("\n::error title=unexpected pass::"));
}

}  // namespace
}  // namespace rastercheck::reports::annotations_test
