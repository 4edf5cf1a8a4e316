#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The edge functions of a triangle in homogeneous coordinates, and their error bounds in double
// (RULES §1, §6; Appendix 5, clipless homogeneous scan conversion).
//
//   E_i = a_i U + b_i V + c_i T,      (a_i, b_i, c_i) = ±(x, y, w)_j × (x, y, w)_k
//
// with (U, V, T) of sample_frame.h. The sign ± is that of det (x, y, w), so a sample is inside iff
// all E_i >= 0, whatever the signs of the w. E_i is the weight of vertex i: values are
// Σ r_i E_i / Σ E_i, and Σ w_i E_i = |det| T everywhere.
//
// Error in double. Let u = 2^-53. A product of two floats is exact, so a coefficient has one
// rounding, and its sign is certain. A term then has the rounding of its product and at most two
// roundings of sums: |δE_i| <= 4 u S_i (1 + 4u) plus the errors of U and V, where S_i = |a_i|
// U_max + |b_i| V_max + |c_i| T. `band` is 8 u S_i + |a_i| δU + |b_i| δV. If no operation can
// round, `band` is 0: then the coefficients, U and V are exact, and all terms are multiples of one
// power of two, below 2^53 times that power. This holds for most geometry on a grid, where samples
// often lie exactly on edges.
//
// Exponents. Coefficients are multiples of 2^-298 up to 2^257; U, V and T are multiples of 2^-298
// below 2^258 (a viewport's numbers are floats). So the E_i are multiples of 2^-596 below 2^516. A
// product with another float (z_i, r_i) stays within 2^-745 … 2^646, and a product with two
// (r_i w_i) within 2^-894 … 2^774.

#include <array>
#include <glm/vec4.hpp>

#include "rasterizer/internal/exact_sum.h"
#include "rasterizer/internal/sample_frame.h"

namespace rastercheck::rasterizer {

/// A coefficient: exactly value + tail, where `value` is that sum rounded.
struct Coefficient {
  double value = 0;
  double tail = 0;
};

struct EdgeFunction {
  Coefficient a;
  Coefficient b;
  Coefficient c;
  double greatest = 0;     ///< S_i
  double band = 0;         ///< error bound of E_i evaluated in double
  double plane_band = 0;   ///< error bound of E_i's share of a sum (plane.h)
  bool owns_zero = false;  ///< by the fill rule, true if a sample with E_i = 0 is inside

  /// b V + c T, the part that is constant along a row.
  double row(const SampleFrame& frame, double v) const {
    return b.value * frame.v.at(v) + c.value * frame.t;
  }
  /// E_i, by the same order of operations as in the kernels.
  double at(const SampleFrame& frame, double u, double row) const {
    return a.value * frame.u.at(u) + row;
  }
};

using EdgeFunctions = std::array<EdgeFunction, 3>;

/// `orientation` is sign det (x, y, w), 1 or −1. `tie_sign`: if a normal has A = 0, a sample on the
/// edge is inside iff tie_sign · B > 0 (RULES §2), with A and B along window u and v.
EdgeFunctions edge_functions(const std::array<glm::vec4, 3>& corners, int orientation,
                             const SampleFrame& frame, int tie_sign);

/// Returns E_i at (u, v), without rounding.
ExactSum exact_edge(const EdgeFunction& edge, const SampleFrame& frame, double u, double v);

/// True if an edge owns the samples on its line; `a` and `b` are the signs of its normal (A, B) in
/// (U, V).
bool owns_zero(int a, int b, const SampleFrame& frame, int tie_sign);

}  // namespace rastercheck::rasterizer
