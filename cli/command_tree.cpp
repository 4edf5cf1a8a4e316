#include "cli/command_tree.h"

#include <fmt/format.h>

#include <string_view>

namespace rastercheck::cli {
namespace {

/// The type of an option as CLI11 prints it, such as "INT:INT in [1 - 1024]" or "TEXT:{c,c++}",
/// split at the first colon into the type's name and the validators' description of the allowed
/// values.
struct Type {
  std::string name;
  std::string values;
};

Type parts_of(const CLI::Option& option) {
  const std::string all = option.get_type_name();
  const std::size_t colon = all.find(':');
  if (colon == std::string::npos) return {all, ""};
  return {all.substr(0, colon), all.substr(colon + 1)};
}

/// Returns "from 1 to 1024" for "INT in [1 - 1024]"; empty for anything else.
std::string range_in(std::string_view values) {
  constexpr std::string_view kOpening = " in [";
  constexpr std::string_view kMiddle = " - ";
  const std::size_t opening = values.find(kOpening);
  const std::size_t middle = values.find(kMiddle);
  if (opening == std::string_view::npos || middle == std::string_view::npos) return "";
  const std::size_t begin = opening + kOpening.size();
  const std::size_t after = middle + kMiddle.size();
  return fmt::format("from {} to {}", values.substr(begin, middle - begin),
                     values.substr(after, values.find(']') - after));
}

/// Returns the default value, without the brackets that CLI11 puts around lists.
std::string default_of(const CLI::Option& option) {
  std::string value = option.get_default_str();
  if (value.size() > 1 && value.front() == '[' && value.back() == ']') {
    value = value.substr(1, value.size() - 2);
  }
  return value;
}

bool is_shown(const CLI::Option* option) { return !option->get_group().empty(); }

}  // namespace

std::vector<const CLI::App*> shown_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> arguments_of(const CLI::App& app) {
  return app.get_options(
      [](const CLI::Option* option) { return is_shown(option) && option->get_positional(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options(
      [](const CLI::Option* option) { return is_shown(option) && option->nonpositional(); });
}

std::string type_of(const CLI::Option& option) {
  return option.get_type_size() == 0 ? "" : parts_of(option).name;
}

std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string values = parts_of(option).values;
  if (values.size() < 2 || values.front() != '{') return {};
  return CLI::detail::split(values.substr(1, values.size() - 2), ',');
}

OptionText text_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  std::vector<std::string> notes;
  if (option.nonpositional() && option.get_required()) notes.emplace_back("required");
  if (const auto choices = choices_of(option); !choices.empty()) {
    notes.push_back(fmt::format("choices: {}", fmt::join(choices, ", ")));
  }
  if (std::string range = range_in(parts_of(option).values); !range.empty()) {
    notes.push_back(std::move(range));
  }
  if (const std::string value = default_of(option); !value.empty()) {
    notes.push_back("default: " + value);
  }
  std::string description = option.get_description();
  if (!notes.empty()) description += fmt::format(" ({})", fmt::join(notes, "; "));
  if (option.get_positional()) return {option.get_name(true, false), "", std::move(description)};
  return {fmt::format("{}", fmt::join(names, ", ")), type_of(option), std::move(description)};
}

std::string full_name(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  return parent == nullptr ? app.get_name() : full_name(*parent) + " " + app.get_name();
}

std::string usage_of(const CLI::App& app) {
  std::string usage = full_name(app) + " [OPTIONS]";
  for (const CLI::Option* argument : arguments_of(app)) {
    const bool has_many = argument->get_expected_max() > 1;
    const std::string name = argument->get_name(true, false) + (has_many ? "..." : "");
    usage += argument->get_required() ? " " + name : " [" + name + "]";
  }
  return shown_commands(app).empty() ? usage : usage + " COMMAND";
}

}  // namespace rastercheck::cli
