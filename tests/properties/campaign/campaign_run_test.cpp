#include "properties/campaign/campaign_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include "cases/files.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::properties::campaign_run_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage-obeys-the-contract";

/// A campaign of 25 random cases that all fail, in a temporary folder.
class CampaignRunTest : public testing::Test {
 protected:
  CampaignRunTest() {
    start_.plan = {7, 25, {"damaged"}, {kCoverage}};
    start_.program = "1";
  }

  CampaignRun run(const Checkpoint& start) {
    return {start, folder_.path(), 0, [this](const Error& error) { warnings_.push_back(error); }};
  }
  /// Runs tasks in this process until `most` are done, and then the first cases of one more task.
  Execute execute(std::size_t most = 1000) {
    return [this, most](const std::vector<Task>& tasks, const TaskDone& done) {
      std::size_t count = 0;
      std::size_t asked = 0;
      const TaskDone counted = [&](std::size_t task, Findings found) {
        ++count;
        return done(task, std::move(found));
      };
      constexpr std::size_t kFirstCases = 3;
      const auto is_to_end = [&] { return count == most && ++asked > kFirstCases; };
      return run_tasks(runner_, tasks, counted, is_to_end);
    };
  }
  Checkpoint kept() const {
    return parse_checkpoint(folder_.content("unfinished.json"), "kept").value();
  }

  TemporaryFolder folder_;
  Checkpoint start_;
  TaskRunner runner_{{.seed = 7}, {}};
  std::vector<Error> warnings_;
};

// Kills: findings of finished tasks that are not kept; kept findings of tasks that are not
// finished.
TEST_F(CampaignRunTest, KeepsWhatIsDoneAndGoesOn) {
  CampaignRun whole = run(start_);
  ASSERT_TRUE(whole.begin());
  EXPECT_EQ(whole.cases_left(), 25U);
  std::vector<std::uint64_t> told;
  ASSERT_TRUE(whole.check_cases(execute(), [&told](std::uint64_t done, std::uint64_t all) {
    EXPECT_EQ(all, 25U);
    told.push_back(done);
  }));
  EXPECT_THAT(told, ElementsAre(10, 20, 25));
  EXPECT_EQ(whole.cases_left(), 0U);

  CampaignRun part = run(start_);
  ASSERT_TRUE(part.check_cases(execute(1), {}));
  EXPECT_EQ(part.cases_left(), 15U);
  part.save();
  EXPECT_THAT(kept().is_done, ElementsAre(true, false, false));
  EXPECT_EQ(kept().findings, part.findings());
  CampaignRun rest = run(kept());
  told.clear();
  ASSERT_TRUE(rest.check_cases(
      execute(), [&told](std::uint64_t done, std::uint64_t) { told.push_back(done); }));
  EXPECT_THAT(told, ElementsAre(20, 25));
  EXPECT_EQ(rest.findings(), whole.findings());
  rest.remove();
  EXPECT_THAT(folder_.files(), IsEmpty());
  EXPECT_THAT(warnings_, IsEmpty());
}

// Kills: a counterexample that is lost with the process that found it.
TEST_F(CampaignRunTest, KeepsACounterexampleAtOnceOrAfterASecond) {
  CampaignRun run_here = run(start_);
  ASSERT_TRUE(run_here.begin());
  EXPECT_THAT(kept().findings.counterexamples, IsEmpty());
  const Execute and_look = [this](const std::vector<Task>& tasks, const TaskDone& done) {
    Findings found = runner_.run(tasks[0]).value();
    // Where writing is slow, news may wait, but no longer than this.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    done(0, std::move(found));
    EXPECT_THAT(kept().findings.counterexamples, Not(IsEmpty()));
    return Result<void>();
  };
  ASSERT_TRUE(run_here.check_cases(and_look, {}));
}

// Kills: an interrupted search for a smaller case, kept in place of the complete search that would
// follow.
TEST_F(CampaignRunTest, KeepsWhatIsShrunkUnlessItWasCutShort) {
  CampaignRun run_here = run(start_);
  ASSERT_TRUE(run_here.check_cases(execute(), {}));
  EXPECT_FALSE(run_here.is_shrunk());
  ASSERT_TRUE(run_here.shrink(execute(), [] { return true; }, {}));
  run_here.save();
  EXPECT_TRUE(run_here.findings().counterexamples.at(0).shrinking);
  EXPECT_FALSE(kept().findings.counterexamples.at(0).shrinking);
  EXPECT_FALSE(run_here.is_shrunk());

  CampaignRun rest = run(kept());
  std::vector<std::uint64_t> told;
  ASSERT_TRUE(rest.shrink(execute(), {}, [&told](std::uint64_t done, std::uint64_t all) {
    told.push_back(done);
    EXPECT_EQ(all, 3U);
  }));
  EXPECT_THAT(told, ElementsAre(1, 2, 3));
  EXPECT_TRUE(rest.is_shrunk());
  EXPECT_TRUE(kept().findings.counterexamples.at(0).shrinking->is_least);
  EXPECT_EQ(kept().findings, rest.findings());
}

// Kills: a scene that is counted twice in a resumed run.
TEST_F(CampaignRunTest, LeavesTheSceneOutOfTheCheckpoint) {
  CampaignRun run_here = run(start_);
  Findings scene;
  scene.records[{kCoverage, "damaged", records::AttributeKind::coverage, "scene x"}].cases.checked =
      1;
  run_here.add_scene(scene);
  run_here.save();
  EXPECT_THAT(run_here.findings().records, SizeIs(1));
  EXPECT_THAT(kept().findings.records, IsEmpty());
}

// Kills: a fault of the oracle from which the next run continues.
TEST_F(CampaignRunTest, EndsAtAFault) {
  CampaignRun run_here = run(start_);
  int tasks_done = 0;
  const Execute faulty = [&](const std::vector<Task>& tasks, const TaskDone& done) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      Findings findings;
      findings.fault = "wrong";
      ++tasks_done;
      if (!done(i, findings)) break;
    }
    return Result<void>();
  };
  ASSERT_TRUE(run_here.check_cases(faulty, {}));
  EXPECT_EQ(tasks_done, 1);
  EXPECT_EQ(run_here.findings().fault, "wrong");
  run_here.save();
  EXPECT_EQ(kept().findings.fault, std::nullopt);
  EXPECT_THAT(kept().is_done, testing::Each(false));
}

// Kills: one warning for each of ten thousand tasks.
TEST_F(CampaignRunTest, WarnsOnceWhereItCannotWrite) {
  std::filesystem::create_directories(folder_.path("unfinished.json"));
  CampaignRun run_here = run(start_);
  const Result<void> begun = run_here.begin();
  ASSERT_FALSE(begun);
  EXPECT_THAT(to_string(begun.error()), HasSubstr("unfinished.json: cannot be written: "));
  ASSERT_TRUE(run_here.check_cases(execute(), {}));
  run_here.save();
  ASSERT_THAT(warnings_, SizeIs(1));
  EXPECT_THAT(warnings_[0].reason, HasSubstr("the run continues"));
  EXPECT_EQ(run_here.cases_left(), 0U);
}

}  // namespace
}  // namespace rastercheck::properties::campaign_run_test
