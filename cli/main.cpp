// The `rastercheck` program: picks the command and turns every outcome into an exit code.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "cli/command.h"
#include "cli/output.h"

namespace rastercheck::cli {
namespace {

/// CLI11's messages may have several lines.
std::string joined_lines(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/// Opens standard streams that are closed: what is opened next would be taken for them.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    const int opened = ::open("/dev/null", O_RDONLY);
    static_cast<void>(
        opened);  // The lowest that is free: the one that was closed. To write to it fails still.
  }
}

int run(int argc, char** argv) {
  CLI::App app("Checks rasterizers against exact rational arithmetic.", "rastercheck");
  app.set_version_flag("--version", "rastercheck " RASTERCHECK_VERSION);
  app.require_subcommand(1);
  std::map<const CLI::App*, Action> actions;
  for (const Command& command : commands()) {
    CLI::App* subcommand = app.add_subcommand(command.name, command.summary);
    actions[subcommand] = command.set_up(*subcommand);
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& outcome) {
    if (outcome.get_exit_code() == 0) return app.exit(outcome);  // --help, --version
    const auto chosen = app.get_subcommands();
    const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
    return static_cast<int>(fail(
        {"", "",
         fmt::format("{} (see rastercheck{} --help)", joined_lines(outcome.what()), command)}));
  }

  const ExitCode code = actions.at(app.get_subcommands().front())();
  if (const auto flushed = flush_standard_output(); !flushed) {
    return static_cast<int>(fail(flushed.error()));
  }
  return static_cast<int>(code);
}

}  // namespace
}  // namespace rastercheck::cli

int main(int argc, char** argv) {
  using rastercheck::cli::ExitCode;
  rastercheck::cli::open_standard_streams();
  // Without fail_internally(), which may want memory that there is none of.
  try {
    return rastercheck::cli::run(argc, argv);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "rastercheck: internal error: {}\n", problem.what());
  } catch (...) {
    fmt::print(stderr, "rastercheck: internal error\n");
  }
  return static_cast<int>(ExitCode::internal);
}
