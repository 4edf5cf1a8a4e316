// Laws are thin if they held on few cases, or on too few of the cases they are about.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::thin_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

// Kills: a law reported as held although its cases are not those that it is about.
TEST(Thin, IsALawThatReachesALabelTooSeldom) {
  TemporaryFolder folder;
  folder.put("corpus/square.json", square_case());
  const Outcome outcome = run_damaged_program(
      {"run", "--corpus", folder.path("corpus"), "--output", folder.path("out"), "--backend",
       "damaged:unseen", "--cases", "120", "--seed", "1", "--property", "cases-reach*"});
  EXPECT_EQ(outcome.code, 5) << outcome;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("thin: 121 of 121 cases, 'never seen' in 0 of at least 5"),
                    HasSubstr("1 property held without reaching a required label.\n"),
                    HasSubstr("Not reached: cases-reach-a-label-that-none-has on damaged:unseen: "
                              "'never seen' in 0 of "),
                    Not(HasSubstr("'drawn'"))));
  const auto unreached = nlohmann::json::parse(folder.content("out/run.json")).at("unreached");
  ASSERT_THAT(unreached, SizeIs(1));
  EXPECT_EQ(unreached[0].at("label"), "never seen");
  EXPECT_EQ(unreached[0].at("reached"), 0);
  EXPECT_GT(unreached[0].at("least"), 0);
  EXPECT_THAT(folder.content("out/summary.md"), HasSubstr("Not reached: "));
  EXPECT_THAT(folder.content("out/report.html"), HasSubstr("Not reached: "));
}

// Kills: "held" and exit code 0 after a handful of cases.
TEST(Thin, EndsWithFiveWhereMoreCasesAreRequired) {
  TemporaryFolder folder;
  folder.put("corpus/square.json", square_case());
  const auto required = [&folder](const std::string& cases) {
    return run_program({"run", "--corpus", folder.path("corpus"), "--output", folder.path("out"),
                        "--cases", "6", "--seed", "1", "--property", "coverage-obeys*",
                        "--require-cases", cases});
  };
  const Outcome enough = required("7");
  EXPECT_EQ(enough.code, 0) << enough;
  EXPECT_THAT(enough.out, Not(HasSubstr("thin")));
  const Outcome few = required("8");
  EXPECT_EQ(few.code, 5) << few;
  EXPECT_THAT(few.out, AllOf(HasSubstr("thin: 7 of 7 cases"),
                             HasSubstr("\n1 property held on fewer than 8 cases.\n")));
  EXPECT_THAT(folder.content("out/junit.xml"), HasSubstr("type=\"too few cases\""));
  EXPECT_THAT(folder.content("out/report.html"), HasSubstr("<h2>Held on few cases</h2>"));
}

}  // namespace
}  // namespace rastercheck::cli::thin_test
