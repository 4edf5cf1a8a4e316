#include "properties/campaign/shard_merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::shard_merge_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kLaw = "coverage-obeys-the-contract";

records::Counterexample found_at(std::uint64_t index) {
  records::Counterexample one;
  one.source = square();
  one.source.found = cases::Found{kLaw, "cpu", "missing", 1, index};
  one.violation_count = index;
  return one;
}

/// Shard `index` of 3. Each shard has checked 1000 cases, of which `index` reached a tie, and has
/// found a counterexample; the third shard's comes first.
records::Run shard(std::uint64_t index) {
  records::Run run;
  run.plan.seed = 1;
  run.plan.cases_per_law = 3000;
  run.plan.backends = {"cpu"};
  run.plan.laws = {kLaw};
  run.plan.keeps_cases = true;
  run.plan.shard = {index, 3};
  records::Shard& of_run = run.shard.emplace();
  of_run.corpus_digest = "0123456789abcdef";
  of_run.promises = {{"cpu", false, {}, true, {}}};
  records::Record& record =
      run.records[{kLaw, "cpu", records::AttributeKind::coverage, "ordinary"}];
  record.cases.checked = 1000;
  for (const Cover& cover : find_law(kLaw)->covers) record.labels[std::string(cover.label)] = 1000;
  record.labels["tie"] = index;
  run.cases.emplace()[{kLaw, "cpu", records::Origin::random, index}].found_digest = index;
  run.counterexamples = {found_at(10 - index)};
  run.unexpected = {
      {"cpu", "driver-" + std::to_string(index), kLaw, records::Staleness::wrong_list}};
  run.environment = {{"version", "1.2.3"},
                     {"machine", index == 2 ? "another" : "this"},
                     {"seconds", "1.5"},
                     {"jobs", "2"},
                     {"date", "2026-01-0" + std::to_string(index)}};
  return run;
}

Result<MergedRun> merged(const std::vector<records::Run>& runs) {
  ShardMerge merge;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Result<void> added = merge.add(runs[i], "file " + std::to_string(i + 1));
    if (!added) return tl::unexpected(added.error());
  }
  return std::move(merge).finish();
}

std::string error_of(const std::vector<records::Run>& runs) {
  const auto result = merged(runs);
  return result ? "was merged" : to_string(result.error());
}

TEST(ShardMerge, AddsUpWhatWasFound) {
  const MergedRun all = merged({shard(1), shard(2), shard(3)}).value();
  const records::Run& run = all.run;
  EXPECT_EQ(run.shard, std::nullopt);
  EXPECT_EQ(run.plan.seed, 1U);
  EXPECT_EQ(run.plan.cases_per_law, 3000U);
  EXPECT_TRUE(run.plan.keeps_cases);
  EXPECT_EQ(run.plan.shard, std::nullopt);
  ASSERT_THAT(run.records, SizeIs(1));
  EXPECT_EQ(run.records.begin()->second.cases.checked, 3000U);
  EXPECT_EQ(run.records.begin()->second.labels.at("tie"), 6U);
  EXPECT_THAT(run.cases.value(), SizeIs(3));
  EXPECT_THAT(run.counterexamples, ElementsAre(found_at(7)));
  EXPECT_THAT(run.unexpected, SizeIs(3));
  EXPECT_THAT(all.files, SizeIs(3));
}

// Kills: labels judged by a single shard, or by the contracts on the machine that merges.
TEST(ShardMerge, JudgesLabelsOfTheWhole) {
  const records::Run run = merged({shard(1), shard(2), shard(3)}).value().run;
  ASSERT_THAT(run.unreached, SizeIs(1));
  EXPECT_EQ(run.unreached[0].label, "tie");
  EXPECT_EQ(run.unreached[0].reached, 6U);
  EXPECT_EQ(run.unreached[0].checked, 3000U);
  std::vector<records::Run> lax{shard(1), shard(2), shard(3)};
  for (records::Run& one : lax) one.shard->promises[0].has_limits = true;
  EXPECT_THAT(merged(lax).value().run.unreached, IsEmpty());
}

TEST(ShardMerge, TakesThemInAnyOrder) {
  const records::Run run = merged({shard(1), shard(2), shard(3)}).value().run;
  std::array<std::uint64_t, 3> order{1, 2, 3};
  while (std::next_permutation(order.begin(), order.end())) {
    EXPECT_EQ(merged({shard(order[0]), shard(order[1]), shard(order[2])}).value().run, run);
  }
}

TEST(ShardMerge, SaysWhereTheyRan) {
  const auto environment = merged({shard(3), shard(2), shard(1)}).value().run.environment;
  EXPECT_EQ(environment, (std::map<std::string, std::string>{{"version", "1.2.3"},
                                                             {"machine", "this, another"},
                                                             {"seconds", "4.5"},
                                                             {"jobs", "2"},
                                                             {"date", "2026-01-03"},
                                                             {"shards", "3"}}));
}

TEST(ShardMerge, TakesWhatOnlyTheFirstHas) {
  records::Run first = shard(1);
  first.shard->scene_digest = "00000000000000ff";
  first.shard->saved = {square()};
  first.scenes = {{"bunny", "cpu", 3, 2, 2, 1, false, {}}};
  first.pictures = {{"bunny", "A bunny.", 1, 1, "png"}};
  const MergedRun all = merged({shard(3), first, shard(2)}).value();
  EXPECT_EQ(all.common.scene_digest, "00000000000000ff");
  EXPECT_THAT(all.common.saved, SizeIs(1));
  EXPECT_EQ(all.run.scenes, first.scenes);
  EXPECT_EQ(all.run.pictures, first.pictures);
}

