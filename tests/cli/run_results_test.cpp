#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::run_results_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

// The verdict is the last thing said; laws that held have no rows unless asked for.
TEST(RunResults, EndWithTheVerdict) {
  TemporaryFolder folder;
  folder.put("corpus/square.json", square_case());
  const auto with = [&folder](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",        "--corpus",         folder.path("corpus"),
                                       "--output",   folder.path("out"), "--cases",
                                       "30",         "--seed",           "1",
                                       "--property", kCoverage,          "--shrink-tries",
                                       "20"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const Outcome brief = run_program(with({}));
  EXPECT_EQ(brief.code, 0) << brief;
  EXPECT_THAT(
      brief.out,
      AllOf(StartsWith("Samples: "),
            HasSubstr("\n\ncpu: 1 property held.\n`--all` shows a row for each property.\nSeed ")));
  EXPECT_THAT(run_program(with({"--all"})).out,
              AllOf(StartsWith("property "), HasSubstr("\n" + std::string(kCoverage) + "  cpu "),
                    HasSubstr("\n\ncpu: 1 property held.\nSeed ")));
  EXPECT_THAT(run_damaged_program(with({"--backend", "damaged"})).out,
              AllOf(StartsWith("property "),
                    HasSubstr("\ndamaged: 1 property violated (1 cause).\nSeed ")));
  const Outcome both = run_program(with({"--all", "--quiet"}));
  EXPECT_EQ(both.code, 2) << both;
}

// Two backends on the same cases: who is right, and commands that show it.
TEST(RunResults, ShowBackendsSideBySide) {
  TemporaryFolder folder;
  folder.put("corpus/square.json", square_case());
  const std::vector<std::string> arguments{"run",
                                           "--corpus",
                                           folder.path("corpus"),
                                           "--output",
                                           folder.path("out"),
                                           "--cases",
                                           "8",
                                           "--seed",
                                           "1",
                                           "--property",
                                           kCoverage,
                                           "--backend",
                                           "damaged",
                                           "--backend",
                                           "cpu",
                                           "--shrink-tries",
                                           "0"};
  const Outcome outcome = run_damaged_program(arguments);
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(
      outcome.out,
      AllOf(HasSubstr("\nSide by side: damaged and cpu\n  Compared on "),
            HasSubstr("\n  only damaged right 0\n"),
            HasSubstr("  They differ on 1 property:\n    coverage-obeys-the-contract\n      only "
                      "cpu right in ")));
  // Before the verdict, which comes last.
  EXPECT_LT(outcome.out.find("Side by side"), outcome.out.find("\ndamaged: 1 property violated"));
  // The commands do what is said of them.
  const std::string title = "  The first of these cases, wrong, then right:\n    rastercheck ";
  std::size_t at = outcome.out.find(title);
  ASSERT_NE(at, std::string::npos) << outcome;
  at += title.size();
  const std::string wrong = outcome.out.substr(at, outcome.out.find('\n', at) - at);
  at = outcome.out.find("rastercheck ", at) + std::string("rastercheck ").size();
  const std::string right = outcome.out.substr(at, outcome.out.find('\n', at) - at);
  EXPECT_THAT(wrong, HasSubstr(" --backend damaged"));
  EXPECT_THAT(right, HasSubstr(" --backend cpu"));
  const std::string file =
      folder.path("out/differences/coverage-obeys-the-contract-damaged-wrong-cpu-right.json");
  EXPECT_THAT(wrong, HasSubstr(file));
  const Outcome as_wrong = run_damaged_program({"replay", file, "--backend", "damaged"});
  EXPECT_EQ(as_wrong.code, 1) << as_wrong;
  const Outcome as_right = run_damaged_program({"replay", file, "--backend", "cpu"});
  EXPECT_EQ(as_right.code, 0) << as_right;
  // One backend alone is compared with nothing, and its run.json is what it always was.
  const Outcome alone =
      run_program({"run", "--corpus", folder.path("corpus"), "--output", folder.path("one"),
                   "--cases", "8", "--seed", "1", "--property", kCoverage});
  EXPECT_THAT(alone.out, Not(HasSubstr("Side by side")));
  EXPECT_THAT(folder.content("one/run.json"), Not(HasSubstr("\"outcomes\"")));
}

}  // namespace
}  // namespace rastercheck::cli::run_results_test
