// A campaign in parts, by `run --shard`, and the parts put together by `merge`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program.h"
#include "tests/properties/campaign/known_list.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::shard_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string part(int index, int count) {
  return std::to_string(index) + "/" + std::to_string(count);
}

/// The text without the line of the seed, because that line also tells how long the run took.
std::string without_time(std::string text) {
  const std::size_t start = text.find("\nSeed ");
  if (start == std::string::npos) return text;
  return text.erase(start, text.find('\n', start + 1) - start);
}

class Shard : public testing::Test {
 protected:
  Shard() { folder_.put("corpus/square.json", square_case()); }

  std::vector<std::string> arguments(const std::string& output,
                                     const std::vector<std::string>& more) const {
    std::vector<std::string> all{"run",      "--corpus",           folder_.path("corpus"),
                                 "--output", folder_.path(output), "--shrink-tries",
                                 "20"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome run(const std::string& output, const std::vector<std::string>& more) const {
    return run_damaged_program(arguments(output, more));
  }
  Outcome run_shard(int index, int count, std::vector<std::string> more) const {
    more.insert(more.end(), {"--shard", part(index, count)});
    return run("shard" + std::to_string(index), more);
  }
  /// Runs a small shard: the law of coverage on six cases.
  Outcome run_small(int index, int count, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--seed", "1", "--cases", "6", "--property", "coverage-obeys*"});
    return run_shard(index, count, more);
  }
  Outcome merge(const std::vector<int>& shards, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"merge", "--output", folder_.path("merged")});
    for (const int shard : shards) more.push_back(folder_.path("shard" + std::to_string(shard)));
    return run_damaged_program(more);
  }
  /// Expects that both folders have the same files, the same counterexamples and, except for its
  /// environment, the same run.json.
  void expect_same(const std::string& one, const std::string& other) const {
    EXPECT_TRUE(without_environment(folder_.content(one + "/run.json")) ==
                without_environment(folder_.content(other + "/run.json")));
    ASSERT_EQ(folder_.files(one), folder_.files(other));
    for (const std::string& file : folder_.files(one)) {
      if (!file.starts_with("counterexamples/") && !file.starts_with("differences/")) continue;
      EXPECT_EQ(folder_.content(one + "/" + file), folder_.content(other + "/" + file));
    }
  }
  /// Replaces one folder's path by another's in the output of a run.
  std::string in_folder(std::string text, const std::string& from, const std::string& to) const {
    const std::string before = folder_.path(from);
    const std::string after = folder_.path(to);
    for (std::size_t at = 0; (at = text.find(before, at)) != std::string::npos;) {
      text.replace(at, before.size(), after);
      at += after.size();
    }
    return text;
  }
  /// Waits until some of the cases of a run are done and kept.
  void wait_for_progress(const std::string& unfinished) const {
    using std::chrono::steady_clock;
    const auto late = steady_clock::now() + std::chrono::minutes(5);
    while (steady_clock::now() < late) {
      const json kept = json::parse(folder_.content(unfinished), nullptr, false);
      if (!kept.is_discarded() && !kept.at("done").empty()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    FAIL() << "no progress";
  }
  json run_json(const std::string& output) const {
    return json::parse(folder_.content(output + "/run.json"));
  }

  TemporaryFolder folder_;
};

// --- The same run --------------------------------------------------------------------------------

class InShards : public Shard, public testing::WithParamInterface<std::pair<int, const char*>> {};

INSTANTIATE_TEST_SUITE_P(CountAndJobs, InShards,
                         testing::Values(std::pair(1, "1"), std::pair(7, "1"), std::pair(7, "2"),
                                         std::pair(64, "1")));

// Kills: a case checked twice or by no shard; a counterexample that is not the first one; samples
// inspected for a part, shown as the inspections of the whole.
TEST_P(InShards, IsTheRunThatOneProgramMakes) {
  const auto [count, jobs] = GetParam();
  const std::vector<std::string> campaign{
      "--seed",      "5",    "--cases",   "9",
      "--property",  "*st*", "--backend", "damaged",
      "--backend",   "cpu",  "--backend", "method:screen-linear",
      "--jobs",      jobs,   "--scene",   source_file("cases/corpus/nearest.json"),
      "--keep-cases"};
  const Outcome whole = run("whole", campaign);
  ASSERT_EQ(whole.code, 1) << whole;
  std::vector<int> shards;
  for (int i = count; i >= 1; --i) {  // in any order
    const Outcome outcome = run_shard(i, count, campaign);
    ASSERT_TRUE(outcome.code == 0 || outcome.code == 1) << outcome;
    shards.push_back(i);
  }
  const Outcome merged = merge(shards);
  EXPECT_EQ(merged.code, whole.code) << merged;
  EXPECT_EQ(merged.err, "");
  expect_same("merged", "whole");
  EXPECT_EQ(without_time(merged.out), without_time(in_folder(whole.out, "whole", "merged")));
  const json document = run_json("merged");
  EXPECT_THAT(document.at("counterexamples"), Not(IsEmpty()));
  EXPECT_THAT(document.at("inspections"), Not(IsEmpty()));
  EXPECT_THAT(document.at("specimens"), Not(IsEmpty()));
  EXPECT_THAT(document.at("outcomes"), Not(IsEmpty()));
  EXPECT_THAT(document.at("differences"), Not(IsEmpty()));
  EXPECT_THAT(merged.out, HasSubstr("\nSide by side: damaged and cpu\n"));
  EXPECT_THAT(document.at("pictures"), SizeIs(6));
  EXPECT_EQ(document.at("environment").at("shards"), std::to_string(count));
}

// Kills: labels judged by a shard alone, or forgotten.
TEST_F(Shard, LeavesLabelsToTheMerge) {
  const std::vector<std::string> campaign{
      "--backend", "damaged:unseen", "--cases", "120", "--seed", "1", "--property", "cases-reach*"};
  EXPECT_EQ(run("whole", campaign).code, 5);
  for (int i = 1; i <= 3; ++i) {
    const Outcome outcome = run_shard(i, 3, campaign);
    EXPECT_EQ(outcome.code, 0) << outcome;
    EXPECT_THAT(outcome.out, Not(HasSubstr("Not reached")));
  }
  const Outcome merged = merge({1, 2, 3});
  EXPECT_EQ(merged.code, 5) << merged;
  EXPECT_THAT(merged.out, HasSubstr("Not reached"));
  expect_same("merged", "whole");
}

// Kills: a known defect checked by each shard; a forgotten entry whose defect no longer shows.
TEST_F(Shard, KnowsWhatIsKnownOfDrivers) {
  const TemporaryFolder known;
  properties::put_known(known);
  for (const char* backend : {"damaged:driver", "damaged:mended"}) {
    const std::vector<std::string> campaign{
        "--backend", backend,      "--cases",         "30",      "--seed",
        "1",         "--property", "coverage-obeys*", "--known", known.path()};
    const Outcome whole = run("whole", campaign);
    for (int i = 1; i <= 3; ++i) run_shard(i, 3, campaign);
    const Outcome merged = merge({3, 1, 2});
    EXPECT_EQ(merged.code, whole.code) << merged;
    expect_same("merged", "whole");
  }
}

// Kills: saved counterexamples counted by each shard; a saved counterexample that cannot be shown.
TEST_F(Shard, ChecksSavedCounterexamplesOnce) {
  const std::string name = "/counterexamples/coverage-obeys-the-contract-damaged-missing.json";
  for (const char* folder : {"whole", "shard1", "shard2"}) {
    folder_.put(folder + name, square_case(R"("found": {"property": "coverage-obeys-the-contract",
      "backend": "damaged", "verdict": "missing", "seed": 5, "index": 77}, )"));
  }
  folder_.put("none/note.txt", "");
  const std::vector<std::string> campaign{"--backend", "damaged", "--corpus", folder_.path("none")};
  const auto small = [&](const std::string& output, std::vector<std::string> more) {
    more.insert(more.begin(), {"run", "--output", folder_.path(output), "--seed", "1", "--cases",
                               "2", "--property", "coverage-obeys*"});
    more.insert(more.end(), campaign.begin(), campaign.end());
    return run_damaged_program(more);
  };
  EXPECT_THAT(small("whole", {}).out, HasSubstr("saved before: case 77 of seed 5"));
  EXPECT_EQ(small("shard1", {"--shard", "1/2"}).code, 1);
  small("shard2", {"--shard", "2/2"});
  EXPECT_THAT(merge({1, 2}).out, HasSubstr("saved before: case 77 of seed 5"));
  expect_same("merged", "whole");
}

// --- Where it is merged --------------------------------------------------------------------------

// Kills: a merge that needs the backend that the shards were drawn by.
TEST_F(Shard, IsMergedWhereItsBackendIsNot) {
  for (int i = 1; i <= 2; ++i) run_small(i, 2, {"--backend", "damaged"});
  const Outcome outcome = run_program({"merge", folder_.path("shard1"), folder_.path("shard2"),
                                       "--output", folder_.path("merged")});
  EXPECT_EQ(outcome.code, 1) << outcome;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("damaged: unknown backend"),
                                 HasSubstr("using the samples that the shards inspected")));
  EXPECT_THAT(run_json("merged").at("inspections"), Not(IsEmpty()));
  EXPECT_EQ(merge({1, 2}).err, "");
}

