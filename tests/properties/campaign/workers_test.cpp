// Tasks in worker processes: those of the program with the damaged backends (damaged_kind.cpp), and
// scripts that are not workers.

#include "properties/campaign/workers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "cases/case_writer.h"
#include "properties/campaign/corpus.h"
#include "tests/properties/campaign/gathered.h"
#include "tests/properties/damaged_backend.h"
#include "tests/temporary_folder.h"

namespace rastercheck::properties::workers_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kCoverage = "coverage-obeys-the-contract";
const records::Plan kSmall{7, 25, {"cpu", "damaged"}, {kCoverage, "constants-stay-constant"}};

/// The part of kSmall's plan that a worker needs.
constexpr const char* kPlan =
    R"({"seed": 7, "cases_per_property": 25, "backends": ["cpu", "damaged"], "properties":
    ["coverage-obeys-the-contract", "constants-stay-constant"]})";

/// True if all child processes are gone and none is left as a zombie.
bool has_no_children() { return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD; }

Result<Findings> run_with(const std::vector<std::string>& command, int jobs = 2) {
  return gathered([&](const TaskDone& done) {
    return run_tasks_in_processes(command, jobs, tasks_of(kSmall, 0), done);
  });
}

/// The error of a run whose worker is a shell with this script.
std::string shell_error(const std::string& script) {
  const Result<Findings> found = run_with({"/bin/sh", "-c", script});
  return found ? "no error" : to_string(found.error());
}

class Workers : public testing::TestWithParam<int> {};

TEST_P(Workers, FindWhatOneProcessFinds) {
  const TemporaryFolder corpus;
  corpus.put("a.json", cases::to_json(square()));
  corpus.put("b.json", cases::to_json(square()));
  TaskRunner runner(kSmall, read_corpus(corpus.path()).value());
  const std::vector<Task> tasks = tasks_of(kSmall, 2);
  const Findings expected =
      gathered([&](const TaskDone& done) { return run_tasks(runner, tasks, done); }).value();
  EXPECT_FALSE(expected.counterexamples.empty());

  const std::vector<std::string> command{
      RASTERCHECK_DAMAGED_PROGRAM, "task-worker", "--plan", kPlan, "--corpus", corpus.path()};
  std::vector<int> told(tasks.size());
  const Result<Findings> found = gathered([&](const TaskDone& done) {
    return run_tasks_in_processes(command, GetParam(), tasks, [&](std::size_t task, Findings more) {
      ++told.at(task);
      return done(task, std::move(more));
    });
  });
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_EQ(*found, expected);
  EXPECT_THAT(told, testing::Each(1));
  EXPECT_TRUE(has_no_children());

  // Shrinking in processes also gives the same result.
  const std::vector<Task> shrinking = shrink_tasks(expected);
  const auto shrunk_here =
      gathered([&](const TaskDone& done) { return run_tasks(runner, shrinking, done); });
  const auto shrunk_there = gathered([&](const TaskDone& done) {
    return run_tasks_in_processes(command, GetParam(), shrinking, done);
  });
  EXPECT_FALSE(shrunk_here.value().counterexamples.empty());
  EXPECT_EQ(shrunk_there.value(), shrunk_here.value());
}

INSTANTIATE_TEST_SUITE_P(Jobs, Workers, testing::Values(1, 2, 3, 40));

TEST(WorkerProcesses, AreNoneWithoutTasks) {
  EXPECT_TRUE(run_tasks_in_processes({"/no/such/program"}, 2, {}, {}));
}

TEST(WorkerProcesses, ThatDieAreNamedWithTheirTask) {
  const Result<Findings> found = run_with({"/bin/false"}, 1);
  ASSERT_FALSE(found);
  EXPECT_EQ(to_string(found.error()),
            "worker: ended with exit code 1 while checking the property "
            "'coverage-obeys-the-contract' on cpu, cases 0 to 9");
  EXPECT_TRUE(has_no_children());
}

TEST(WorkerProcesses, ThatCrashAreNamedWithTheirSignal) {
  EXPECT_THAT(
      shell_error("read task; kill -s SEGV $$"),
      StartsWith("worker: was killed by signal Segmentation fault while checking the property"));
  EXPECT_TRUE(has_no_children());
}

