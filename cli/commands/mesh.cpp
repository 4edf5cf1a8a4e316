// `rastercheck mesh`: the process that reads a mesh file for the other commands (cli/mesh_file.h).
// Not for users.

#include <memory>

#include "cases/mesh_process.h"
#include "cli/command.h"

namespace rastercheck::cli::mesh_command {
namespace {

struct Options {
  std::string file;
  std::string format;
  cases::ProcessLimits limits = cases::default_reader_limits();
};

ExitCode run(const Options& options) {
  const Result<void> served = cases::serve_mesh(options.file, options.format, options.limits);
  if (!served) return fail_internally(served.error());
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.group("");  // not in --help
  app.add_option("MESH", options->file)->required();
  app.add_option("--format", options->format);
  app.add_option("--memory", options->limits.memory, "Bytes");
  app.add_option("--seconds", options->limits.seconds, "Limit of processor time, in seconds");
  return [options] { return run(*options); };
}

const Registration kRegistration("mesh", "Read a mesh for another process", &set_up);

}  // namespace
}  // namespace rastercheck::cli::mesh_command
