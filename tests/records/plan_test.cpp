#include "records/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/records/sample_plan.h"

namespace rastercheck::records::plan_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(OptionWords, AreOfWhatIsNotAsUsual) {
  EXPECT_THAT(option_words({}), IsEmpty());
  EXPECT_THAT(
      option_words(sample_plan()),
      ElementsAre("--property", "*edge*", "--property", "--known", "--scene-size", "640",
                  "--contract", "lax.json", "--corpus", "a folder", "--no-known", "--known",
                  "lists", "--known", "mine.json", "--shrink-tries", "5", "--shrink-seconds", "2.5",
                  "--power", "5", "--keep-cases", "--timeout", "0.5"));
}

// Kills: a size without a scene, which `run` does not use.
TEST(OptionWords, HaveNoSizeOfNoScene) {
  Plan plan = sample_plan();
  plan.scene.clear();
  EXPECT_THAT(option_words(plan), testing::Not(testing::Contains("--scene-size")));
}

TEST(ReplayWords, AreThoseOfDrawingAndKnowing) {
  EXPECT_THAT(replay_words({}), IsEmpty());
  EXPECT_THAT(replay_words(sample_plan()),
              ElementsAre("--contract", "lax.json", "--no-known", "--known", "lists", "--known",
                          "mine.json", "--timeout", "0.5"));
}

// Kills: a comparison with a baseline that includes settings which are only recorded and decide
// nothing.
TEST(Frozen, KeepsOnlySettingsThatDecideResults) {
  Plan expected;
  expected.seed = 7;
  expected.cases_per_law = 12;
  expected.backends = {};
  expected.properties = {"*edge*", "--known"};
  expected.contract = sample_plan().contract;
  expected.corpus = "a folder";
  expected.hunted = sample_plan().hunted;
  expected.known = {"lists", "mine.json"};
  expected.ignores_known = true;
  expected.power = 5;
  expected.capabilities = sample_plan().capabilities;
  EXPECT_EQ(frozen(sample_plan()), expected);
  EXPECT_EQ(frozen(frozen(sample_plan())), expected);
}

}  // namespace
}  // namespace rastercheck::records::plan_test
