#include "records/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rastercheck::records::run_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Kills: a path, a space or a letter of another alphabet in a file name.
TEST(FileOf, IsMadeOfLettersDigitsAndHyphens) {
  Counterexample counterexample;
  counterexample.source.found = {"coverage is exact: ties_2", "method:../é", "beyond bound", 7, 1};
  EXPECT_EQ(file_of(counterexample),
            "counterexamples/coverage-is-exact--ties-2-method-------beyond-bound.json");
}

TEST(FileOf, KeepsEveryLetterAndDigit) {
  Counterexample counterexample;
  counterexample.source.found = {"azAZ09", "`{@[/:", "", 0, 0};
  EXPECT_EQ(file_of(counterexample), "counterexamples/azAZ09--------.json");
}

// Kills: a file name that depends on the seed, for the same failure.
TEST(FileOf, IsTheSameWhereverItWasFound) {
  Counterexample one;
  one.source.found = {"law", "cpu", "missing", 1, 3};
  Counterexample other = one;
  other.source.name = "w = 0";
  other.source.found = {"law", "cpu", "missing", 2, 4};
  EXPECT_EQ(file_of(one), file_of(other));
  other.source.found->verdict = "extra";
  EXPECT_NE(file_of(one), file_of(other));
}

TEST(FileOf, DoesWithoutFound) { EXPECT_EQ(file_of({}), "counterexamples/--.json"); }

TEST(UnreachedSentence, SaysHowOftenAndHowOftenAtLeast) {
  EXPECT_EQ(unreached_sentence({"law", "cpu", "tie", 1, 4, 9}),
            "Not reached: law on cpu: 'tie' in 1 of 9 cases, where at least 4 had to.");
}

// Kills: a run that was cut short and looks complete.
TEST(Caveats, SayWhatIsMissing) {
  records::Run run;
  EXPECT_THAT(caveats(run), IsEmpty());
  run.cases_left = 120;
  run.plan.shrinking.seconds = 2.5;
  run.plan.contract.emplace().file = "lax.json";
  EXPECT_THAT(caveats(run),
              ElementsAre("Held to the contract of lax.json, not to what the backends promise.",
                          "The run ended early: 120 of its cases were not checked.",
                          "Shrinking was limited to 2.5 s a counterexample: how small they are "
                          "depends on the machine."));
}

// Kills: a shard that looks like the whole run.
TEST(Caveats, SayThatItIsAShard) {
  records::Run run;
  run.shard.emplace();
  run.plan.shard = {2, 7};
  EXPECT_THAT(caveats(run), ElementsAre("Shard 2 of 7: nothing of the campaign fell to it; "
                                        "`rastercheck merge` puts all 7 together."));
  run.records[{"a", "cpu", AttributeKind::coverage, "1"}];
  EXPECT_THAT(caveats(run),
              ElementsAre("Shard 2 of 7: a part of the campaign, of which it cannot say whether "
                          "labels were reached; `rastercheck merge` puts all 7 together."));
}

// Kills: violations of cases that were never drawn, but look like any others.
TEST(Caveats, SayWhatWasNotDrawn) {
  records::Run run;
  run.records[{"a", "plugin:x", AttributeKind::coverage, "1"}].labels = {{"tie", 9}};
  run.records[{"a", "plugin:x", AttributeKind::coverage, "2"}].labels = {
      {std::string(kGivenUp), 3}};
  run.records[{"b", "plugin:x", AttributeKind::coverage, "2"}].labels = {
      {std::string(kGivenUp), 4}};
  EXPECT_THAT(caveats(run),
              ElementsAre("plugin:x crashed or hung so often that it was given up: 7 cases of it "
                          "were not drawn, and count as violations."));
}

}  // namespace
}  // namespace rastercheck::records::run_test
