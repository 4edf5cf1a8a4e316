#pragma once

// The edge functions of a triangle in homogeneous coordinates, and what double precision knows of
// them (RULES §1, §6; seed 000, clipless homogeneous scan conversion).
//
//   E_i = a_i U + b_i V + c_i T,      (a_i, b_i, c_i) = ±(x, y, w)_j × (x, y, w)_k
//
// with (U, V, T) of sample_frame.h and the sign of det (x, y, w), so that a sample is inside iff
// all E_i >= 0, whatever the signs of the w. E_i is the weight of vertex i: values are
// Σ r_i E_i / Σ E_i, and Σ w_i E_i = |det| T everywhere.
//
// What double knows. With u = 2^-53: a product of two floats is exact, so a coefficient has one
// rounding, and its sign is certain. A term then has a rounding of the product and at most two of
// sums: |δE_i| <= 4 u S_i (1 + 4u), S_i = |a_i| U_max + |b_i| V_max + |c_i| T, besides what U and V
// are off by. `band` is 8 u S_i + |a_i| δU + |b_i| δV, or 0 where nothing can be rounded: then the
// coefficients are exact, U and V too, and all terms are multiples of one power of two below 2^53
// of them. That is so of most geometry on a grid, where ties are everywhere.
//
// Exponents. Coefficients are multiples of 2^-298 up to 2^257, U, V and T of 2^-298 below 2^258 (a
// viewport's numbers are floats), hence E_i of 2^-596 below 2^516; with another float (z_i, r_i)
// all stays within 2^-745 … 2^646, with two (r_i w_i) within 2^-894 … 2^774.

#include <array>
#include <glm/vec4.hpp>

#include "rasterizer/internal/exact_sum.h"
#include "rasterizer/internal/sample_frame.h"

namespace rastercheck::rasterizer {

/// A coefficient: value + tail, exactly; the value is their sum rounded.
struct Coefficient {
  double value = 0;
  double tail = 0;
};

struct EdgeFunction {
  Coefficient a;
  Coefficient b;
  Coefficient c;
  double greatest = 0;     ///< S_i
  double band = 0;         ///< how far an evaluation may be off
  double plane_band = 0;   ///< how far its share of a sum may be off (plane.h)
  bool owns_zero = false;  ///< whether a sample with E_i = 0 is inside, by the fill rule

  /// b V + c T, the part that is the same along a row.
  double row(const SampleFrame& frame, double v) const {
    return b.value * frame.v.at(v) + c.value * frame.t;
  }
  /// What `at` and the lanes of a block compute, in this order of operations.
  double at(const SampleFrame& frame, double u, double row) const {
    return a.value * frame.u.at(u) + row;
  }
};

using EdgeFunctions = std::array<EdgeFunction, 3>;

/// `orientation` is sign det (x, y, w), 1 or −1. `tie_sign`: where a normal has A = 0, a sample on
/// the edge is inside iff tie_sign · B > 0 (RULES §2), A and B along window u and v.
EdgeFunctions edge_functions(const std::array<glm::vec4, 3>& corners, int orientation,
                             const SampleFrame& frame, int tie_sign);

/// E_i at (u, v), without rounding.
ExactSum exact_edge(const EdgeFunction& edge, const SampleFrame& frame, double u, double v);

/// Whether a normal (A, B), each as a sign in (U, V), lets a sample on its line inside.
bool owns_zero(int a, int b, const SampleFrame& frame, int tie_sign);

}  // namespace rastercheck::rasterizer
