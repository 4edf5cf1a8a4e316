// Runs that do not finish, or cannot write what they found: no finding is lost.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program.h"
#include "tests/reports/report_files.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::interrupted_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class Interrupted : public testing::TestWithParam<const char*> {
 protected:
  Interrupted() { folder_.put("corpus/square.json", square_case()); }

  std::string out(const std::string& name = "") const {
    return folder_.path(name.empty() ? "out" : "out/" + name);
  }

  /// A run that takes at least half a second and finds something from its first case on.
  std::vector<std::string> arguments(const std::string& output, int cases = 120) const {
    const std::string count = std::to_string(cases);
    return {"run",
            "--backend",
            "damaged:slow",
            "--seed",
            "3",
            "--cases",
            count,
            "--property",
            "coverage-obeys-the-contract",
            "--corpus",
            folder_.path("corpus"),
            "--output",
            folder_.path(output),
            "--jobs",
            GetParam()};
  }

  /// Waits until some of the cases are done and kept.
  void wait_for_progress() const {
    using std::chrono::steady_clock;
    const auto late = steady_clock::now() + std::chrono::minutes(5);
    while (steady_clock::now() < late) {
      const json kept = json::parse(folder_.content("out/unfinished.json"), nullptr, false);
      if (!kept.is_discarded() && !kept.at("done").empty()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    FAIL() << "no progress";
  }

  Outcome resume() const {
    return run_damaged_program({"run", "--resume", "--output", out(), "--jobs", GetParam()});
  }

  /// Expects that the unfinished run can be resumed, and then gives the result of an uninterrupted
  /// run.
  void expect_goes_on() const {
    ASSERT_TRUE(std::filesystem::exists(out("unfinished.json")));
    const Outcome resumed = resume();
    EXPECT_EQ(resumed.code, 1) << resumed;
    const Outcome whole = run_damaged_program(arguments("whole"));
    EXPECT_EQ(whole.code, 1) << whole;
    EXPECT_TRUE(without_environment(folder_.content("out/run.json")) ==
                without_environment(folder_.content("whole/run.json")));
    EXPECT_EQ(folder_.files("out"), folder_.files("whole"));
    EXPECT_THAT(
        folder_.files("whole"),
        testing::Contains("counterexamples/coverage-obeys-the-contract-damaged-slow-missing.json"));
  }

  TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Jobs, Interrupted, testing::Values("1", "2"));

// Kills: findings that exist only in memory.
TEST_P(Interrupted, ByKillGoesOn) {
  RunningProgram program(arguments("out"));
  wait_for_progress();
  program.kill(SIGKILL);
  EXPECT_EQ(program.wait().code, -SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(out("run.json")));
  expect_goes_on();
}

// Kills: Ctrl-C that discards the findings, or reports a part as the whole.
TEST_P(Interrupted, OnceWritesWhatItHas) {
  RunningProgram program(arguments("out", 100000));
  wait_for_progress();
  program.kill(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 1) << outcome;  // violated in the cases that it checked
  EXPECT_THAT(outcome.err, HasSubstr("rastercheck: stopping; press Ctrl-C again to stop at once. "
                                     "`rastercheck run --resume --output " +
                                     out() + "` continues the run.\n"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("The run ended early: "), HasSubstr("Again: ")));
  const json run = json::parse(folder_.content("out/run.json"));
  EXPECT_GT(run.at("cases_left"), 0);
  // One, or more where the cases done before the signal fail in several ways.
  EXPECT_FALSE(run.at("counterexamples").empty());
  EXPECT_EQ(folder_.files("out/counterexamples").size(), run.at("counterexamples").size());
  EXPECT_THAT(folder_.content("out/summary.md"), HasSubstr("The run ended early: "));
  EXPECT_THAT(folder_.content("out/report.html"), HasSubstr("The run ended early: "));
  EXPECT_TRUE(std::filesystem::exists(out("unfinished.json")));
}

TEST_P(Interrupted, OnceGoesOn) {
  RunningProgram program(arguments("out"));
  wait_for_progress();
  program.kill(SIGTERM);
  EXPECT_EQ(program.wait().code, 1);
  expect_goes_on();
}

// Kills: a signal that waits until a drawing is finished.
TEST_P(Interrupted, EndsWhateverIsBeingDrawn) {
  std::vector<std::string> stuck = arguments("out");
  std::replace(stuck.begin(), stuck.end(), std::string("damaged:slow"),
               std::string("damaged:stuck"));
  RunningProgram program(stuck);
  while (!std::filesystem::exists(out("unfinished.json"))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));  // until it is drawing
  program.kill(SIGTERM);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 130) << outcome;
  // With several processes, the others are ended and the reports written; a single process that is
  // drawing can only end.
  const bool is_one = GetParam() == std::string("1");
  EXPECT_EQ(outcome.err.find("stopped before its reports were written") != std::string::npos,
            is_one);
  EXPECT_EQ(std::filesystem::exists(out("run.json")), !is_one);
  EXPECT_TRUE(std::filesystem::exists(out("unfinished.json")));
}

