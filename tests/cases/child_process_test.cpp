#include "cases/child_process.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <string>

namespace rastercheck::cases::child_process_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Result<ChildProcess> shell(const std::string& script) {
  return ChildProcess::start({"/bin/sh", "-c", script}, {}, ProcessGroup::own);
}

TEST(ChildProcess, TellsHowItEnded) {
  Result<ChildProcess> exited = shell("exit 3");
  ASSERT_TRUE(exited);
  EXPECT_EQ(to_string(exited->wait()), "ended with exit code 3");
  Result<ChildProcess> killed = shell("kill -6 $$");
  ASSERT_TRUE(killed);
  EXPECT_EQ(to_string(killed->wait()), "was killed by signal Aborted");
}

TEST(ChildProcess, IsFoundOnPathByItsName) {
  Result<ChildProcess> found = ChildProcess::start({"false"}, {}, ProcessGroup::own);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->wait().exit_code, 1);
  const Result<ChildProcess> none =
      ChildProcess::start({"rastercheck-no-such-program"}, {}, ProcessGroup::own);
  ASSERT_FALSE(none);
  EXPECT_EQ(to_string(none.error()),
            "rastercheck-no-such-program: cannot be started: No such file or directory");
}

// Kills: a signal that the process cannot handle; a signal that only the first process of the group
// gets.
TEST(ChildProcess, MayEndInItsOwnWayWithAllThatItStarted) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const Descriptor said(ends[0]);
  Descriptor saying(ends[1]);
  Result<ChildProcess> process = ChildProcess::start(
      {"/bin/sh", "-c",
       "trap : TERM; sh -c 'trap \"echo ended; exit\" TERM; echo ready; while :; do sleep 0.01; "
       "done'; exit 7"},
      {.output = saying.number()}, ProcessGroup::own);
  ASSERT_TRUE(process);
  saying.close();
  std::array<char, 16> text{};
  ASSERT_EQ(::read(said.number(), text.data(), text.size()), 6);
  process->kill(SIGTERM);
  EXPECT_EQ(process->wait().exit_code, 7);
  ASSERT_EQ(::read(said.number(), text.data(), text.size()), 6);
  EXPECT_EQ(std::string(text.data(), 6), "ended\n");
}

TEST(ChildProcess, IsWaitedForAsLongAsItIsTold) {
  Result<ChildProcess> process = shell("sleep 1000");
  ASSERT_TRUE(process);
  EXPECT_FALSE(process->has_ended_within(milliseconds(0)));
  EXPECT_FALSE(process->has_ended_within(milliseconds(20)));
  process->kill();
  EXPECT_TRUE(process->has_ended_within(seconds(60)));
  EXPECT_EQ(process->wait().signal, SIGKILL);
  EXPECT_TRUE(process->has_ended_within(milliseconds(0)));
}

using ChildProcessDeathTest = testing::Test;

// Kills: treating the machine's own limit on memory as a failure.
TEST(ChildProcessDeathTest, KeepsALowerLimitThatThereIs) {
  const auto limited_again = [] {
    rlimit limit{600, 600};
    if (::setrlimit(RLIMIT_CPU, &limit) != 0) ::_exit(1);
    ProcessLimits limits;
    limits.memory = 1U << 30U;
    limits.seconds = 1000;
    if (!limit_this_process(limits) || ::getrlimit(RLIMIT_CPU, &limit) != 0) ::_exit(2);
    ::_exit(limit.rlim_max == 600 ? 0 : 3);
  };
  EXPECT_EXIT(limited_again(), testing::ExitedWithCode(0), "");
}

// Kills: a limit without effect. The limit is in whole seconds, so the process may run for up to
// two.
TEST(ChildProcessDeathTest, HasNoMoreProcessorTimeThanItIsGiven) {
  EXPECT_EXIT(
      {
        if (!limit_processor_time_from_now(seconds(0))) ::_exit(1);
        for (volatile unsigned turns = 0;;) turns = turns + 1;
      },
      testing::KilledBySignal(SIGXCPU), "");
}

}  // namespace
}  // namespace rastercheck::cases::child_process_test
