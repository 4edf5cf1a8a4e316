#include "cli/backend_failure.h"

#include <algorithm>
#include <optional>

#include "backends/backend.h"
#include "cli/command.h"

namespace rastercheck::cli {
namespace {

/// Whether it is one that there is, and that cannot run here.
bool is_unavailable(const Error& error) {
  const std::vector<backends::Listing> all = backends::list_backends();
  return std::any_of(all.begin(), all.end(), [&error](const backends::Listing& listing) {
    return listing.specification == error.file && !listing.unavailable_because.empty();
  });
}

}  // namespace

ExitCode fail_backend(const Error& error) {
  const ExitCode usage = fail(error);
  return is_unavailable(error) ? ExitCode::backend_unavailable : usage;
}

ExitCode check_backends(const std::vector<std::string>& specifications) {
  std::optional<Error> unavailable;
  for (const std::string& specification : specifications) {
    const auto backend = backends::make_backend(specification);
    if (backend) continue;
    if (!is_unavailable(backend.error())) return fail(backend.error());
    if (!unavailable) unavailable = backend.error();
  }
  return unavailable ? fail_backend(*unavailable) : ExitCode::ok;
}

}  // namespace rastercheck::cli
