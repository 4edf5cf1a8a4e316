#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <vector>

#include "tests/cli/help.h"
#include "tests/cli/program.h"

namespace rastercheck::cli::main_test {
namespace {

using testing::HasSubstr;

TEST(Program, SaysItsVersion) {
  const Outcome outcome = run_program({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "rastercheck " RASTERCHECK_VERSION "\n");
}

// Kills: text that a terminal wraps again; an entry without a description.
TEST(Program, HelpsItselfAndEveryCommandInEightyColumns) {
  const std::vector<Help> all = all_help();
  EXPECT_THAT(all.front().commands, testing::IsSupersetOf({"import", "list", "oracle", "run"}));
  for (const Help& help : all) {
    EXPECT_THAT(help.options, testing::Contains("--help")) << joined(help.command);
    std::istringstream lines(help.text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 80U) << joined(help.command) << ": " << line;
      EXPECT_FALSE(line.ends_with(' ')) << joined(help.command) << ": " << line;
    }
  }
}

TEST(Program, AnswersWrongUsageWithOneLineAndExitTwo) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"frobnicate"},
                                                    {"oracle"},
                                                    {"oracle", "a", "b"},
                                                    {"oracle", "--frobnicate", "x"},
                                                    {"list", "gadgets"},
                                                    {"list", "\x1b[31m"},
                                                    {"import", "x", "--width", "0"}}) {
    const Outcome outcome = run_program(arguments);
    EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
    EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
  }
}

TEST(Program, NamesAFileThatIsNotThere) {
  const Outcome outcome = run_program({"oracle", "no/such.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "rastercheck: no/such.json: cannot be read: No such file or directory\n");
}

TEST(Program, SendsMeshesToTheImport) {
  const Outcome outcome = run_program({"oracle", "bunny.obj"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("rastercheck import"));
}

TEST(Program, ShowsNoControlCharactersOfACase) {
  const std::string text =
      R"({"format": "rastercheck-case", "version": 1, "name": "\u001b[31m\n",
          "framebuffer": {"width": 1, "height": 1}, "rules": "vulkan",
          "viewport": {"x": 0, "y": 0, "width": 1, "height": 1},
          "attributes": [{"name": "a\nb"}], "vertices": [], "triangles": []})";
  const Outcome outcome = run_program({"oracle", "-"}, text);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 3);
  EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos);
}

TEST(Program, ReportsOutputThatCannotBeWritten) {
  // /dev/full refuses every write.
  const std::string command = std::string(RASTERCHECK_PROGRAM) + " oracle " +
                              source_file("cases/corpus/first-triangle.json") +
                              " > /dev/full 2> /dev/null";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
}

// Kills: fmt's exception reported as an internal error; truncated help that counts as complete.
TEST(Program, ReportsWhateverOutputCannotBeWritten) {
  for (const char* arguments :
       {"list properties", "list --json", "--help", "run --help", "--version", "manual"}) {
    const Outcome outcome = run_shell(std::string("\"$PROGRAM\" ") + arguments + " > /dev/full");
    EXPECT_TRUE(is_failure(outcome, 2)) << arguments << outcome;
    EXPECT_THAT(outcome.err, HasSubstr("No space left")) << arguments;
  }
}

// Kills: an exception while a message is written, reported as an internal error.
TEST(Program, EndsAlikeWhereNobodyReadsItsMessages) {
  for (const auto& [arguments, code] :
       {std::pair<std::string, int>("frobnicate", 2), {"oracle no/such.json", 2}, {"list", 0}}) {
    const Outcome outcome = run_shell("\"$PROGRAM\" " + arguments + " 2> /dev/full");
    EXPECT_EQ(outcome.code, code) << arguments << outcome;
  }
}

TEST(Program, TakesQuietEverywhere) {
  for (const Help& help : all_help()) {
    if (!help.commands.empty()) continue;
    EXPECT_THAT(help.options, testing::Contains("--quiet")) << joined(help.command);
  }
}

}  // namespace
}  // namespace rastercheck::cli::main_test
