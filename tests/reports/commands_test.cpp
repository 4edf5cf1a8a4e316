#include "reports/commands.h"

#include <gtest/gtest.h>

namespace rastercheck::reports::commands_test {
namespace {

TEST(RunCommand, NamesWhatDecidesTheRun) {
  records::Run run;
  run.plan.seed = 7;
  run.plan.cases_per_law = 20;
  run.plan.backends = {"cpu:threads=2,simd=sse4", "plugin:my renderer.so"};
  EXPECT_EQ(run_command(run),
            "rastercheck run --backend cpu:threads=2,simd=sse4 --backend 'plugin:my renderer.so' "
            "--cases 20 --seed 7");
  run.plan.backends.clear();
  run.plan.scene = "it's";
  EXPECT_EQ(run_command(run), "rastercheck run --cases 20 --seed 7 --scene 'it'\\''s'");
}

// Kills: a campaign on all laws where only some were requested.
TEST(RunCommand, HasItsOtherOptions) {
  records::Run run;
  run.plan.backends = {"cpu"};
  run.plan.cases_per_law = 20;
  run.plan.properties = {"*edge*"};
  run.plan.ignores_known = true;
  run.plan.contract.emplace().file = "lax.json";
  EXPECT_EQ(run_command(run),
            "rastercheck run --backend cpu --cases 20 --seed 0 --property '*edge*' --contract "
            "lax.json --no-known");
  run.plan.shard = {2, 7};
  EXPECT_EQ(run_command(run),
            "rastercheck run --backend cpu --cases 20 --seed 0 --property '*edge*' --contract "
            "lax.json --no-known --shard 2/7");
}

// Kills: a replay that holds drawings to another contract; options that the replay does not know.
TEST(ReplayCommand, TakesTheOptionsThatItKnows) {
  records::Run run;
  EXPECT_EQ(replay_command(run, "out/a b.json"), "rastercheck replay 'out/a b.json'");
  run.plan.properties = {"--known"};
  run.plan.contract.emplace().file = "lax.json";
  run.plan.corpus = "c";
  run.plan.ignores_known = true;
  run.plan.keeps_cases = true;
  run.plan.timeout = 2.5;
  EXPECT_EQ(replay_command(run, "x"),
            "rastercheck replay x --contract lax.json --no-known --timeout 2.5");
}

}  // namespace
}  // namespace rastercheck::reports::commands_test
