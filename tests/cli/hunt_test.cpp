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

TEST(Hunt, BeginsWithTheWorstOfAnEarlierHuntOrRun) {
  const TemporaryFolder folder;
  const std::vector<std::string> backend{"--backend", "cpu:precision=float32"};
  ASSERT_EQ(run_program(quick(folder, backend)).code, 0);
  const std::size_t worst = folder.files("out").size();
  const auto given_from = [&](const std::string& start, const std::string& on) {
    const Outcome hunt = run_program(quick(
        folder, {"--backend", on, "--start", start, "--output", folder.path("more"), "--json"}));
    EXPECT_EQ(hunt.code, 0) << hunt;
    return json::parse(hunt.out).at("hunted").at("sources").at("given").get<std::size_t>();
  };
  EXPECT_EQ(given_from(folder.path("out"), backend.back()), worst);
  ASSERT_EQ(run_program({"run", "--backend", "cpu", "--backend", backend.back(), "--property",
                         "values-stay*", "--cases", "20", "--seed", "1", "--corpus",
                         folder.path("corpus"), "--output", folder.path("run"), "-q"})
                .code,
            0);
  // The run's errors of this backend, or of any if it is none of the run's.
  const std::size_t of_float = given_from(folder.path("run"), backend.back());
  EXPECT_GT(of_float, 3U);
  EXPECT_GT(given_from(folder.path("run"), "method:rational-linear-float"), of_float);
}

// Kills: figures that a run with the baseline does not find again; cases that are added twice;
// sections that can no longer be compared with one run.
TEST(Hunt, AddsItsWorstCasesToABaseline) {
  const TemporaryFolder folder;
  const std::vector<std::string> backends{"--backend", "cpu", "--backend", "cpu:precision=float32"};
  std::vector<std::string> run{"run", "--property",   "*-bound",  "--cases",          "5", "--seed",
                               "1",   "--keep-cases", "--output", folder.path("run"), "-q"};
  folder.put("corpus/square.json", square_case());
  run.insert(run.end(), {"--corpus", folder.path("corpus")});
  run.insert(run.end(), backends.begin(), backends.end());
  ASSERT_EQ(run_program(run).code, 0);
  const std::string baseline = folder.path("baseline.json");
  ASSERT_EQ(run_program({"baseline", "save", folder.path("run"), "--output", baseline}).code, 0);
  const auto hunt = [&](const char* seed) {
    // The corpus is the baseline's.
    const Outcome hunted = run_program({"hunt", "--backend", "cpu:precision=float32", "--steps",
                                        "128", "--shrink-tries", "5", "--seed", seed, "--baseline",
                                        baseline, "--output", folder.path("out"), "--json"});
    EXPECT_EQ(hunted.code, 0) << hunted;
    return json::parse(hunted.out);
  };
  const json first = hunt("1");
  const std::size_t worst = first.at("worst").size();
  EXPECT_GT(worst, 3U);
  EXPECT_EQ(first.at("baseline"), (json{{"file", baseline}, {"added", worst}, {"there", 0}}));
  const json again = hunt("1");
  EXPECT_EQ(again.at("hunted").at("sources").at("given"), worst);
  EXPECT_GT(again.at("baseline").at("there"), 0);

  std::vector<std::string> held{"run", "--baseline", baseline, "--output", folder.path("held")};
  held.insert(held.end(), backends.begin(), backends.end());
  const Outcome same = run_program(held);
  EXPECT_EQ(same.code, 0) << same;
  EXPECT_THAT(same.out, testing::Not(HasSubstr("worse")));
  // A run without these cases has others than the baseline, and says how to have the same.
  const Outcome other = run_program({"compare", baseline, folder.path("run")});
  EXPECT_TRUE(is_failure(other, 2)) << other;
  EXPECT_THAT(other.err, HasSubstr("worst cases of hunts"));
  // To save such a run loses them.
  EXPECT_THAT(run_program({"baseline", "save", folder.path("run"), "--output", baseline}).out,
              HasSubstr("worst cases of hunts are no longer in it"));
}

TEST(Hunt, RefusesABaselineThatItCannotAddTo) {
  const TemporaryFolder folder;
  const Outcome none =
      run_program(quick(folder, {"--baseline", folder.put("none.json", "{\"format\": 1}")}));
  EXPECT_TRUE(is_failure(none, 2)) << none;
  const std::string empty = folder.put(
      "empty.json", R"({"format": "rastercheck-baseline", "version": 3, "sections": []})");
  const Outcome without = run_program(quick(folder, {"--baseline", empty}));
  EXPECT_TRUE(is_failure(without, 2)) << without;
  EXPECT_THAT(without.err, HasSubstr("has no section for cpu"));
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
                                               {"--start", folder.path("nowhere")},
                                               {"--corpus", folder.path("nowhere")}}) {
    EXPECT_TRUE(is_failure(run_program(quick(folder, more)), 2)) << more.front() << more.back();
  }
  EXPECT_EQ(run_damaged_program(quick(folder, {"--backend", "damaged:absent"})).code, 4);
}

}  // namespace
}  // namespace rastercheck::cli::hunt_test
