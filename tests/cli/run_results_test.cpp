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

}  // namespace
}  // namespace rastercheck::cli::run_results_test
