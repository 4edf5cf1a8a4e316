#pragma once

// What OpenGL and Vulkan promise about pictures: blending, formats, resolve and texture lookups.

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/driver_promise.h"

namespace rastercheck::backends {

/// Adds the bounds of pictures of a case to its contract. `operation` is the relative error of a
/// single operation.
void promise_pictures(const cases::Case& c, const ApiLimits& limits, cases::DriverPromise promised,
                      double operation, cases::Contract& contract);

}  // namespace rastercheck::backends
