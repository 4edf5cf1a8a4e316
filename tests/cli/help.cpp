#include "tests/cli/help.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/cli/program.h"

namespace rastercheck::cli {
namespace {

/// Reads the entries of a list: a line that begins with two spaces and a word gives that word.
void read_lists(Help& help) {
  std::istringstream lines(help.text);
  std::string heading;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.front() != ' ') heading = line;
    if (!line.starts_with("  ") || line.size() < 3 || line[2] == ' ') continue;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (heading == "Options:" && word.starts_with("--")) help.options.push_back(word);
      if (heading == "Commands:") help.commands.push_back(word);
      if (!word.starts_with("-") || word.starts_with("--")) break;
    }
  }
}

void append_help(const std::vector<std::string>& command, std::vector<Help>& all) {
  std::vector<std::string> words = command;
  words.emplace_back("--help");
  const Outcome outcome = run_program(words);
  EXPECT_EQ(outcome.code, 0) << outcome;
  Help help{command, {}, {}, outcome.out};
  read_lists(help);
  all.push_back(help);
  for (const std::string& inner : help.commands) {
    std::vector<std::string> longer = command;
    longer.push_back(inner);
    append_help(longer, all);
  }
}

}  // namespace

std::vector<Help> all_help() {
  std::vector<Help> all;
  append_help({}, all);
  return all;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace rastercheck::cli
