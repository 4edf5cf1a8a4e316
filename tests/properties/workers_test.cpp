// Tasks in processes: of the program with the damaged backends (damaged_kind.cpp), and of scripts
// that are no workers.

#include "properties/workers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <filesystem>

#include "cases/case_writer.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::properties {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kCoverage = "coverage obeys the contract";
const CampaignOptions kSmall{7, 25, {"cpu", "damaged"}, {kCoverage, "constants stay constant"}};

/// Whether every process is gone, and none left a zombie.
bool has_no_children() { return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD; }

Result<Findings> run_with(const std::vector<std::string>& command, int jobs = 2) {
  return run_tasks_in_processes(command, jobs, tasks_of(kSmall, 0), {});
}

/// What a shell as a worker comes to.
std::string shell_error(const std::string& script) {
  const Result<Findings> found = run_with({"/bin/sh", "-c", script});
  return found ? "no error" : to_string(found.error());
}

class Workers : public testing::TestWithParam<int> {};

TEST_P(Workers, FindWhatOneProcessFinds) {
  const TemporaryFolder corpus;
  corpus.put("a.json", cases::to_json(square()));
  corpus.put("b.json", cases::to_json(square()));
  TaskRunner runner(kSmall.seed, read_corpus(corpus.path()).value());
  const std::vector<Task> tasks = tasks_of(kSmall, 2);
  const Findings expected = run_tasks(runner, tasks, {}).value();
  EXPECT_FALSE(expected.counterexamples.empty());

  std::uint64_t told = 0;
  const Result<Findings> found = run_tasks_in_processes(
      {RASTERCHECK_DAMAGED_PROGRAM, "worker", "--seed", "7", "--corpus", corpus.path()}, GetParam(),
      tasks, [&told](std::uint64_t done, std::uint64_t all) {
        EXPECT_GT(done, told);
        EXPECT_EQ(all, 2U * 2U * (25U + 2U));
        told = done;
      });
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_EQ(*found, expected);
  EXPECT_EQ(told, 2U * 2U * (25U + 2U));
  EXPECT_TRUE(has_no_children());
}

INSTANTIATE_TEST_SUITE_P(Jobs, Workers, testing::Values(1, 2, 3, 40));

TEST(WorkerProcesses, AreNoneWithoutTasks) {
  EXPECT_EQ(run_tasks_in_processes({"/no/such/program"}, 2, {}, {}).value(), Findings());
}

TEST(WorkerProcesses, ThatDieAreNamedWithTheirTask) {
  const Result<Findings> found = run_with({"/bin/false"}, 1);
  ASSERT_FALSE(found);
  EXPECT_EQ(to_string(found.error()),
            "worker: ended with exit code 1 at the law 'coverage obeys the contract' with cpu, "
            "cases 0 to 9");
  EXPECT_TRUE(has_no_children());
}

TEST(WorkerProcesses, ThatCrashAreNamedWithTheirSignal) {
  EXPECT_THAT(shell_error("read task; kill -s SEGV $$"),
              StartsWith("worker: ended by signal Segmentation fault at the law"));
  EXPECT_TRUE(has_no_children());
}

// Kills: waiting for the end of a process that has no reason to end.
TEST(WorkerProcesses, ThatHangUpAndLiveOnAreEnded) {
  EXPECT_THAT(shell_error("exec sleep 100000 < /dev/null > /dev/null"),
              StartsWith("worker: ended by signal Killed at the law"));
  EXPECT_TRUE(has_no_children());
}

TEST(WorkerProcesses, ThatAnswerRubbishAreEnded) {
  EXPECT_THAT(shell_error("read task; echo rubbish; exec sleep 100000"),
              StartsWith("worker: 1:1: not valid JSON"));
  EXPECT_TRUE(has_no_children());
}

TEST(WorkerProcesses, ThatCannotBeStartedAreNamed) {
  EXPECT_EQ(to_string(run_with({"/no/such/program"}).error()),
            "/no/such/program: cannot be started: No such file or directory");
  const TemporaryFolder folder;
  const std::string script = folder.put("script", "#!/bin/sh\n");
  EXPECT_EQ(to_string(run_with({script}).error()),
            script + ": cannot be started: Permission denied");
  EXPECT_TRUE(has_no_children());
}

TEST(WorkerProcesses, PassOnWhatIsWrongWithATask) {
  const std::vector<Task> tasks{{"cpu", "no law", false, 0, 1}};
  const Result<Findings> found =
      run_tasks_in_processes({RASTERCHECK_DAMAGED_PROGRAM, "worker", "--seed", "7"}, 1, tasks, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(to_string(found.error()), "no law: there is no law of that name");
  EXPECT_TRUE(has_no_children());
}

// Kills: more tasks for an oracle that is wrong.
TEST(WorkerProcesses, GetNothingMoreToDoAfterAFault) {
  const std::string script =
      R"(while read task; do echo '{"records": [], "counterexamples": [], "fault": "f"}'; done)";
  int told = 0;
  const Result<Findings> found = run_tasks_in_processes(
      {"/bin/sh", "-c", script}, 1, tasks_of(kSmall, 0), [&told](auto, auto) { ++told; });
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_EQ(found->fault, "f");
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(has_no_children());
}

}  // namespace
}  // namespace rastercheck::properties
