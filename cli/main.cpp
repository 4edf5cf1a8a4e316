// The `rastercheck` program: picks the command and turns every outcome into an exit code.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <sstream>

#include "cli/command.h"
#include "cli/help_format.h"
#include "cli/output.h"
#include "cli/usage.h"

namespace rastercheck::cli {
namespace {

/// Opens standard streams that are closed; otherwise the next opened file would take their place.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    const int opened = ::open("/dev/null", O_RDONLY);
    // open() takes the lowest free number, that of the closed stream. Writing still fails.
    static_cast<void>(opened);
  }
}

constexpr const char* kIntroduction =
    "A case is a JSON file that says what to draw: triangles, attributes, framebuffer and the "
    "rules of OpenGL, Vulkan or Direct3D. A backend draws cases: this project's rasterizer, a "
    "driver or your plugin. A property is a sentence that is true of every correct drawing; a case "
    "that violates one is a counterexample.\n\n"
    "To begin:\n"
    "  rastercheck list backends             lists what can be judged here\n"
    "  rastercheck run                       judges this project's rasterizer\n"
    "  rastercheck run --backend gl          judges this machine's OpenGL\n"
    "  rastercheck explain FILE              explains a counterexample\n\n"
    "Every command has --help.";

int run(int argc, char** argv) {
  CLI::App app("Checks rasterizers against exact rational arithmetic", "rastercheck");
  app.formatter(help_format());
  app.set_help_flag("-h,--help", "Show this help and exit");
  app.set_version_flag("--version", "rastercheck " RASTERCHECK_VERSION,
                       "Show the version and exit");
  app.require_subcommand(1);
  std::map<const CLI::App*, Action> actions;
  for (const Command& command : commands()) {
    CLI::App* subcommand = app.add_subcommand(command.name, command.summary);
    actions[subcommand] = command.set_up(*subcommand);
  }
  app.footer(kIntroduction);  // last, because commands would inherit it

  ExitCode code = ExitCode::ok;
  try {
    app.parse(argc, argv);
    code = actions.at(app.get_subcommands().front())();
  } catch (const CLI::ParseError& outcome) {
    if (outcome.get_exit_code() != 0) return static_cast<int>(fail(wrong_usage(app, outcome)));
    std::ostringstream text;  // for --help and --version
    app.exit(outcome, text, text);
    fmt::print("{}", text.str());
  }
  if (const auto flushed = flush_standard_output(); !flushed) {
    return static_cast<int>(fail(flushed.error()));
  }
  return static_cast<int>(code);
}

/// Like fail(), but allocates nothing, since memory may have run out.
void tell_last(const char* what, const char* why) {
  for (const char* part : {what, why, "\n"}) print_problem(part);
}

}  // namespace
}  // namespace rastercheck::cli

int main(int argc, char** argv) {
  using rastercheck::cli::ExitCode;
  using rastercheck::cli::tell_last;
  rastercheck::cli::open_standard_streams();
  try {
    return rastercheck::cli::run(argc, argv);
  } catch (const std::exception& problem) {
    // fmt throws if a stream cannot take the output.
    if (std::ferror(stdout) != 0) {
      tell_last("rastercheck: standard output: ", problem.what());
      return static_cast<int>(ExitCode::usage);
    }
    tell_last("rastercheck: internal error: ", problem.what());
  } catch (...) {
    tell_last("rastercheck: internal error", "");
  }
  return static_cast<int>(ExitCode::internal);
}
