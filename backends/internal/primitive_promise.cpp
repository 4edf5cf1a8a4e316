// Lines. OpenGL 4.6, 14.5.4 (several samples), and Vulkan 1.3, "Basic Line Segment Rasterization"
// (strict lines and rectangular ones): a line covers the samples in a rectangle between its ends,
// which are off as vertices of triangles are. What else both APIs permit a contract cannot say.
// Bresenham's lines may be off by a pixel as long as the whole is like a line (OpenGL 4.6, 14.5.1;
// Vulkan 1.3, "Bresenham Line Segment Rasterization"): the oracle promises nothing about the pixels
// of such a line if its ends are open, as they are here. Lines that are not strict, which are
// parallelograms, may be drawn as Bresenham's; `ieee` assumes that they are not. Values along lines
// have no bound: those of triangles follow from three planes, which lines do not have. Flat values
// are copies.
//
// Points. OpenGL 4.6, 14.4, and Vulkan 1.3, "Basic Point Rasterization": all fragments of a point
// have the vertex's values. A driver that divides by w and multiplies again takes two operations
// for r/w, one for 1/w and two for their quotient, and its planes are level. Depth takes a quotient
// and three operations for the depth range.
//
// The samples that are left of a line or point whose vertices planes cut off depend on how this is
// done: nothing is promised.

#include "backends/internal/primitive_promise.h"

#include "backends/internal/rounded_up.h"

namespace rastercheck::backends {
namespace {

constexpr double kPointValue = 5;
constexpr double kPointDepth = 5;
/// An error, in units of the last digit, that leaves no digit of a number correct.
constexpr float kWithoutBound = 0x1p24F;

bool may_be_drawn_otherwise(const cases::Case& c, cases::DriverPromise promised) {
  return c.primitive == cases::Primitive::lines && c.line_mode == cases::LineMode::parallelogram &&
         promised != cases::DriverPromise::ieee;
}

/// The bound for an error that is a share of the value; half an ulp is the rounding of the result.
cases::ValueBound point_bound(double share) {
  const double ulps = share * kRest * double{kWithoutBound} + 0.5;
  return {ulps < double{kWithoutBound} ? no_less(ulps) : kWithoutBound};
}

}  // namespace

void promise_primitive(const cases::Case& c, cases::DriverPromise promised,
                       const PrimitiveError& error, cases::TrianglePromise& promise) {
  promise.is_made = promise.is_made && !error.is_clipped && !may_be_drawn_otherwise(c, promised);
  if (c.primitive == cases::Primitive::lines) {
    const cases::ValueBound none{kWithoutBound};
    promise.bounds = {none, none, none};
    return;
  }
  const cases::ValueBound value = point_bound(kPointValue * error.operation);
  promise.bounds = {value, value, point_bound(kPointDepth * error.operation * error.depth_scale)};
}

}  // namespace rastercheck::backends
