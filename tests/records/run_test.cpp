#include "records/run.h"

#include <gtest/gtest.h>

namespace rastercheck::records {
namespace {

// Kills: a path, a space or a letter of another alphabet in a file name.
TEST(FileOf, IsMadeOfLettersDigitsAndHyphens) {
  Counterexample counterexample;
  counterexample.source.found = {"coverage is exact: ties_2", "method:../é", "violated", 7,
                                 18446744073709551615U};
  EXPECT_EQ(file_of(counterexample),
            "counterexamples/coverage-is-exact--ties-2-method-------18446744073709551615.json");
}

TEST(FileOf, KeepsEveryLetterAndDigit) {
  Counterexample counterexample;
  counterexample.source.found = {"azAZ09", "`{@[/:", "", 0, 0};
  EXPECT_EQ(file_of(counterexample), "counterexamples/azAZ09--------0.json");
}

// Kills: one name for case 3 of the corpus and random case 3.
TEST(FileOf, NamesTheCaseWhereItHasAName) {
  Counterexample counterexample;
  counterexample.source.name = "w = 0";
  counterexample.source.found = {"law", "cpu", "missing", 1, 3};
  EXPECT_EQ(file_of(counterexample), "counterexamples/law-cpu-w---0-3.json");
}

// Kills: a name longer than file systems take.
TEST(FileOf, ShortensALongName) {
  Counterexample counterexample;
  counterexample.source.name = std::string(300, 'x');
  counterexample.source.found = {"law", "cpu", "missing", 1, 3};
  EXPECT_EQ(file_of(counterexample), "counterexamples/law-cpu-" + std::string(64, 'x') + "-3.json");
}

TEST(FileOf, DoesWithoutFound) { EXPECT_EQ(file_of({}), "counterexamples/--0.json"); }

}  // namespace
}  // namespace rastercheck::records