TEST_F(Shard, SaysThatTheCorpusIsAnother) {
  for (int i = 1; i <= 2; ++i) run_small(i, 2);
  folder_.put("corpus/more.json", square_case());
  EXPECT_THAT(merge({1, 2}).err, HasSubstr("corpus: differs from the shards'; using the samples"));
}

TEST_F(Shard, LeavesGithubToTheMerge) {
  const auto script = [this](const std::string& arguments) {
    return run_shell("cd " + folder_.path() + "; GITHUB_ACTIONS=true GITHUB_STEP_SUMMARY=summary " +
                     "\"$DAMAGED\" " + arguments);
  };
  for (const char* index : {"1", "2"}) {
    const Outcome outcome = script(
        "run --backend damaged --property 'coverage-obeys*' --cases 3 --seed 1 --corpus "
        "corpus --shard " +
        std::string(index) + "/2 --output " + index);
    EXPECT_THAT(outcome.out, Not(HasSubstr("::error")));
  }
  EXPECT_EQ(folder_.content("summary"), "");
  EXPECT_THAT(script("merge 1 2").out, HasSubstr("::error file=rastercheck-out/"));
  EXPECT_EQ(folder_.content("summary"), folder_.content("rastercheck-out/summary.md"));
}

TEST_F(Shard, IsMergedFromFilesIntoTheFormatsAskedFor) {
  for (int i = 1; i <= 2; ++i) run_small(i, 2, {"--format", "json"});
  const Outcome outcome =
      run_program({"merge", folder_.path("shard1/run.json"), folder_.path("shard2/run.json"),
                   "--output", folder_.path("merged"), "--format", "markdown", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_EQ(json::parse(outcome.out).at("properties").at(0).at("checked"), 7);
  EXPECT_EQ(folder_.files("merged"), std::vector<std::string>{"summary.md"});
}

// --- What is refused -----------------------------------------------------------------------------

// Kills: overwriting a shard with the merged run.
TEST_F(Shard, IsNotWrittenOverByTheMerge) {
  const std::string shard = folder_.path("shard1");
  run_small(1, 1);
  const std::string before = folder_.content("shard1/run.json");
  ASSERT_NE(before, "");
  const Outcome outcome = run_program({"merge", shard, "--output", shard});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("run.json: is the input and would be overwritten"));
  EXPECT_EQ(folder_.content("shard1/run.json"), before);
}

TEST_F(Shard, RefusesInvalidShardNumbers) {
  for (const char* shard : {"0/3", "4/3", "1/0", "1/4097"}) {
    const Outcome outcome = run("out", {"--seed", "1", "--shard", shard});
    EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
    EXPECT_THAT(outcome.err, HasSubstr(std::string("--shard: ") + shard + ": "));
  }
  for (const char* shard : {"", "a/b", "3", "3/", "/3", "-1/3", "1/2/3", "1/3 "}) {
    const Outcome outcome = run("out", {"--seed", "1", "--shard", shard});
    EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
    EXPECT_THAT(outcome.err, HasSubstr("must be two integers, such as 2/7"));
  }
}

// Kills: shards that each choose their own seed, and so belong to different campaigns.
TEST_F(Shard, NeedsASeed) {
  const Outcome outcome = run("out", {"--shard", "1/3"});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("--shard: needs --seed"));
}

