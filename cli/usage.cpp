#include "cli/usage.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>

#include "cases/json.h"
#include "cli/command_tree.h"

namespace rastercheck::cli {
namespace {

/// CLI11's messages may have several lines.
std::string joined_lines(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/// Characters to be put in, left out, exchanged, or swapped with the next, at least, to make one of
/// the other.
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;
  std::vector<std::size_t> last(b.size() + 1);
  std::iota(last.begin(), last.end(), 0U);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row{i};
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchanged = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row.push_back(std::min({last[j] + 1, row[j - 1] + 1, exchanged}));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before = std::exchange(last, std::move(row));
  }
  return last.back();
}

bool is_option(std::string_view word) { return word.size() > 1 && word.front() == '-'; }

/// "; did you mean --cases?", where one of the names begins like the word or is much like it.
std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  const std::size_t dashes = std::min(word.find_first_not_of('-'), word.size());
  if (word.size() - dashes < 2) return "";  // too little to be like anything
  constexpr std::size_t kLettersForEachEdit = 3;
  std::size_t least = std::max<std::size_t>(1, word.size() / kLettersForEachEdit) + 1;
  std::string nearest;
  for (const std::string& name : names) {
    const std::size_t edits = name.starts_with(word) ? 0 : edits_between(word, name);
    if (edits < least) {
      least = edits;
      nearest = name;
    }
  }
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

/// The command that was reached.
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

/// What of the command line has no meaning, the first option before all else.
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
      return fmt::format("there is no option {}{}", cases::printable(name),
                         suggestion(name, option_names(command)));
    }
    if (wants_command) {
      return fmt::format("there is no command '{}'{}", cases::printable(*word),
                         suggestion(*word, command_names(command)));
    }
    return fmt::format("'{}' is one argument too many", cases::printable(*word));
  }
  if (wants_command) {
    return &command == &program
               ? "a command is missing, as `rastercheck run`"
               : fmt::format("a command is missing: {}", fmt::join(command_names(command), " or "));
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
