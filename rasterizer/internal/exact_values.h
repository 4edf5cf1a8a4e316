#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Depth and attributes of a triangle, rounded once (RULES §6).
//
//   smooth         r = Σ r_i E_i / Σ E_i
//   noperspective  r = Σ r_i w_i E_i / (|det| T)          r_i w_i is exact in double
//   depth          z = Σ z_i E_i / (|det| T), then n + (f − n) z, halved for OpenGL, and the bias
//                  (depth_bias.h)
//
// All are computed in double if a certificate (certificates.h) shows that double suffices;
// numerators and denominator are each collected into one plane (plane.h). Otherwise (slivers, the
// horizon, w of both signs) the sums are formed without rounding (exact_sum.h) and divided once,
// which gives the value a relative error of 2^-50.
//
// Constants: with r_i = c the computed value is within 2^-31 of c and rounds to c. If all vertices
// have the same zero, it is copied, sign included. If an attribute is not finite, every sample gets
// the sum of the vertices' values, infinite or NaN. A plane of equal depth (z_i w_j = z_j w_i
// exactly) has one depth for all its samples. If all w are equal, smooth and noperspective
// coincide, and no sample needs a division (Appendix 5; Heckbert & Moreton 1991, §3.3).
//
// A corner that clipping made, with shares s_v of the vertices, has r = Σ s_v r_v, and
// Σ s_v r_v w_v for affine values. Shares have a relative error of 2^-50 and none is negative, so r
// has an error of at most 2^-49 max|r_i|. With Precision::float32, attributes of triangles without
// such corners are computed in float32 (float_kernels.h) if no difference overflows. All other
// values, and those that are not certain, are computed as above.

#include <array>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/certificates.h"
#include "rasterizer/internal/depth_bias.h"
#include "rasterizer/internal/grid_polygon.h"
#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

/// One triangle's value, ready to be evaluated.
struct ValueLine {
  /// copied: independent of the weights. The others are evaluated by evaluate_smooth() or
  /// evaluate_affine().
  enum class Kind { copied, smooth, affine };
  Kind kind = Kind::copied;
  /// The factors of the E_i: r_i for a smooth value, r_i w_i for an affine one.
  std::array<double, 3> numerators{};
  /// Plane of the numerator Σ r_i E_i of a smooth value, or of the affine value itself.
  Plane plane;
  float copy = 0;  ///< for Kind::copied
  /// If true, the value is computed in float32 (float_kernels.h) from `r`.
  bool is_float = false;
  std::array<float, 3> r{};
};

/// Maps z of clip space to depth: low + span · z and the bias, clamped to [least, greatest], then
/// stored in a format of these steps (depth_store.h).
struct DepthRange {
  double low = 0;
  double span = 0;
  double least = 0;
  double greatest = 0;
  double steps = 0;
};
DepthRange depth_range(const State& state);

/// Returns the index of the vertex whose values flat attributes take.
std::size_t provoking_vertex(const State& state);

/// Depth, z = Σ k_i E_i / (|det| T).
struct DepthLine : DepthRange {
  std::array<double, 3> k{};
  /// The plane of the biased depth; constant if the triangle is a plane of equal depth.
  Plane plane;
  DepthOffset offset = {};  ///< the bias
};

struct TriangleValues {
  std::array<double, 3> w{};  ///< w of the corners
  Plane sum;                  ///< D = Σ E_i
  std::vector<ValueLine> attributes;
  bool has_smooth = false;  ///< some attribute is of kind smooth
  bool has_smooth_float = false;
  bool has_affine_float = false;
  /// The `scale` of float_smooth_weights(): a power of two.
  double float_scale = 1;
  DepthLine depth;
  BiasTerms bias;  ///< set only if the draw has a bias
  bool has_constant_depth = false;
  Certificates certificates;
};

/// The corners of a piece (grid_piece.h), or nullptr.
using PieceCorners = std::array<const GridCorner*, 3>;

/// The inputs of values: a triangle's clip positions and attributes. If the weights belong to
/// snapped corners, `corners` holds those corners.
struct ValueSource {
  std::array<glm::vec4, 3> positions;
  std::array<std::span<const float>, 3> attributes;
  PieceCorners corners{};
};

/// Returns Σ k_i E_i without rounding.
ExactSum combine(const std::array<ExactSum, 3>& e, const std::array<double, 3>& k);

/// Prepares the values for evaluation.
void set_up_values(const State& state, const ValueSource& source, const Weights& weights,
                   TriangleValues& out);

/// Prepares the values of a triangle without area: those of its provoking vertex, everywhere
/// (Conservative::outer).
void set_up_flat_values(const State& state, const ValueSource& source, TriangleValues& out);

/// Returns the value at (u, v) before rounding to float32: in double if double is certain, else
/// from exact sums. The value is arbitrary where the rules leave it undefined (a smooth value with
/// 1/w <= 0).
double value_at(const ValueLine& line, const TriangleValues& triangle, const Weights& weights,
                double u, double v);

/// True if double suffices for the value at weights `e`. The value must not be a copied one.
bool is_certain(const ValueLine& line, const TriangleValues& triangle, double det_t,
                const std::array<double, 3>& e);

/// Returns value_at(), always from exact sums: relative error at most 2^-50.
double exact_value_at(const ValueLine& line, const Weights& weights, double u, double v);
/// Returns a number of magnitude below 2 · period that differs from ⌊scale · r⌋ by an exact
/// multiple of `period`, where r is the quotient of two sums; the denominator must be positive.
/// `period` must be a whole number below 2^51, or infinite. If `period` is infinite, returns
/// ⌊scale · r⌋ itself or, beyond 2^53, a neighbouring double.
double exact_floor(const ExactSum& numerator, ExactSum denominator, double scale, double period);
/// Does the same for the exact value at (u, v).
double exact_floor_at(const ValueLine& line, const TriangleValues& triangle, const Weights& weights,
                      double u, double v, double scale, double period);
/// Returns 1/w = Σ E_i / Σ w_i E_i from exact sums: relative error at most 2^-50.
double exact_reciprocal_w_at(const Weights& weights, double u, double v);
/// Returns the biased depth, clamped to its range but not stored, from exact sums.
double exact_depth_at(const TriangleValues& triangle, const Weights& weights, double u, double v);

}  // namespace rastercheck::rasterizer
