#include "cli/usage.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "cases/json.h"
#include "cases/suggestion.h"
#include "cli/command_tree.h"

namespace rastercheck::cli {
namespace {

/// Joins the lines of a message: CLI11's may have several.
std::string joined_lines(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

bool is_option(std::string_view word) { return word.size() > 1 && word.front() == '-'; }

/// Returns the innermost command on the command line.
const CLI::App* reached(const CLI::App* program) {
  const auto inner = program->get_subcommands();
  return inner.empty() ? program : reached(inner.front());
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : shown_commands(app)) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(app)) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Returns the first unknown word of the command line; unknown options precede other words.
std::optional<std::string> unknown_word(const CLI::App& program) {
  const std::vector<std::string> words = program.remaining(true);
  if (words.empty()) return std::nullopt;
  const auto option = std::find_if(words.begin(), words.end(), [](const std::string& word) {
    return is_option(word) && word != "--";
  });
  return option == words.end() ? words.front() : *option;
}

std::string reason_of(const CLI::App& program, const CLI::App& command,
                      const CLI::ParseError& refusal) {
  const bool wants_command = !command_names(command).empty();
  if (const auto word = unknown_word(program)) {
    const std::string name = word->substr(0, word->find('='));
    if (is_option(*word)) {
      return fmt::format("unknown option {}{}", cases::printable(name),
                         cases::did_you_mean(name, option_names(command)));
    }
    if (wants_command) {
      return fmt::format("unknown command '{}'{}", cases::printable(*word),
                         cases::did_you_mean(*word, command_names(command)));
    }
    return fmt::format("unexpected argument '{}'", cases::printable(*word));
  }
  if (wants_command) {
    return &command == &program
               ? "missing command, such as `rastercheck run`"
               : fmt::format("missing command: {}", fmt::join(command_names(command), " or "));
  }
  return joined_lines(refusal.what());
}

}  // namespace

Error wrong_usage(const CLI::App& program, const CLI::ParseError& refusal) {
  const CLI::App& command = *reached(&program);
  return {
      "", "",
      fmt::format("{} (see {} --help)", reason_of(program, command, refusal), full_name(command))};
}

}  // namespace rastercheck::cli
