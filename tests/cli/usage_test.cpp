#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace rastercheck::cli::usage_test {
namespace {

using testing::HasSubstr;

std::string refusal(const std::vector<std::string>& arguments) {
  const Outcome outcome = run_program(arguments);
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  return outcome.err;
}

TEST(Usage, NamesWhatWasPerhapsMeant) {
  EXPECT_EQ(refusal({"rnu"}),
            "rastercheck: unknown command 'rnu'; did you mean run? (see rastercheck --help)\n");
  EXPECT_EQ(
      refusal({"run", "--case", "3"}),
      "rastercheck: unknown option --case; did you mean --cases? (see rastercheck run --help)\n");
  EXPECT_THAT(refusal({"run", "--bakend=cpu"}),
              HasSubstr("unknown option --bakend; did you mean --backend?"));
  EXPECT_THAT(refusal({"corpus", "ad"}), HasSubstr("unknown command 'ad'; did you mean add?"));
  EXPECT_THAT(refusal({"--vers"}), HasSubstr("did you mean --version?"));
}

// Kills: a suggestion that does not resemble the word.
TEST(Usage, SuggestsNothingThatIsNotAlike) {
  EXPECT_EQ(refusal({"frobnicate"}),
            "rastercheck: unknown command 'frobnicate' (see rastercheck --help)\n");
  EXPECT_EQ(refusal({"run", "--frobnicate"}),
            "rastercheck: unknown option --frobnicate (see rastercheck run --help)\n");
}

// Kills: suggesting the first option because it begins like the word, as all options do.
TEST(Usage, SuggestsNothingForTooLittle) {
  for (const char* word : {"-", "--x", "---", "-x", "r"}) {
    EXPECT_THAT(refusal({"run", word}), testing::Not(HasSubstr("did you mean"))) << word;
  }
  EXPECT_THAT(refusal({"run", "-"}), HasSubstr("unexpected argument '-'"));
}

TEST(Usage, TakesWholeNumbersWithAnExponent) {
  EXPECT_THAT(refusal({"run", "--cases", "1e99"}),
              HasSubstr("1e99 is not an integer between 0 and "));
  EXPECT_THAT(refusal({"run", "--cases", "e3"}), HasSubstr("e3 is not an integer"));
  EXPECT_THAT(refusal({"explain", "x.json", "--sample", "5e9"}),
              HasSubstr("5e9 is not an integer between 0 and 4294967295"));
  EXPECT_THAT(refusal({"run", "--cases", "1e9", "--property", "none"}), HasSubstr("--property"));
}

// Kills: the message "Could not convert", which does not give the range.
TEST(Usage, SaysUpToWhereNumbersGo) {
  EXPECT_THAT(refusal({"explain", "x.json", "--sample", "4294967296"}),
              HasSubstr("4294967296 is not an integer between 0 and 4294967295"));
  EXPECT_THAT(refusal({"run", "--seed", "-1"}),
              HasSubstr("-1 is not an integer between 0 and 18446744073709551615"));
}

// Kills: reporting a consequence of the unknown option instead of the option.
TEST(Usage, NamesAnUnknownOptionBeforeAllElse) {
  EXPECT_THAT(refusal({"list", "--backnd", "cpu"}), HasSubstr("unknown option --backnd"));
  EXPECT_THAT(refusal({"compare", "--polcy", "x"}), HasSubstr("unknown option --polcy"));
}

TEST(Usage, SaysWhichCommandsHelpToRead) {
  EXPECT_THAT(refusal({}), HasSubstr("missing command, such as `rastercheck run`"));
  EXPECT_THAT(refusal({"baseline"}),
              HasSubstr("missing command: save or approve (see rastercheck baseline --help)"));
  EXPECT_THAT(refusal({"baseline", "approve", "a", "b"}),
              HasSubstr("--reason is required (see rastercheck baseline approve --help)"));
  EXPECT_THAT(refusal({"oracle", "a", "b"}),
              HasSubstr("unexpected argument 'b' (see rastercheck oracle --help)"));
}

TEST(Usage, PutsNoControlCharactersOnTheTerminal) {
  EXPECT_EQ(refusal({"\x1b[31m"}).find('\x1b'), std::string::npos);
  EXPECT_EQ(refusal({"list", "--\x1b[31m"}).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace rastercheck::cli::usage_test