// Kills: a part compared with the baseline of the whole.
TEST_F(Shard, TakesItsCasesFromABaselineAndIsNotComparedWithIt) {
  ASSERT_EQ(run_small(1, 1, {"--keep-cases"}).code, 0);
  ASSERT_EQ(merge({1}).code, 0);
  ASSERT_EQ(run_damaged_program({"baseline", "save", folder_.path("merged"), "--output",
                                 folder_.path("baseline.json")})
                .code,
            0);
  for (const std::string shard : {"1", "2"}) {
    const Outcome outcome = run_damaged_program(arguments(
        "shard-" + shard, {"--shard", shard + "/2", "--baseline", folder_.path("baseline.json")}));
    EXPECT_EQ(outcome.code, 0) << outcome;
    EXPECT_THAT(outcome.out, HasSubstr("compared with the baseline once it is merged"));
  }
  ASSERT_EQ(run_damaged_program({"merge", folder_.path("shard-1"), folder_.path("shard-2"),
                                 "--output", folder_.path("both")})
                .code,
            0);
  EXPECT_EQ(
      run_damaged_program({"compare", folder_.path("baseline.json"), folder_.path("both")}).code,
      0);
}

TEST_F(Shard, MayHaveNothingToDo) {
  const Outcome outcome = run_small(40, 64);
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("Shard 40 of 64: it had no work to do"));
}

