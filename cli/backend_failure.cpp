#include "cli/backend_failure.h"

#include <optional>

#include "backends/factory.h"
#include "cli/command.h"

namespace rastercheck::cli {
ExitCode fail_backend(const Error& error) {
  const ExitCode usage = fail(error);
  return error.failure == Failure::refused ? usage : ExitCode::backend_unavailable;
}

ExitCode check_backends(const backends::BackendFactory& factory,
                        const std::vector<std::string>& specifications) {
  std::optional<Error> unavailable;
  for (const std::string& specification : specifications) {
    const auto backend = factory.make(specification);
    if (backend) continue;
    if (backend.error().failure == Failure::refused) return fail(backend.error());
    if (!unavailable) unavailable = backend.error();
  }
  return unavailable ? fail_backend(*unavailable) : ExitCode::ok;
}

}  // namespace rastercheck::cli
