#pragma once

// The contract that drivers are held to: what OpenGL and Vulkan promise for a case, whichever
// driver implements them. api_promise.cpp derives it from both specifications. About numbers:
//
//   OpenGL 4.6, "Floating-Point Computation" (2.3.4.1); Vulkan 1.3, "Floating-Point Computation"
//   (Numeric Representation and Computation): results of single operations are accurate to about
//   one part in 10^5, and magnitudes up to 2^32 can be represented.
//
// About triangles:
//
//   OpenGL 4.6, 13.8 and 14.6.1, Vulkan 1.3, "Basic Polygon Rasterization": positions have at least
//   as many subpixel bits as the implementation reports, a sample on a shared edge belongs to
//   either triangle, and attributes and depth follow the quotients of RULES §1.
//
// The specifications leave open how positions are rounded and whether attributes come from the
// rounded positions. api_promise.cpp lists what else is assumed.
//
// Nothing here depends on how a driver actually behaves; probing measures that.

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/driver_promise.h"

namespace rastercheck::backends {

/// The contract of a case without a camera.
cases::Contract api_promise(const cases::Case& c, const ApiLimits& limits,
                            cases::DriverPromise promise);

}  // namespace rastercheck::backends
