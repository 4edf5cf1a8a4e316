#include "cases/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>

namespace rastercheck::cases {
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
  EXPECT_EQ(to_string(killed->wait()), "ended by signal Aborted");
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

// Kills: a limit that limits nothing. It is of whole seconds: up to two pass.
TEST(ChildProcessDeathTest, HasNoMoreProcessorTimeThanItIsGiven) {
  EXPECT_EXIT(
      {
        if (!limit_processor_time_from_now(seconds(0))) ::_exit(1);
        for (volatile unsigned turns = 0;;) turns = turns + 1;
      },
      testing::KilledBySignal(SIGXCPU), "");
}

}  // namespace
}  // namespace rastercheck::cases