// Kills: waiting for the end of a process that has no reason to end.
TEST(WorkerProcesses, ThatHangUpAndLiveOnAreEnded) {
  EXPECT_THAT(shell_error("exec sleep 100000 < /dev/null > /dev/null"),
              StartsWith("worker: was killed by signal Killed while checking the property"));
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
  const std::vector<Task> tasks{{"cpu", "no law", TaskKind::random, 0, 1}};
  const Result<void> found = run_tasks_in_processes(
      {RASTERCHECK_DAMAGED_PROGRAM, "task-worker", "--plan", kPlan}, 1, tasks, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(to_string(found.error()), "no law: no property is called this");
  EXPECT_TRUE(has_no_children());
}

// Kills: processes that are started again for each list of tasks; a process that goes on after an
// error.
TEST(WorkerProcesses, AreKeptForTheNextTasks) {
  const TemporaryFolder folder;
  const std::string script = "echo x >> " + folder.path("started") + R"(; exec "$0" "$@")";
  const std::vector<Task> tasks = tasks_of(kSmall, 0);
  TaskRunner runner(kSmall, {});
  const auto expected =
      gathered([&](const TaskDone& done) { return run_tasks(runner, tasks, done); }).value();
  TaskProcesses processes(
      {"/bin/sh", "-c", script, RASTERCHECK_DAMAGED_PROGRAM, "task-worker", "--plan", kPlan}, 2);
  for (int i = 0; i < 3; ++i) {
    const auto found = gathered([&](const TaskDone& done) { return processes.run(tasks, done); });
    ASSERT_TRUE(found) << to_string(found.error());
    EXPECT_EQ(*found, expected);
  }
  EXPECT_EQ(folder.content("started"), "x\nx\n");
  const std::vector<Task> wrong{{"cpu", "no law", TaskKind::random, 0, 1}};
  EXPECT_FALSE(processes.run(wrong, {}));
  EXPECT_TRUE(has_no_children());
}

// Kills: more tasks for an oracle that has a fault.
TEST(WorkerProcesses, GetNothingMoreToDoAfterAFault) {
  const std::string script =
      R"(while read task; do echo '{"records": [], "counterexamples": [], "fault": "f"}'; done)";
  int told = 0;
  const auto done = [&told](std::size_t, const Findings& found) {
    EXPECT_EQ(found.fault, "f");
    ++told;
    return !found.fault;
  };
  ASSERT_TRUE(run_tasks_in_processes({"/bin/sh", "-c", script}, 1, tasks_of(kSmall, 0), done));
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(has_no_children());
}

// Kills: a task that is lost, or waited for in vain, when no more results are wanted; a worker that
// is not told to hurry.
TEST(WorkerProcesses, AreAskedToHurryAndWaitedForWhereTheyShrink) {
  const TemporaryFolder folder;
  const std::string script = "read task; read hurry; echo hurried > " + folder.path("said") +
                             R"(; echo '{"records": [], "counterexamples": []}'; read more)";
  records::Counterexample subject;
  subject.source = square();
  subject.source.found = cases::Found{kCoverage, "cpu", "missing", 7, 0};
  const std::vector<Task> shrinking(2, {"cpu", kCoverage, TaskKind::shrink, 0, 1, subject});
  int told = 0;
  int asked = 0;
  const auto done = [&told](std::size_t task, const Findings&) {
    EXPECT_EQ(task, 0U);
    return ++told > 0;
  };
  ASSERT_TRUE(run_tasks_in_processes({"/bin/sh", "-c", script}, 1, shrinking, done,
                                     [&asked] { return ++asked > 2; }));
  EXPECT_EQ(told, 1);
  EXPECT_EQ(folder.content("said"), "hurried\n");
  EXPECT_TRUE(has_no_children());
}

// Kills: a campaign that ends only after the current case is drawn; a part of a task counted as the
// whole.
TEST(WorkerProcesses, AreEndedWhereTheyCheck) {
  int told = 0;
  int asked = 0;
  const auto done = [&told](std::size_t, const Findings&) { return ++told > 0; };
  ASSERT_TRUE(run_tasks_in_processes({"/bin/sh", "-c", "read task; exec sleep 600"}, 1,
                                     tasks_of(kSmall, 0), done, [&asked] { return ++asked > 2; }));
  EXPECT_EQ(told, 0);
  EXPECT_TRUE(has_no_children());
}

// Kills: workers that Ctrl-C ends before the main process has written down what they found.
TEST(WorkerProcesses, AreNotInTheProcessGroupOfTheOneThatStartedThem) {
  const TemporaryFolder folder;
  const std::string script =
      "read task; read -r pid name state parent group rest < /proc/$$/stat; echo $group > " +
      folder.path("group") + R"(; echo '{"records": [], "counterexamples": [], "fault": "f"}')";
  const auto done = [](std::size_t, const Findings&) { return false; };
  ASSERT_TRUE(run_tasks_in_processes({"/bin/sh", "-c", script}, 1, tasks_of(kSmall, 0), done));
  EXPECT_NE(std::stol(folder.content("group")), ::getpgrp());
}

}  // namespace
}  // namespace rastercheck::properties::workers_test
