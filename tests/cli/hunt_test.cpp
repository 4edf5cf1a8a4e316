#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::hunt_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::StartsWith;

/// Arguments of a quick hunt with a corpus of one case, unless `more` has other values.
std::vector<std::string> quick(const TemporaryFolder& folder,
                               const std::vector<std::string>& more) {
  folder.put("corpus/square.json", square_case());
  std::vector<std::string> arguments{"hunt"};
  const std::vector<std::pair<std::string, std::string>> usual{{"--steps", "64"},
                                                               {"--seed", "1"},
                                                               {"--shrink-tries", "5"},
                                                               {"--corpus", folder.path("corpus")},
                                                               {"--output", folder.path("out")}};
  for (const auto& [option, value] : usual) {
    if (std::find(more.begin(), more.end(), option) != more.end()) continue;
    arguments.insert(arguments.end(), {option, value});
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Hunt, EndsWithATableAndCasesThatCanBeReplayed) {
  const TemporaryFolder folder;
  const Outcome hunt = run_program(quick(folder, {"--backend", "cpu:precision=float32"}));
  ASSERT_EQ(hunt.code, 0) << hunt;
  EXPECT_THAT(hunt.out, AllOf(HasSubstr("share of the bound"), HasSubstr("smooth, ordinary"),
                              HasSubstr("64 of 64 steps"), HasSubstr("Seed 1.")));
  const std::vector<std::string> files = folder.files("out");
  ASSERT_FALSE(files.empty());
  EXPECT_THAT(files, Each(StartsWith("worst/")));
  const Outcome replay = run_program({"replay", folder.path("out/" + files.front())});
  EXPECT_EQ(replay.code, 0) << replay;
  EXPECT_THAT(replay.out, HasSubstr("cpu:precision=float32: held (as found)"));
  const Outcome explain = run_program({"explain", folder.path("out/" + files.front())});
  EXPECT_EQ(explain.code, 0) << explain;
}

TEST(Hunt, PrintsJsonThatIsTheSameForTheSameSeed) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = quick(folder, {"--json", "--compare-sampling"});
  const Outcome hunt = run_program(arguments);
  ASSERT_EQ(hunt.code, 0) << hunt;
  const json document = json::parse(hunt.out);
  EXPECT_EQ(document.at("format"), "rastercheck-hunt");
  EXPECT_EQ(document.at("backend"), "cpu");
  EXPECT_EQ(document.at("property"), "values-stay-within-the-bound");
  EXPECT_EQ(document.at("hunted").at("steps"), 64);
  EXPECT_EQ(document.at("sampled").at("sources"), json({{"random", 64}}));
  ASSERT_FALSE(document.at("worst").empty());
  for (const json& worst : document.at("worst")) {
    EXPECT_GT(worst.at("share"), 0);
    EXPECT_LE(worst.at("share"), 1);
    EXPECT_TRUE(std::filesystem::exists(worst.at("file").get<std::string>()));
  }
  EXPECT_EQ(hunt.out, run_program(arguments).out);
  std::vector<std::string> in_two = arguments;
  in_two.insert(in_two.end(), {"--jobs", "2"});
  EXPECT_EQ(hunt.out, run_program(in_two).out);
}

TEST(Hunt, EndsWithCounterexamplesOfViolations) {
  const TemporaryFolder folder;
  const Outcome hunt = run_damaged_program(quick(folder, {"--backend", "damaged:flipped"}));
  EXPECT_EQ(hunt.code, 1) << hunt;
  EXPECT_THAT(hunt.out, AllOf(HasSubstr("Found in step "), HasSubstr("rastercheck replay "),
                              HasSubstr("violated the property")));
  ASSERT_TRUE(std::filesystem::exists(folder.path("out/counterexamples")));
  const std::string file =
      folder.path("out/counterexamples/") + folder.files("out/counterexamples").front();
  EXPECT_EQ(run_damaged_program({"replay", file}).code, 1);
}

TEST(Hunt, SaysThatNothingWasMeasured) {
  const TemporaryFolder folder;
  const Outcome hunt = run_program(quick(folder, {"--property", "coverage-obeys-the-contract"}));
  EXPECT_EQ(hunt.code, 5) << hunt;
  EXPECT_THAT(hunt.out, HasSubstr("No value with an error was found"));
}

TEST(Hunt, EndsAfterItsTime) {
  const TemporaryFolder folder;
  const Outcome hunt =
      run_program(quick(folder, {"--steps", "100000000", "--max-time", "0.5", "--json"}));
  EXPECT_EQ(json::parse(hunt.out).at("hunted").at("steps").get<std::uint64_t>() % 64, 0U);
}

TEST(Hunt, RefusesWhatItCannotHunt) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--property", "*"},
                                               {"--property", "nothing"},
                                               {"--backend", "nothing"},
                                               {"--guide", "nothing"},
                                               {"--steps", "-1"},
                                               {"--max-time", "0"},
                                               {"--corpus", folder.path("nowhere")}}) {
    EXPECT_TRUE(is_failure(run_program(quick(folder, more)), 2)) << more.front() << more.back();
  }
  EXPECT_EQ(run_damaged_program(quick(folder, {"--backend", "damaged:absent"})).code, 4);
}

}  // namespace
}  // namespace rastercheck::cli::hunt_test
