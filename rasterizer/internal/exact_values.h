#pragma once

// Depth and attributes of a triangle, rounded once (RULES §6).
//
//   smooth         r = Σ r_i E_i / Σ E_i
//   noperspective  r = Σ r_i w_i E_i / (|det| T)          r_i w_i is exact in double
//   depth          z = Σ z_i E_i / (|det| T), then n + (f − n) z, halved for OpenGL
//
// All in double. What that is off by comes from the E_i, each off by at most its band, and from a
// few roundings; a *certificate* shows that it is little:
//
//   smooth   |δr| <= max|r_i| (2 Σ band_i / D + 8u), so D >= 2^32 Σ band_i gives 2^-31 max|r_i|;
//            an ulp of max|r_i| is at least 2^-24 of it, hence at most 2^-7 scale ULP. With weights
//            of both signs (a centre outside) Σ|E_i| takes the place of D in the roundings.
//   affine   |δr| <= max|r_i| Σ |w_i| (band_i + 8u |E_i|) / (|det| T), certified below 2^-32.
//   depth    |δz| <= Σ |z_i| (band_i + 8u S_i) / (|det| T), certified below 2^-31; n, f and f − n
//            are at most max(|n|, |f|).
//
// With half an ULP for the rounding to float32 no value is off by more than kValueBound. Where a
// certificate fails (slivers, the horizon, w of both signs) sums are formed without rounding
// (exact_sum.h) and divided once: 2^-50 of the value itself.
//
// Constants: with r_i = c the computed value is within 10u of c and rounds to c. The same zero at
// all vertices is copied, sign included. A plane of equal depth, z_i w_j = z_j w_i exactly, has one
// depth for all its samples.

#include <array>
#include <glm/vec4.hpp>
#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/edge_functions.h"

namespace rastercheck::rasterizer {

/// One triangle's value, ready to be evaluated.
struct ValueLine {
  enum class Kind { copied, smooth, affine };
  Kind kind = Kind::copied;
  /// r_i of a smooth, r_i w_i of an affine value: exact.
  std::array<double, 3> numerators{};
  float copy = 0;  ///< of a copied one
};

struct TriangleValues {
  std::vector<ValueLine> attributes;
  DepthLine depth;
  bool has_constant_depth = false;
  float constant_depth = 0;
  double det_t = 0;                ///< |det| T, to a relative 2^-51
  double band_sum = 0;             ///< Σ band_i
  double least_sum = 0;            ///< the certificate of smooth values: Σ E_i above this
  bool affine_is_certain = false;  ///< the certificate of affine values of covered samples
  bool depth_is_certain = false;
  std::array<double, 3> affine_error{};  ///< |w_i| band_i
};

/// Prepares the values; `values[i]` are vertex i's attributes.
void set_up_values(const State& state, const std::array<glm::vec4, 3>& corners,
                   const std::array<std::span<const float>, 3>& values, const EdgeFunctions& edges,
                   const SampleFrame& frame, TriangleValues& out);

/// The value at (u, v), in double where certain, else from exact sums. Where the rules leave it
/// undefined (a smooth value with 1/w <= 0) some number.
float value_at(const ValueLine& line, const TriangleValues& triangle, const EdgeFunctions& edges,
               const SampleFrame& frame, double u, double v);

/// The same without asking whether double is enough.
float exact_value_at(const ValueLine& line, const TriangleValues& triangle,
                     const EdgeFunctions& edges, const SampleFrame& frame, double u, double v);
float exact_depth_at(const TriangleValues& triangle, const EdgeFunctions& edges,
                     const SampleFrame& frame, double u, double v);

}  // namespace rastercheck::rasterizer
