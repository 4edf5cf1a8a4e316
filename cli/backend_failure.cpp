#include "cli/backend_failure.h"

#include <algorithm>

#include "backends/backend.h"
#include "cli/command.h"

namespace rastercheck::cli {

ExitCode fail_backend(const Error& error) {
  const std::vector<backends::Listing> all = backends::list_backends();
  const bool cannot_run =
      std::any_of(all.begin(), all.end(), [&error](const backends::Listing& listing) {
        return listing.specification == error.file && !listing.unavailable_because.empty();
      });
  const ExitCode usage = fail(error);
  return cannot_run ? ExitCode::backend_unavailable : usage;
}

}  // namespace rastercheck::cli
