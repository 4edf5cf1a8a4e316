#include "properties/inspect/gathered_inspections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "properties/campaign/campaign.h"
#include "properties/inspect/run_inspections.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::gathered_inspections_test {
namespace {

using testing::IsEmpty;

records::Run run_of(const std::optional<records::ShardNumber>& shard) {
  records::Run run;
  run.plan.seed = 1;
  TaskRunner runner({.seed = run.plan.seed, .shrinking = {0, std::nullopt}}, {square()});
  Findings all;
  records::Plan options;
  options.cases_per_law = 30;
  options.backends = {"cpu", "damaged"};
  options.laws = {std::string(kCoverageLaw), std::string(kValuesLaw)};
  options.shard = shard;
  for (const Task& task : tasks_of(options, 1)) merge(all, runner.run(task).value());
  run.records = all.records;
  run.counterexamples = all.counterexamples;
  const std::vector<cases::Case> corpus{square()};
  CaseSources sources;
  sources.corpus = corpus;
  CaseDrawer drawer({});
  run.inspections = inspect_run(run, sources, drawer);
  return run;
}

// Kills: the worst case of a shard shown as the worst of the run; an inspection of another shard's
// counterexample.
TEST(GatheredInspections, AreThoseOfTheRun) {
  const records::Run whole = run_of(std::nullopt);
  EXPECT_EQ(whole.inspections.front().occasion, records::Occasion::counterexample);
  EXPECT_EQ(whole.inspections.back().occasion, records::Occasion::worst);
  GatheredInspections gathered(whole);
  for (const std::uint64_t index : std::array<std::uint64_t, 3>{3, 1, 2}) {
    const records::Run part = run_of(records::ShardNumber{index, 3});
    EXPECT_NE(part.inspections, whole.inspections);
    gathered.add(part);
  }
  EXPECT_EQ(std::move(gathered).finish(), whole.inspections);
}

TEST(GatheredInspections, AreNoneOfNothing) {
  EXPECT_THAT(GatheredInspections(records::Run()).finish(), IsEmpty());
  EXPECT_THAT(GatheredInspections(run_of(std::nullopt)).finish(), IsEmpty());
}

// Kills: more inspections than a report has room for.
TEST(GatheredInspections, AreNoMoreThanOfAnyRun) {
  records::Run run;
  for (std::uint64_t i = 0; i < records::kMostInspections + 5; ++i) {
    records::Counterexample one;
    one.source = square();
    one.source.found = cases::Found{"law " + std::to_string(i), "cpu", "missing", 1, i};
    run.counterexamples.push_back(one);
    records::Inspection inspection;
    inspection.counterexample = i;
    run.inspections.push_back(inspection);
  }
  GatheredInspections gathered(run);
  gathered.add(run);
  EXPECT_EQ(std::move(gathered).finish().size(), records::kMostInspections);
}

}  // namespace
}  // namespace rastercheck::properties::gathered_inspections_test
