// Throughout, δ is the relative error of one operation and a step is 1/255.
//
// Blending. OpenGL 4.6, 17.3.6, and Vulkan 1.3, "Blending": blending is carried out as if in
// floating-point, with no less precision than the target has. In float32 targets, s_a s, 1 − s_a,
// (1 − s_a) d and their sum take four operations, of which no term meets more than three: the error
// is at most 3δ of the summed sizes of both products, and kRest covers the higher orders. In
// targets of 8 bits, every number on the way may be rounded to 8 bits, by r steps: s and s_a, which
// moves s_a s + (1 − s_a) d by up to r (s_a + |s − d|) <= 2r, and both products. Their sum is then
// exact, so the error is at most 4r.
//
// Stores. OpenGL 4.6, 2.3.5.2, and Vulkan 1.3, "Conversion From Floating-Point to Normalized
// Fixed-Point": a float times 255 becomes one of its two neighbouring integers, r = 1, preferably
// the nearer one. For `ieee`, r is 0.6, which Direct3D 11.3 demands (3.2.3.6, "FLOAT -> UNORM"),
// and 1/2 on the way to a blend, as arithmetic in 8 bits is arithmetic of whole bytes.
//
// Resolve. OpenGL 4.6, 18.3.1, leaves open how the samples of a pixel become one; each
// implementation that is known takes their mean, which `ieee` asks for: in float32 n − 1 sums and a
// product, nδ of the summed sizes over n; in 8 bits, means of two samples, of two such means and so
// on may each be rounded by 1/2, in all log2(n)/2.
//
// Texels. OpenGL 4.6, 8.14, and Vulkan 1.3, "Texel Coordinate Systems": s W takes one operation and
// may be rounded to a fixed-point number of the implementation's bits, at least 4 in Vulkan
// (subTexelPrecisionBits). Colours k/255 take one operation. A bilinear filter's weights are the
// fractions of s W − 1/2, which takes two, both of numbers as large as s W; each axis adds its
// error, in texels, to a colour, as neighbouring texels differ by at most 1. Three interpolations
// follow, each in at least the precision of the texture's 8 bits: three steps.
//
// Fragments. That a picture shows the values that a program with other outputs draws, and that
// differences across quads are those of these values, follows from no specification. Drivers that
// draw on the processor do so, which `ieee` asks for; but of several samples, the centroid may be
// that of those samples that are left after a depth test.

#include "backends/internal/picture_promise.h"

#include <algorithm>
#include <cmath>

#include "backends/internal/rounded_up.h"

namespace rastercheck::backends {
namespace {

constexpr double kBlending = 3;
constexpr double kByteSteps = 255;
constexpr float kNearestOfDirect3D = 0.6F;
/// In units of 2^-24.
constexpr double kUnit = 0x1p24;

bool has_open_centroids(const cases::Case& c) {
  return c.framebuffer.samples > 1 &&
         std::any_of(c.attributes.begin(), c.attributes.end(), [](const cases::Attribute& a) {
           return a.location == cases::Location::centroid &&
                  a.interpolation != cases::Interpolation::flat;
         });
}

}  // namespace

void promise_pictures(const cases::Case& c, const ApiLimits& limits, cases::DriverPromise promised,
                      double operation, cases::Contract& contract) {
  const bool is_ieee = promised == cases::DriverPromise::ieee;
  const double operations = std::max(kBlending, static_cast<double>(c.framebuffer.samples));
  const float byte_store = is_ieee ? kNearestOfDirect3D : 1.0F;
  const double texel = std::ldexp(1.0, -limits.subtexel_bits);
  contract.picture_bounds = {
      .keeps_fragments = is_ieee && !has_open_centroids(c),
      .resolves_to_mean = is_ieee,
      .float_error = no_less(kRest * operations * operation * kUnit),
      .byte_store = byte_store,
      .byte_blend = is_ieee ? 2.0F : 4.0F,
      .byte_mean = std::max(byte_store, no_less(std::log2(c.framebuffer.samples) / 2)),
      .texel_share = no_less(kRest * operation),
      .texel_distance = no_less(texel)};
  contract.texture_bounds = {
      .coordinate_share = no_less(kRest * 2 * operation),
      .bilinear = no_less(kRest * (2 * texel + 3 / kByteSteps + 2 * operation) * kUnit)};
}

}  // namespace rastercheck::backends
