#pragma once

#include <string>
#include <vector>

#include "backends/factory.h"
#include "cases/error.h"
#include "cli/exit_code.h"

namespace rastercheck::cli {

/// Says why a backend could not be made (backends::make_backend). Returns `backend_unavailable` if
/// the backend cannot run here, and `usage` if no backend has that name.
ExitCode fail_backend(const Error& error);

/// Checks that all these backends can be made; otherwise says why the first cannot. Reports `usage`
/// errors before `backend_unavailable`.
ExitCode check_backends(const backends::BackendFactory& factory,
                        const std::vector<std::string>& specifications);

}  // namespace rastercheck::cli
