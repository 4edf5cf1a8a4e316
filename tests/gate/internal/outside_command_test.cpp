#include "gate/internal/outside_command.h"

#include <gtest/gtest.h>

#include <csignal>

#include "tests/temporary_folder.h"

namespace rastercheck::gate::outside_command_test {
namespace {

std::vector<std::string> shell(const std::string& script) { return {"sh", "-c", script}; }

TEST(OutsideCommand, HasNoInputAndAddsWhatItSaysToTheLog) {
  const TemporaryFolder folder;
  OutsideRun how;
  how.log = folder.path("log");
  const auto first = run_outside(shell("cat; echo one; echo two >&2; exit 7"), how);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->exit_code, 7);
  how.output = folder.path("output");
  folder.put("output", "what was there before");
  ASSERT_TRUE(run_outside(shell("echo three; echo four >&2"), how));
  EXPECT_EQ(folder.content("log"), "one\ntwo\nfour\n");
  EXPECT_EQ(folder.content("output"), "three\n");
}

// Kills: a command that outlives the process that started it; waiting for a command that never
// ends.
TEST(OutsideCommand, IsEndedWithWhatItStarted) {
  const TemporaryFolder folder;
  OutsideRun how;
  how.log = folder.path("log");
  how.is_to_end = [&] { return folder.content("log").find("begun\n") != std::string::npos; };
  const auto end = run_outside(
      shell(
          "sh -c 'trap \"\" TERM; echo begun; sleep 1000' & trap 'echo asked; exit 3' TERM; wait"),
      how);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->exit_code, 3);
  EXPECT_EQ(folder.content("log"), "begun\nasked\n");
}

TEST(OutsideCommand, ThatCannotBeStartedIsAnError) {
  const TemporaryFolder folder;
  OutsideRun how;
  how.log = folder.path("log");
  EXPECT_FALSE(run_outside({"rastercheck-no-such-program"}, how));
  how.log = folder.path("nowhere/log");
  EXPECT_FALSE(run_outside(shell("true"), how));
}

TEST(OutsideCommand, TellingLine) {
  EXPECT_EQ(telling_line(""), "");
  EXPECT_EQ(telling_line(" \n\n"), "");
  EXPECT_EQ(telling_line("one"), "one");
  EXPECT_EQ(telling_line("one\n two \r\n \n"), "two");
  EXPECT_EQ(telling_line("two\x1b[0m"), "two\\u001b[0m");
  EXPECT_EQ(telling_line("one\na.c:1:2: error: no\na.c:3:4: error: neither\n"),
            "a.c:1:2: error: no");
}

}  // namespace
}  // namespace rastercheck::gate::outside_command_test
