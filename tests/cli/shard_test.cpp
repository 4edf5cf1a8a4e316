// A campaign in parts, `run --shard`, and these together again, `merge`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string part(int index, int count) {
  return std::to_string(index) + "/" + std::to_string(count);
}

/// Without the line of the seed, which says how long it took.
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
  /// A small one: the law of coverage, six cases.
  Outcome run_small(int index, int count, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--seed", "1", "--cases", "6", "--property", "coverage obeys*"});
    return run_shard(index, count, more);
  }
  Outcome merge(const std::vector<int>& shards, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"merge", "--output", folder_.path("merged")});
    for (const int shard : shards) more.push_back(folder_.path("shard" + std::to_string(shard)));
    return run_damaged_program(more);
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

// Kills: a case checked twice or by no shard, a counterexample that is not the first, labels that
// no shard can judge, inspections of a part taken for those of the whole.
TEST_P(InShards, IsTheRunThatOneProgramMakes) {
  const auto [count, jobs] = GetParam();
  const std::vector<std::string> campaign{"--seed",
                                          "5",
                                          "--cases",
                                          "9",
                                          "--backend",
                                          "damaged",
                                          "--backend",
                                          "cpu",
                                          "--backend",
                                          "method:screen-linear",
                                          "--keep-cases",
                                          "--jobs",
                                          jobs,
                                          "--scene",
                                          source_file("cases/corpus/nearest.json")};
  const Outcome whole = run("merged-not", campaign);
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
  EXPECT_TRUE(without_environment(folder_.content("merged/run.json")) ==
              without_environment(folder_.content("merged-not/run.json")));
  EXPECT_EQ(folder_.files("merged"), folder_.files("merged-not"));
  for (const std::string& file : folder_.files("merged/counterexamples")) {
    EXPECT_EQ(folder_.content("merged/counterexamples/" + file),
              folder_.content("merged-not/counterexamples/" + file));
  }
  std::string printed = whole.out;
  for (std::size_t at = 0; (at = printed.find("merged-not", at)) != std::string::npos;) {
    printed.replace(at, 10, "merged");
  }
  EXPECT_EQ(without_time(merged.out), without_time(printed));
  const json document = run_json("merged");
  EXPECT_THAT(document.at("counterexamples"), Not(IsEmpty()));
  EXPECT_THAT(document.at("inspections"), Not(IsEmpty()));
  EXPECT_THAT(document.at("pictures"), SizeIs(6));
  EXPECT_EQ(document.at("environment").at("shards"), std::to_string(count));
}

}  // namespace
}  // namespace rastercheck::cli
