#pragma once

// A textbook method (rasterizer/methods/) as a backend.

#include <memory>
#include <string>

#include "backends/backend.h"

namespace rastercheck::backends {

/// By a method of that name; where there is none, drawing fails.
std::unique_ptr<Backend> make_method_backend(const std::string& name);

}  // namespace rastercheck::backends
