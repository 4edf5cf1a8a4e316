#include "cli/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/output.h"

namespace rastercheck::cli {
namespace {

std::vector<Command>& registry() {
  static std::vector<Command> all;
  return all;
}

}  // namespace

std::span<const Command> commands() { return registry(); }

Registration::Registration(std::string name, std::string summary,
                           std::function<Action(CLI::App&)> set_up) {
  Command command{std::move(name), std::move(summary), std::move(set_up)};
  // Files register in the linker's order; --help lists commands by name.
  const auto after = std::find_if(registry().begin(), registry().end(),
                                  [&](const Command& other) { return other.name > command.name; });
  registry().insert(after, std::move(command));
}

ExitCode fail(const Error& error) {
  print_problem(fmt::format("rastercheck: {}\n", to_string(error)));
  return ExitCode::usage;
}

ExitCode fail_internally(const Error& error) {
  print_problem(fmt::format("rastercheck: internal error: {}\n", to_string(error)));
  return ExitCode::internal;
}

}  // namespace rastercheck::cli