TEST_P(Interrupted, TwiceEndsAtOnceAndGoesOn) {
  RunningProgram program(arguments("out"));
  wait_for_progress();
  program.kill(SIGINT);
  program.kill(SIGINT);
  const int code = program.wait().code;
  EXPECT_TRUE(code == -SIGINT || code == 1) << code;  // 1: ended before signal 2
  if (std::filesystem::exists(out("unfinished.json"))) expect_goes_on();
}

// Kills: findings lost when a terminal is closed; nohup without effect.
TEST_P(Interrupted, ByAClosedTerminalGoesOnUnlessThatIsIgnored) {
  const auto before = std::signal(SIGHUP, SIG_DFL);
  {
    RunningProgram program(arguments("out", 100000));
    wait_for_progress();
    program.kill(SIGHUP);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.code, 1) << outcome;
    EXPECT_THAT(outcome.out, HasSubstr("The run ended early: "));
    EXPECT_TRUE(std::filesystem::exists(out("unfinished.json")));
  }
  std::filesystem::remove_all(out());
  std::signal(SIGHUP, SIG_IGN);
  {
    RunningProgram program(arguments("out"));
    wait_for_progress();
    program.kill(SIGHUP);
    const Outcome outcome = program.wait();
    EXPECT_THAT(outcome.out, Not(HasSubstr("The run ended early: ")));
    EXPECT_FALSE(std::filesystem::exists(out("unfinished.json")));
  }
  std::signal(SIGHUP, before);
}

// Kills: exit code 0 for a run that was cut short.
TEST_P(Interrupted, BeforeAnythingWasViolatedIsNotOk) {
  std::vector<std::string> held = arguments("out", 1000000);
  held[2] = "cpu";
  RunningProgram program(held);
  wait_for_progress();
  program.kill(SIGINT);
  EXPECT_EQ(program.wait().code, 130);
}

// Kills: deleting a killed run's counterexamples when the next run starts.
TEST_P(Interrupted, ByKillLeavesItsCounterexamplesToTheNextRun) {
  {
    RunningProgram program(arguments("out"));
    wait_for_progress();
  }
  std::vector<std::string> next = arguments("out", 3);
  next[2] = "cpu";
  const Outcome outcome = run_damaged_program(next);
  EXPECT_EQ(outcome.code, 0) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("an unfinished run, which this one replaces"));
  // One, or more if the run had time for it.
  const std::vector<std::string> kept = folder_.files("out/counterexamples");
  EXPECT_THAT(kept, Contains("earlier/coverage-obeys-the-contract-damaged-slow-missing.json"));
  EXPECT_THAT(outcome.err,
              HasSubstr("counterexamples kept from it: " + std::to_string(kept.size()) + "\n"));
}

