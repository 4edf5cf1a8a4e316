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

TEST(FileOf, DoesWithoutFound) { EXPECT_EQ(file_of(Counterexample()), "counterexamples/--.json"); }

TEST(UnreachedSentence, SaysHowOftenAndHowOftenAtLeast) {
  EXPECT_EQ(unreached_sentence({"law", "cpu", "tie", 1, 4, 9}),
            "Not reached: law on cpu: 'tie' in 1 of 9 cases; at least 4 were required.");
}

// Kills: a run that was cut short and looks complete.
TEST(Caveats, SayWhatIsMissing) {
  records::Run run;
  EXPECT_THAT(caveats(run), IsEmpty());
  run.cases_left = 120;
  run.plan.shrinking.seconds = 2.5;
  run.plan.contract.emplace().file = "lax.json";
  EXPECT_THAT(caveats(run),
              ElementsAre("Judged by the contract in lax.json, not by the backends' own promises.",
                          "The run ended early: 120 of its cases were not checked.",
                          "Shrinking was limited to 2.5 s per counterexample, so their sizes "
                          "depend on the machine."));
}

// Kills: a shard that looks like the whole run.
TEST(Caveats, SayThatItIsAShard) {
  records::Run run;
  run.shard.emplace();
  run.plan.shard = {2, 7};
  EXPECT_THAT(
      caveats(run),
      ElementsAre("Shard 2 of 7: it had no work to do; `rastercheck merge` combines all 7."));
  run.records[{"a", "cpu", AttributeKind::coverage, "1"}];
  EXPECT_THAT(caveats(run),
              ElementsAre("Shard 2 of 7: one part of the campaign, which cannot tell whether "
                          "labels were reached; `rastercheck merge` combines all 7."));
}

// Kills: violations of cases that were never drawn, but look like any others.
TEST(Caveats, SayWhatWasNotDrawn) {
  records::Run run;
  run.records[{"a", "plugin:x", AttributeKind::coverage, "1"}].labels = {{"tie", 9}};
  run.records[{"a", "plugin:x", AttributeKind::coverage, "2"}].labels = {
      {std::string(kGivenUp), 3}};
  run.records[{"b", "plugin:x", AttributeKind::coverage, "2"}].labels = {
      {std::string(kGivenUp), 4}};
  EXPECT_THAT(caveats(run), ElementsAre("plugin:x crashed or hung so often that it was given up: 7 "
                                        "of its cases were not drawn and count as violations."));
}

}  // namespace
}  // namespace rastercheck::records::run_test
