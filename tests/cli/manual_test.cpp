#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/help.h"
#include "tests/cli/program.h"

namespace rastercheck::cli::manual_test {
namespace {

using testing::HasSubstr;

std::string with_replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
  return text;
}

TEST(Manual, HasEveryCommandAndOptionOfTheHelp) {
  const Outcome outcome = run_program({"manual"});
  EXPECT_EQ(outcome.code, 0);
  const std::string page = with_replaced(outcome.out, "\\-", "-");
  for (const Help& help : all_help()) {
    const std::string heading = ".SS \"rastercheck " + joined(help.command) + "\"\n";
    const std::size_t begin = help.command.empty() ? page.find(".SH OPTIONS") : page.find(heading);
    ASSERT_NE(begin, std::string::npos) << heading;
    const std::string section = page.substr(begin, page.find("\n.S", begin) - begin);
    for (const std::string& option : help.options) {
      EXPECT_THAT(section, HasSubstr(option + "\\fR")) << heading;
    }
  }
}

// Kills: a line of text that begins with a dot; an escape that groff does not know.
TEST(Manual, IsAPageThatGroffTakes) {
  const Outcome outcome = run_shell("\"$PROGRAM\" manual | groff -k -man -Tutf8 -P-cbu -ww");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("rastercheck corpus add [OPTIONS] FILE"));
  EXPECT_THAT(outcome.out, HasSubstr("EXIT STATUS"));
}

}  // namespace
}  // namespace rastercheck::cli::manual_test
