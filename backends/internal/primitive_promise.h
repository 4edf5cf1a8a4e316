#pragma once

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/driver_promise.h"

namespace rastercheck::backends {

/// How a driver may be off when it draws a line or a point whose vertices are off by
/// TrianglePromise::position_error.
struct PrimitiveError {
  double operation = 0;     ///< δ, the relative error of one operation
  double depth_scale = 1;   ///< how many times the depths exceed the depth range's larger end
  bool is_clipped = false;  ///< true if a vertex is beyond a plane or a side, or behind the eye
};

/// Restricts the promise of a triangle's vertices to that of a line or point of the case.
void promise_primitive(const cases::Case& c, cases::DriverPromise promised,
                       const PrimitiveError& error, cases::TrianglePromise& promise);

}  // namespace rastercheck::backends
