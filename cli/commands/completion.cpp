// `rastercheck completion bash`: prints a script that completes commands and options in a shell.

#include "cli/completion.h"

#include <fmt/format.h>

#include <memory>

#include "cli/command.h"

namespace rastercheck::cli::completion_command {
namespace {

constexpr const char* kBash = "bash";

ExitCode print(const std::string& shell, const CLI::App& program) {
  if (shell == kBash) fmt::print("{}", bash_completion(program));
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto shell = std::make_shared<std::string>();
  app.add_option("SHELL", *shell, "Shell to write the script for")
      ->check(CLI::IsMember({kBash}))
      ->required();
  app.add_flag("-q,--quiet")->description("Accepted for consistency; has no effect");
  app.footer(
      "Example for the current shell only (packages install the script for all):\n"
      "  source <(rastercheck completion bash)");
  return [shell, &app] { return print(*shell, *app.get_parent()); };
}

const Registration kRegistration("completion", "Print a shell script that completes commands",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::completion_command
