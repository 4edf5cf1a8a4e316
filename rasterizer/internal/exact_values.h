#pragma once

// Depth and attributes of a triangle, rounded once (RULES §6).
//
//   smooth         r = Σ r_i E_i / Σ E_i
//   noperspective  r = Σ r_i w_i E_i / (|det| T)          r_i w_i is exact in double
//   depth          z = Σ z_i E_i / (|det| T), then n + (f − n) z, halved for OpenGL
//
// All in double, numerators and denominator each collected into one plane (plane.h), where a
// certificate (certificates.h) shows that that is enough. Where it fails (slivers, the horizon, w
// of both signs) sums are formed without rounding (exact_sum.h) and divided once: 2^-50 of the
// value itself.
//
// Constants: with r_i = c the computed value is within 2^-31 of c and rounds to c. The same zero at
// all vertices is copied, sign included. Of attributes that are not finite every sample has the
// sum, infinite or no number. A plane of equal depth, z_i w_j = z_j w_i exactly, has one depth for
// all its samples. Where all w are the same, smooth and noperspective are one, and nothing is
// divided at a sample (seed 000; seed 002 §3.3).
//
// A corner that clipping made, with shares s_v of the vertices, has r = Σ s_v r_v and for affine
// values Σ s_v r_v w_v: shares are within 2^-50 of themselves and none is negative, so that this is
// within 2^-49 of max|r_i|. In float32 (float_kernels.h) go the attributes of triangles whose
// corners are their own, where no difference overflows; the rest, and what is not certain, as
// above.

#include <array>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/certificates.h"
#include "rasterizer/internal/grid_polygon.h"
#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

/// One triangle's value, ready to be evaluated.
struct ValueLine {
  /// From the weights not at all, or as evaluate_smooth() or evaluate_affine() has it.
  enum class Kind { copied, smooth, affine };
  Kind kind = Kind::copied;
  /// What the E_i are multiplied with: r_i of a smooth, r_i w_i of an affine value.
  std::array<double, 3> numerators{};
  /// Of a smooth value the numerator Σ r_i E_i, of an affine one the value.
  Plane plane;
  float copy = 0;  ///< of a copied one
  /// Whether it is to be computed in float32 (float_kernels.h) from these r_i.
  bool is_float = false;
  std::array<float, 3> r{};
};

/// Where depths come from z of the clip volume: low + span · z, held to [least, greatest].
struct DepthRange {
  double low = 0;
  double span = 0;
  double least = 0;
  double greatest = 0;
};
DepthRange depth_range(const State& state);

/// The corner whose values flat attributes have.
std::size_t provoking_vertex(const State& state);

/// Depth, z = Σ k_i E_i / (|det| T).
struct DepthLine : DepthRange {
  std::array<double, 3> k{};
  /// The same evaluated; of a plane of equal depth just that.
  Plane plane;
};

struct TriangleValues {
  std::array<double, 3> w{};  ///< of the corners
  Plane sum;                  ///< D = Σ E_i
  std::vector<ValueLine> attributes;
  bool has_smooth = false;  ///< some attribute is of kind smooth
  bool has_smooth_float = false;
  bool has_affine_float = false;
  /// float_smooth_weights': a power of two.
  double float_scale = 1;
  DepthLine depth;
  bool has_constant_depth = false;
  Certificates certificates;
};

/// The corners of a piece (grid_piece.h), or nullptr.
using PieceCorners = std::array<const GridCorner*, 3>;

/// What values are made of: a triangle's clip positions and attributes, and, where the weights
/// belong to snapped corners, these.
struct ValueSource {
  std::array<glm::vec4, 3> positions;
  std::array<std::span<const float>, 3> attributes;
  PieceCorners corners{};
};

/// Prepares the values.
void set_up_values(const State& state, const ValueSource& source, const Weights& weights,
                   TriangleValues& out);

/// The value at (u, v) before it is rounded to float32: in double where certain, else from exact
/// sums. Where the rules leave it undefined (a smooth value with 1/w <= 0) some number.
double value_at(const ValueLine& line, const TriangleValues& triangle, const Weights& weights,
                double u, double v);

/// Whether double is enough for it, where the weights are these. It is not copied.
bool is_certain(const ValueLine& line, const TriangleValues& triangle, double det_t,
                const std::array<double, 3>& e);

/// value_at() without asking whether double is enough: within 2^-50 of itself.
double exact_value_at(const ValueLine& line, const Weights& weights, double u, double v);
/// ⌊scale · r⌋ of the same r as std::fmod by `period` leaves it, or an equal number modulo that,
/// less than 2 · period from 0; without rounding if `period` is a whole number below 2^51. With an
/// infinite one that is ⌊scale · r⌋, beyond 2^53 a double next to it.
double exact_floor_at(const ValueLine& line, const TriangleValues& triangle, const Weights& weights,
                      double u, double v, double scale, double period);
/// Held to its range.
double exact_depth_at(const TriangleValues& triangle, const Weights& weights, double u, double v);

}  // namespace rastercheck::rasterizer
