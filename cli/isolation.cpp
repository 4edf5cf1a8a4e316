#include "cli/isolation.h"

#include <chrono>
#include <utility>

#include "backends/factory.h"
#include "backends/isolation.h"
#include "cli/own_program.h"

namespace rastercheck::cli {

void add_timeout(CLI::App& app, double& seconds) {
  // A day: more than anyone waits for, and no trouble to count in.
  constexpr double kLongest = 86400;
  app.add_option(
         "--timeout", seconds,
         "Seconds that a driver or plugin may be silent while it draws, before it counts as "
         "hanging")
      ->check(CLI::Range(0.001, kLongest))
      ->type_name("SECONDS")
      ->capture_default_str();
}

std::vector<std::string> worker_program() { return {kOwnProgram, "worker"}; }

backends::BackendFactory backend_factory(double timeout,
                                         std::optional<cases::ContractTerms> terms) {
  const backends::Isolation isolation{.command = worker_program(),
                                      .timeout = std::chrono::duration<double>(timeout)};
  return {backends::isolated_by(isolation), std::move(terms)};
}

}  // namespace rastercheck::cli
