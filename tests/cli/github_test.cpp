#include "cli/github.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::github_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Github : public testing::Test {
 protected:
  Github() { folder_.put("corpus/square.json", square_case()); }

  Outcome run(const std::string& environment, const std::string& options = "") const {
    return run_shell(
        "cd " + folder_.path() + "; env -u GITHUB_ACTIONS -u GITHUB_STEP_SUMMARY " + environment +
        " \"$DAMAGED\" run --backend damaged --property 'coverage*' --cases 0 --seed 1 "
        "--corpus corpus --shrink-tries 20 " +
        options);
  }

  TemporaryFolder folder_;
};

TEST_F(Github, IsToldOfEachCounterexample) {
  const Outcome outcome = run("GITHUB_ACTIONS=true");
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(
      outcome.out,
      HasSubstr("\n::error file=rastercheck-out/counterexamples/coverage-obeys-the-contract-"
                "damaged-missing.json,line=1,title=coverage-obeys-the-contract on "
                "damaged::pixel ("));
}

// Kills: annotations printed to a terminal outside GitHub, or into JSON.
TEST_F(Github, IsToldNothingElsewhere) {
  EXPECT_THAT(run("").out, Not(HasSubstr("::error")));
  const Outcome outcome = run("GITHUB_ACTIONS=true", "--json");
  EXPECT_THAT(outcome.out, AllOf(StartsWith("{"), Not(HasSubstr("::error"))));
}

// Kills: overwriting the summary of another step.
TEST_F(Github, FindsTheSummaryAtTheEndOfItsFile) {
  folder_.put("summary", "another step\n");
  EXPECT_EQ(run("GITHUB_STEP_SUMMARY=summary").code, 1);
  EXPECT_EQ(folder_.content("summary"),
            "another step\n" + folder_.content("rastercheck-out/summary.md"));
}

TEST_F(Github, HasASummaryThatCannotBeWrittenNamed) {
  const Outcome outcome = run("GITHUB_STEP_SUMMARY=no/such/file");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no/such/file: cannot be written to: No such file"));
}

}  // namespace
}  // namespace rastercheck::cli::github_test
