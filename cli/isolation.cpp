#include "cli/isolation.h"

#include "backends/isolation.h"
#include "cli/own_program.h"

namespace rastercheck::cli {

void add_timeout(CLI::App& app, double& seconds) {
  // A day: more than anyone waits for, and no trouble to count in.
  constexpr double kLongest = 86400;
  app.add_option("--timeout", seconds,
                 "Seconds that a driver or plugin may take for a draw, which then counts as failed")
      ->check(CLI::Range(0.001, kLongest))
      ->type_name("SECONDS")
      ->capture_default_str();
}

void isolate_foreign_backends(double timeout) {
  backends::Isolation isolation;
  isolation.command = {kOwnProgram, "worker"};
  isolation.timeout = std::chrono::duration<double>(timeout);
  backends::isolate_foreign_backends(isolation);
}

}  // namespace rastercheck::cli
