#pragma once

// A textbook method (rasterizer/methods/) as a backend.

#include <memory>

#include "backends/backend.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::backends {

std::unique_ptr<Backend> make_method_backend(const rasterizer::Method& method);

}  // namespace rastercheck::backends
