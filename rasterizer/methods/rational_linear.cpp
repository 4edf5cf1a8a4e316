// rational-linear: the rational linear rendering algorithm of Heckbert and Moreton, Interpolation
// for Polygon Texture Mapping and Shading, §3.5 (seed 002), in double.
//
// The mathematics (seed 002 §3.2). Parameters r_i that are affine in clip space divide into
//
//   s_i = r_i / w,   s_{n+1} = 1 / w,
//
// which are affine in window space. So: clip the triangle, with r_i linear in clip space; at each
// vertex divide by w; interpolate s_i linearly along the edges and along the rows; at each sample
// divide:
//
//   r_i = s_i / s_{n+1}.
//
// Steps 1 to 3 and the scan conversion are those of internal/polygon_drawing.h.
//
// Error, first order, u = 2^-53 (rounding to float32, once, comes on top). |δs_i| <= 11 u max|s_i|
// and what the places contribute (polygon_drawing.h), so of the quotients
//
//   |δr_i| <= (|δs_i| + |r_i| |δs_{n+1}|) / s_{n+1} + u |r_i|, that is
//
//   |δr_i| <= (|∂r_i/∂u| + |∂r_i/∂v|) δ + 23 u max|r_i| max(1/w) / s_{n+1}.
//
// The second term grows towards the horizon, where s_{n+1} is small against the greatest 1/w.
//
// What it does not do, besides what polygon_drawing.h does not: seed 002's reciprocal and products
// in place of the n divisions per pixel. They cost a rounding more.

#include <cstddef>
#include <span>

#include "rasterizer/internal/polygon_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

template <class T>
class RationalLinear : public LinearFormula<T> {
 public:
  void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const override {
    for (std::size_t i = 0; i < this->count_; ++i) s[i] = vertex.r[i] / vertex.w;
    s[this->count_] = T(1) / vertex.w;
  }
  void values(const Parameters<T>& s, std::span<T> r) const override {
    for (std::size_t i = 0; i < this->count_; ++i) r[i] = s[i] / s[this->count_];
  }

 protected:
  std::size_t parameter_count() const override { return this->count_ + 1; }
};

/// The derivation above: 23 u max|r_i| g is less than 2^-24 g scale ULP, as ulp(m) >= 2^-24 m.
Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return scanned_promise(Claim::perspective, {.constant = 0.5 + 0x1p-24, .per_horizon = 0x1p-24});
}

const MethodRegistration kRegistration({.name = "rational-linear",
                                        .source = "seed 002 §3.5 (Heckbert and Moreton, 1991)",
                                        .draw = &scan_triangles_by<RationalLinear>,
                                        .promise = &promise,
                                        .operations = &count_scan<RationalLinear>});

}  // namespace
}  // namespace rastercheck::rasterizer