TEST_F(Shard, ThatIsMissingTwiceOrAlienIsRefused) {
  for (int i = 1; i <= 3; ++i) EXPECT_EQ(run_small(i, 3).code, 0);
  const auto error_of = [this](const std::vector<int>& shards) {
    const Outcome outcome = merge(shards);
    EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
    return outcome.err;
  };
  EXPECT_THAT(error_of({1, 3}), HasSubstr("shard 2 of 3 is missing"));
  EXPECT_THAT(error_of({2}), HasSubstr("shards 1 and 3 of 3 are missing"));
  EXPECT_THAT(error_of({1, 2, 2, 3}), HasSubstr("shard 2 of 3 is given twice"));
  EXPECT_EQ(run_shard(2, 3, {"--seed", "2", "--cases", "6", "--property", "coverage-obeys*"}).code,
            0);
  EXPECT_THAT(error_of({1, 2, 3}), HasSubstr("its seed is 2, not 1"));
  EXPECT_EQ(run("shard2", {"--cases", "1", "--property", "coverage-obeys*"}).code, 0);
  EXPECT_THAT(error_of({1, 2, 3}), HasSubstr("shard2/run.json: is not a shard"));
  EXPECT_THAT(error_of({4}), HasSubstr("shard4: cannot be read"));
}

// --- Interrupted ---------------------------------------------------------------------------------

TEST_F(Shard, ThatWasInterruptedIsRefusedAndGoesOn) {
  const std::vector<std::string> campaign{"--backend",  "damaged:slow",   "--seed",
                                          "3",          "--cases",        "120",
                                          "--property", "coverage-obeys*"};
  EXPECT_EQ(run("whole", campaign).code, 1);
  EXPECT_EQ(run_shard(1, 2, campaign).code, 1);
  {
    std::vector<std::string> second = arguments("shard2", campaign);
    second.insert(second.end(), {"--shard", "2/2"});
    RunningProgram program(second);
    wait_for_progress("shard2/unfinished.json");
    program.kill(SIGINT);
    program.wait();
  }
  const Outcome refused = merge({1, 2});
  EXPECT_TRUE(is_failure(refused, 2)) << refused;
  EXPECT_THAT(refused.err, HasSubstr("shard2/run.json: shard 2 of 2 was interrupted with "));

  const auto resume = [this](const std::string& shard) {
    return run_damaged_program(
        {"run", "--resume", "--shard", shard, "--output", folder_.path("shard2")});
  };
  const Outcome other = resume("1/2");
  EXPECT_TRUE(is_failure(other, 2)) << other;
  EXPECT_THAT(other.err, HasSubstr("the interrupted run is shard 2 of 2"));
  EXPECT_EQ(resume("2/2").code, 1);
  EXPECT_EQ(merge({1, 2}).code, 1);
  expect_same("merged", "whole");
}

}  // namespace
}  // namespace rastercheck::cli::shard_test