TEST_P(Interrupted, GoesOnOnlyAsItWasBegun) {
  const Outcome nothing = resume();
  EXPECT_TRUE(is_failure(nothing, 2)) << nothing;
  EXPECT_THAT(nothing.err, HasSubstr("unfinished.json: does not exist: no run was interrupted"));
  {
    RunningProgram program(arguments("out"));
    wait_for_progress();
  }
  const Outcome other = run_damaged_program({"run", "--resume", "--seed", "4", "--output", out()});
  EXPECT_TRUE(is_failure(other, 2)) << other;
  EXPECT_THAT(other.err, HasSubstr("--seed excludes --resume"));
  folder_.put("corpus/more.json", square_case());
  const Outcome grown = resume();
  EXPECT_TRUE(is_failure(grown, 2)) << grown;
  EXPECT_THAT(grown.err, HasSubstr("changed since the run was started"));
  folder_.put("out/unfinished.json", "{");
  EXPECT_TRUE(is_failure(resume(), 2));
}

// --- Folders that cannot be written --------------------------------------------------------------

/// A shell command that runs `command` with files limited to this many 512-byte blocks, as on a
/// full disk: writing more fails. Its exit code is the command's.
std::string limited_to(int blocks, const std::string& command) {
  return "trap '' XFSZ; exec 3>&1; { { ulimit -f " + std::to_string(blocks) + "; " + command +
         " 2>&1; echo $? >&4; } | cat >&3; } 4>&1 | { read code; exit $code; }";
}

class Unwritable : public testing::Test {
 protected:
  Unwritable() { folder_.put("corpus/square.json", square_case()); }
  std::string run(const std::string& more) const {
    return "$DAMAGED run --backend damaged --seed 3 --property 'coverage-obeys-the-contract' "
           "--corpus " +
           folder_.path("corpus") + " --output " + folder_.path("out") + " " + more;
  }
  TemporaryFolder folder_;
};

// Kills: minutes of work before the program finds out that it cannot write the results.
TEST_F(Unwritable, FromTheStartIsSaidBeforeTheWork) {
  std::filesystem::create_directories(folder_.path("out"));
  std::filesystem::permissions(folder_.path("out"), std::filesystem::perms(0555));
  // Root may write anywhere, unless it gives up this capability.
  const Outcome outcome = run_shell(
      "SETPRIV=; [ $(id -u) != 0 ] || SETPRIV='setpriv --inh-caps -dac_override --bounding-set "
      "-dac_override'; $SETPRIV " +
      run("--cases 1000000"));
  std::filesystem::permissions(folder_.path("out"), std::filesystem::perms(0755));
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("unfinished.json: cannot be written: Permission denied"));
  EXPECT_THAT(folder_.files("out"), ElementsAre());
}

TEST_F(Unwritable, ForAWholeCheckpointIsSaidBeforeTheWork) {
  const Outcome outcome = run_shell(limited_to(0, run("--cases 1000000")));
  EXPECT_EQ(outcome.code, 2) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("unfinished.json: cannot be written: File too large"));
}

// Kills: findings lost because the disk is full at the end; a run that stops because the disk is
// full for a while.
TEST_F(Unwritable, LaterOnTheTerminalHasWhatWasFound) {
  const Outcome outcome = run_shell(limited_to(8, run("--cases 100")));
  EXPECT_EQ(outcome.code, 2) << outcome;
  EXPECT_THAT(
      outcome.out,
      AllOf(HasSubstr("unfinished.json: cannot be written: File too large; the run continues"),
            HasSubstr("violated"), HasSubstr("[-]"), HasSubstr("  vertex  x"),
            Not(HasSubstr("Report: ")), HasSubstr("cannot be written: File too large\n"),
            HasSubstr("the results are printed above but not saved; once the file can be written, "
                      "`rastercheck run --resume --output " +
                      folder_.path("out") + "` saves them")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out/run.json")));
  // Now the disk has room again.
  const Outcome resumed = run_shell("$DAMAGED run --resume --output " + folder_.path("out"));
  EXPECT_EQ(resumed.code, 1) << resumed;
  EXPECT_EQ(json::parse(folder_.content("out/run.json")).at("counterexamples").size(), 3U);
  EXPECT_THAT(folder_.files("out"), Not(testing::Contains("unfinished.json")));
}

}  // namespace
}  // namespace rastercheck::cli::interrupted_test
