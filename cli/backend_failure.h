#pragma once

#include <string>
#include <vector>

#include "backends/factory.h"
#include "cases/error.h"
#include "cli/exit_code.h"

namespace rastercheck::cli {

/// Says why a backend could not be made (backends::make_backend): `backend_unavailable` where it is
/// one that cannot run here, `usage` where there is none of that name.
ExitCode fail_backend(const Error& error);

/// Whether all these backends can be made; else says why the first cannot, `usage` before
/// `backend_unavailable`.
ExitCode check_backends(const backends::BackendFactory& factory,
                        const std::vector<std::string>& specifications);

}  // namespace rastercheck::cli