// Kills: a part of a campaign that looks complete.
TEST(ShardMerge, NamesWhatIsMissing) {
  EXPECT_EQ(error_of({}), "merge: no shards given");
  EXPECT_EQ(error_of({shard(1), shard(3)}), "merge: shard 2 of 3 is missing");
  EXPECT_EQ(error_of({shard(2)}), "merge: shards 1 and 3 of 3 are missing");
  EXPECT_EQ(error_of({shard(3)}), "merge: shards 1 and 2 of 3 are missing");
  records::Run of_seven = shard(2);
  of_seven.plan.shard->count = 7;
  EXPECT_EQ(error_of({of_seven}), "merge: shards 1 and 3 to 7 of 7 are missing");
}

TEST(ShardMerge, RefusesOneThatIsThereTwice) {
  EXPECT_EQ(error_of({shard(1), shard(2), shard(2)}),
            "file 3: shard 2 of 3 is given twice, also as file 2");
}

TEST(ShardMerge, RefusesWhatIsNoShardOrNotWhole) {
  records::Run whole = shard(1);
  whole.shard.reset();
  EXPECT_EQ(error_of({whole}), "file 1: is not a shard: the run had no --shard option");
  records::Run interrupted = shard(2);
  interrupted.cases_left = 120;
  EXPECT_EQ(error_of({shard(1), interrupted}),
            "file 2: shard 2 of 3 was interrupted with 120 cases not checked; `rastercheck run "
            "--resume` continues it");
  interrupted.cases_left = 0;
  interrupted.shard->is_whole = false;
  EXPECT_THAT(error_of({interrupted}), HasSubstr("before all counterexamples were shrunk"));
  records::Run nameless = shard(1);
  nameless.counterexamples[0].source.found.reset();
  EXPECT_THAT(error_of({nameless}), HasSubstr("does not say how it was found"));
}

// Kills: merging shards of two different campaigns.
TEST(ShardMerge, NamesTheDifferenceOfAnotherCampaign) {
  const auto error = [](const std::function<void(records::Run&)>& change) {
    records::Run other = shard(2);
    change(other);
    return error_of({shard(1), other, shard(3)});
  };
  const std::string start = "file 2: belongs to another campaign than file 1: ";
  EXPECT_EQ(error([](records::Run& run) { run.environment["version"] = "1.2.4"; }),
            start + "its program's version is 1.2.4, not 1.2.3");
  EXPECT_EQ(error([](records::Run& run) { run.environment["architecture"] = "aarch64"; }),
            start + "its architecture is aarch64, not ");
  EXPECT_EQ(error([](records::Run& run) { run.rules_version = 9; }),
            start + "its rules version is 9, not 1");
  EXPECT_EQ(error([](records::Run& run) { run.plan.shard->count = 2; }),
            start + "its number of shards is 2, not 3");
  EXPECT_EQ(error([](records::Run& run) { run.plan.seed = 2; }), start + "its seed is 2, not 1");
  EXPECT_EQ(error([](records::Run& run) { run.plan.cases_per_law = 2; }),
            start + "its number of cases of each property is 2, not 3000");
  EXPECT_EQ(error([](records::Run& run) {
              run.plan.backends = {"cpu", "gl"};
            }),
            start + "its backends include 'gl', which the other shard lacks");
  EXPECT_EQ(error([](records::Run& run) { run.plan.laws = {}; }),
            start + "its properties lack '" + kLaw + "', which the other shard has");
  EXPECT_EQ(error([](records::Run& run) { run.plan.ignores_known = true; }),
            start + "its options include '--no-known', which the other shard lacks");
  EXPECT_EQ(error([](records::Run& run) { run.plan.keeps_cases = false; }),
            start + "its options lack '--keep-cases', which the other shard has");
  EXPECT_EQ(error([](records::Run& run) { run.plan.scene = "bunny"; }),
            start + "its scene is 'bunny', not ''");
  EXPECT_EQ(error([](records::Run& run) {
              run.plan.contract = {"lax.json", {}};
            }),
            start + "its options include '--contract', which the other shard lacks");
  const auto held = [](bool keeps) {
    records::Run run = shard(keeps ? 1 : 2);
    run.plan.contract.emplace().file = "lax.json";
    run.plan.contract->terms.keeps_constants = keeps;
    return run;
  };
  EXPECT_EQ(error_of({held(true), held(false)}), start + "its contract file is different");
  EXPECT_EQ(error([](records::Run& run) { run.shard->corpus_digest = "x\n"; }),
            start + "its corpus' digest is x\\n, not 0123456789abcdef");
  EXPECT_EQ(error([](records::Run& run) {
              run.known.push_back({"cpu", "known.json", "22.3.6", {}, {}});
            }),
            start + "its known drivers include 'cpu 22.3.6', which the other shard lacks");
  EXPECT_EQ(error([](records::Run& run) { run.shard->known_digest = "1"; }),
            start + "its lists of known defects are different");
  EXPECT_EQ(error([](records::Run& run) { run.shard->promises[0].has_limits = true; }),
            start + "cpu has another contract in the other shard");
  EXPECT_EQ(error([](records::Run& run) { run.shard->promises.clear(); }),
            start + "a backend has another contract in the other shard");
}

}  // namespace
}  // namespace rastercheck::properties::shard_merge_test
