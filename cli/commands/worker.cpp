// `rastercheck worker`: the process that draws with a foreign backend (backends/isolation.h). Not
// for users.

#include <memory>

#include "backends/isolation.h"
#include "cli/command.h"

namespace rastercheck::cli::worker_command {
namespace {

struct Options {
  std::string backend;
  backends::ServingLimits limits;
};

ExitCode run(const Options& options) {
  const Result<void> served = backends::serve_backend(options.backend, options.limits);
  return served ? ExitCode::ok : fail_internally(served.error());
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.group("");  // not in --help
  app.add_option("BACKEND", options->backend)->required();
  app.add_option("--seconds", options->limits.seconds)->required();
  app.add_option("--memory", options->limits.memory)->required();
  return [options] { return run(*options); };
}

const Registration kRegistration("worker", "Draw with a backend for another process", &set_up);

}  // namespace
}  // namespace rastercheck::cli::worker_command
