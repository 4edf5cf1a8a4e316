#include "properties/campaign/side_by_side.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/case_writer.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/frozen_case.h"
#include "records/side_by_side.h"
#include "tests/properties/campaign/gathered.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::side_by_side_test {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kLaw = "coverage-obeys-the-contract";

/// A plan of two backends, of which the second draws one sample for each pixel only.
records::Plan with_limits() {
  records::Plan plan;
  plan.seed = 3;
  plan.cases_per_law = 30;
  plan.backends = {"cpu", "damaged"};
  plan.laws = {kLaw};
  plan.capabilities["damaged"].sample_counts = {1};
  return plan;
}

std::vector<cases::Case> corpus() {
  cases::Case multisampled = square();
  multisampled.framebuffer.samples = 4;
  return {square(), multisampled};
}

Findings checked(const records::Plan& plan) {
  TaskRunner runner(plan, corpus());
  const std::vector<Task> tasks = tasks_of(plan, corpus().size());
  return gathered([&](const TaskDone& done) { return run_tasks(runner, tasks, done); }).value();
}

// Kills: comparing two backends on cases that differ; leaving out cases that are the same on both.
TEST(UnlikeCases, AreThoseThatWereMadeToFit) {
  const records::Plan plan = with_limits();
  const Findings findings = checked(plan);
  ASSERT_TRUE(findings.outcomes);
  EXPECT_TRUE(findings.outcomes->at({kLaw, "cpu", records::Origin::random}).unlike.empty());
  const auto& corpus_cases = findings.outcomes->at({kLaw, "damaged", records::Origin::corpus});
  EXPECT_EQ(corpus_cases.unlike.at("cpu"), records::IndexSet({{1, 1}}));
  const auto& random = findings.outcomes->at({kLaw, "damaged", records::Origin::random});
  const records::IndexSet& unlike = random.unlike.at("cpu");
  std::size_t same = 0;
  for (const std::uint64_t index : judged_of(random).first(100)) {
    const auto here =
        frozen_case({kLaw, "damaged", records::Origin::random, index}, plan, corpus());
    const auto there = frozen_case({kLaw, "cpu", records::Origin::random, index}, plan, corpus());
    const bool is_same = cases::to_json(here.value()) == cases::to_json(there.value());
    EXPECT_EQ(unlike.contains(index), !is_same) << index;
    same += is_same ? 1 : 0;
  }
  EXPECT_GT(same, 0U);
  EXPECT_GT(unlike.count(), 0U);
}

TEST(UnlikeCases, AreNotKeptForOneBackend) {
  records::Plan plan = with_limits();
  plan.backends = {"damaged"};
  EXPECT_FALSE(checked(plan).outcomes);
}

// Kills: a saved case on which the backends agree, or of which the law makes other choices.
TEST(Differences, AreTheFirstCasesOnWhichBackendsDiffer) {
  records::Run run;
  run.plan = with_limits();
  run.outcomes = checked(run.plan).outcomes;
  const std::vector<records::Difference> all = differences_of(run, corpus());
  ASSERT_THAT(all, SizeIs(1));
  const records::Difference& one = all[0];
  EXPECT_EQ(one.right, "cpu");
  EXPECT_EQ(one.origin, records::Origin::corpus);
  EXPECT_EQ(one.source.found, (cases::Found{kLaw, "damaged", "", 3, 0}));
  EXPECT_TRUE(one.source.choices);
  const Law& law = *find_law(kLaw);
  const auto count = [&](const std::string& backend) {
    return check_law(law, one.source, *backends::make_backend(backend).value(), 0)->violation_count;
  };
  EXPECT_GT(count("damaged"), 0U);
  EXPECT_EQ(count("cpu"), 0U);
  // Without the corpus its cases cannot be made again.
  EXPECT_THAT(differences_of(run, {}), IsEmpty());
}

}  // namespace
}  // namespace rastercheck::properties::side_by_side_test
