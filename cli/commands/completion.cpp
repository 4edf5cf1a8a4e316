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
  app.add_option("SHELL", *shell, "Whose language it is in")
      ->check(CLI::IsMember({kBash}))
      ->required();
  app.add_flag("-q,--quiet")->description("Accepted as everywhere; there is only the result");
  app.footer(
      "Example, for this shell alone (a package installs it for all):\n"
      "  source <(rastercheck completion bash)");
  return [shell, &app] { return print(*shell, *app.get_parent()); };
}

const Registration kRegistration("completion",
                                 "Prints a script that makes a shell complete commands", &set_up);

}  // namespace
}  // namespace rastercheck::cli::completion_command
