#include "cli/help_format.h"

#include <string>

#include "cli/command_tree.h"
#include "reports/wrapped_text.h"

namespace rastercheck::cli {
namespace {

constexpr std::size_t kTextColumn = 24;  ///< where the descriptions of options begin

std::string help_entry(const std::string& name, const std::string& text) {
  const std::string label = "  " + name;
  if (label.size() + 2 <= kTextColumn) return reports::wrapped(label, kTextColumn, text);
  return label + "\n" + reports::wrapped("", kTextColumn, text);
}

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat() { label("Positionals", "Arguments"); }

  std::string make_description(const CLI::App* app) const override {
    return reports::wrapped("", 0, app->get_description() + ".");
  }

  std::string make_usage(const CLI::App* app, std::string /*name*/) const override {
    return "Usage: " + usage_of(*app) + "\n";
  }

  std::string make_option(const CLI::Option* option, bool /*is_positional*/) const override {
    const OptionText text = text_of(*option);
    return help_entry(text.value.empty() ? text.names : text.names + " " + text.value,
                      text.description);
  }

  std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode /*mode*/) const override {
    const auto commands = shown_commands(*app);
    std::string text = commands.empty() ? "" : "\nCommands:\n";
    for (const CLI::App* command : commands) {
      text += help_entry(command->get_name(), command->get_description());
    }
    return text;
  }

  std::string make_footer(const CLI::App* app) const override {
    std::string text;
    if (app->get_footer().empty()) return text;
    for (const std::string& line : CLI::detail::split(app->get_footer(), '\n')) {
      text += line.starts_with(' ') ? line + "\n" : reports::wrapped("", 0, line);
    }
    return text;
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_format() { return std::make_shared<HelpFormat>(); }

}  // namespace rastercheck::cli
