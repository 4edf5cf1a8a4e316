// `rastercheck manual`: the manual page.

#include "cli/manual.h"

#include <fmt/format.h>

#include "cli/command.h"

namespace rastercheck::cli::manual_command {
namespace {

Action set_up(CLI::App& app) {
  app.add_flag("-q,--quiet")->description("Accepted for consistency; has no effect");
  app.footer(
      "Example (packages install the page for `man rastercheck`):\n"
      "  rastercheck manual | man -l -");
  return [&app] {
    fmt::print("{}", manual_page(*app.get_parent()));
    return ExitCode::ok;
  };
}

const Registration kRegistration("manual", "Print the manual page, which has all of --help",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::manual_command
