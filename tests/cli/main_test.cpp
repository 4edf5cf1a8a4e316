#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <vector>

#include "tests/cli/program.h"

namespace rastercheck::cli {
namespace {

using testing::HasSubstr;

TEST(Program, SaysItsVersion) {
  const Outcome outcome = run_program({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "rastercheck " RASTERCHECK_VERSION "\n");
}

TEST(Program, HelpsItselfAndEveryCommand) {
  const Outcome all = run_program({"--help"});
  EXPECT_EQ(all.code, 0);
  // The commands as the help lists them, each at the start of a line after "Subcommands:".
  std::istringstream lines(all.out.substr(all.out.find("Subcommands:")));
  std::vector<std::string> listed;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string command;
    if (line.starts_with("  ") && line[2] != ' ' && words >> command) listed.push_back(command);
  }
  EXPECT_THAT(listed, testing::IsSupersetOf({"import", "list", "oracle"}));
  for (const std::string& command : listed) {
    const Outcome one = run_program({command, "--help"});
    EXPECT_EQ(one.code, 0);
    EXPECT_THAT(one.out, HasSubstr("--help"));
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

}  // namespace
}  // namespace rastercheck::cli
