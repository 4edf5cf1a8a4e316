#pragma once

// What OpenGL and Vulkan promise of a case, whoever implements them: the contract that drivers are
// held to. Derived from the specifications in api_promise.cpp.

#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::backends {

/// What an implementation says of itself that its promises depend on.
struct ApiLimits {
  int subpixel_bits = 4;  ///< GL_SUBPIXEL_BITS, subPixelPrecisionBits
};

/// The contract of a case without a camera.
cases::Contract api_promise(const cases::Case& c, const ApiLimits& limits);

}  // namespace rastercheck::backends
