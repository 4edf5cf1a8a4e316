// `rastercheck bisect-step`: run by `git bisect run` for each commit. Not for users.

#include <memory>

#include "cli/command.h"
#include "cli/conduct.h"
#include "gate/bisect.h"

namespace rastercheck::cli::bisect_step_command {
namespace {

Action set_up(CLI::App& app) {
  const auto folder = std::make_shared<std::string>();
  app.group("");  // not in --help
  app.add_option("FOLDER", *folder)->required();
  // The exit codes are those that git expects, not this program's.
  return [folder] { return static_cast<ExitCode>(gate::judge_commit(*folder, &run_plan)); };
}

const Registration kRegistration("bisect-step", "Judge the commit that is checked out", &set_up);

}  // namespace
}  // namespace rastercheck::cli::bisect_step_command
