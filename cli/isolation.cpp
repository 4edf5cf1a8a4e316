#include "cli/isolation.h"

#include <chrono>
#include <utility>

#include "backends/factory.h"
#include "backends/isolation.h"
#include "cases/names.h"
#include "cli/own_program.h"

namespace rastercheck::cli {

void add_timeout(CLI::App& app, double& seconds) {
  // One day: longer than anyone waits, and far from overflow.
  constexpr double kLongest = 86400;
  app.add_option("--timeout", seconds,
                 "Seconds that a driver or plugin may draw without a sign of progress before it "
                 "counts as hung")
      ->check(CLI::Range(0.001, kLongest))
      ->type_name("SECONDS")
      ->capture_default_str();
}

CLI::Option* add_draw_by(CLI::App& app, std::optional<cases::DrawBy>& way,
                         std::span<const std::string_view> names) {
  return app
      .add_option_function<std::string>(
          "--draw-by",
          [&way](const std::string& name) { way = cases::from_name<cases::DrawBy>(name); })
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->type_name("WAY");
}

std::vector<std::string> worker_program() { return {kOwnProgram, "worker"}; }

backends::BackendFactory backend_factory(double timeout,
                                         std::optional<cases::ContractTerms> terms) {
  const backends::Isolation isolation{.command = worker_program(),
                                      .timeout = std::chrono::duration<double>(timeout)};
  return {backends::isolated_by(isolation), std::move(terms)};
}

}  // namespace rastercheck::cli
