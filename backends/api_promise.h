#pragma once

// What OpenGL and Vulkan promise of a case, whoever implements them: the contract that drivers are
// held to. api_promise.cpp derives it from what both specifications say of numbers:
//
//   OpenGL 4.6, "Floating-Point Computation" (2.3.4.1); Vulkan 1.3, "Floating-Point Computation"
//   (Numeric Representation and Computation): results of single operations are accurate to about
//   one part in 10^5, and magnitudes up to 2^32 can be represented;
//
// and of triangles: OpenGL 4.6, 13.8 and 14.6.1, Vulkan 1.3, "Basic Polygon Rasterization": at
// least as many subpixel bits as the implementation says, either owner of an edge, attributes and
// depth by the quotients of RULES §1. How positions are rounded, and whether attributes come from
// the rounded ones, is left open.
//
// What else is taken for granted stands in api_promise.cpp.
//
// Nothing here knows what a driver does in fact: probing measures that.

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/driver_promise.h"

namespace rastercheck::backends {

/// The contract of a case without a camera.
cases::Contract api_promise(const cases::Case& c, const ApiLimits& limits,
                            cases::DriverPromise promise);

}  // namespace rastercheck::backends
