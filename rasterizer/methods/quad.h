#pragma once

// Quads as projective maps: where parameters are given at the four corners of a quad, they are
// assumed to be object-projective, and each corner has a w_r of its own (seed 002 §3.4; P. S.
// Heckbert, Fundamentals of Texture Mapping and Image Warping, 1989, which the seed names for maps
// that have to be inferred).
//
// The mathematics. p_i = (x_i, y_i, w_i) are the corners' clip positions and U_i = (u_i, v_i, 1)
// their parameters, i = 0…3 around the quad. Four columns are linearly dependent (Cramer):
//
//   a_0 p_0 − a_1 p_1 + a_2 p_2 − a_3 p_3 = 0,     a_i = det(p_{i+1}, p_{i+2}, p_{i+3}),
//   d_0 U_0 − d_1 U_1 + d_2 U_2 − d_3 U_3 = 0,     d_i alike of the U_i,
//
// and, no three on a line, in one way only. A linear H with H p_i = w_r,i U_i therefore has
//
//   w_r,i = d_i / a_i                                      (a common factor left out)
//
// and (u w_r, v w_r, w_r) is linear in clip space: (u w_r/w, v w_r/w, w_r/w) is screen-affine,
// which is what object_projective.h interpolates. Of the unit square, d_i = 1, with σ_i = a_i,
//
//   S = [σ_1 p_1 − σ_0 p_0   σ_3 p_3 − σ_0 p_0   σ_0 p_0]
//
// takes (s, t, 1) to the quad. This is Heckbert's closed form for any w_i: where these are 1, and σ
// is scaled so that σ_0 = 1, it is σ_1 = 1 + g and σ_3 = 1 + h with his g = det(Σ, Δ2)/det(Δ1, Δ2)
// and h = det(Δ1, Σ)/det(Δ1, Δ2), and the columns are his (a, d, g), (b, e, h) and (c, f, 1). With
// T for the parameters what S is for the positions,
//
//   H = T S^-1,     H^-1 = S T^-1,     S^-1 = adj S and T^-1 = adj T but for factors.
//
// a_i is the turn from p_{i+1} by p_{i+2} to p_{i+3} as the eye sees it: the quad is convex where
// all four have one sign, whatever the signs of the w_i; then its diagonals cross, as a_0 p_0 +
// a_2 p_2 = a_1 p_1 + a_3 p_3 says. Where the parameters are convex too, all w_r have one sign, and
// no pole runs through the quad.
//
// More than two parameters: four points of a space of more dimensions lie in no plane, so that no
// one projective map takes four corners to them. Parameters are taken in pairs, each pair with a
// w_r of its own.

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string_view>

namespace rastercheck::rasterizer {

/// Corners one after the other around the quad, either way.
struct Quad {
  std::array<glm::vec4, 4> positions;   ///< in clip space; z has no say, w <= 0 is ordinary
  std::array<glm::vec2, 4> parameters;  ///< u and v
};

/// Why a quad has no map; the first of these that holds.
enum class QuadError {
  not_finite,             ///< a number of a position or a parameter
  corners_in_line,        ///< three corners, as the eye sees them: a degenerate mapping
  not_convex,             ///< the corners, as the eye sees them, in the order given
  parameters_in_line,     ///< three of the four (u, v): a degenerate mapping
  parameters_not_convex,  ///< in the order given: a w_r would have another sign, the quad a pole
  factors_out_of_range,   ///< the σ_i of one side differ by a factor of more than 2^64
};

/// One sentence about an error.
std::string_view to_string(QuadError error);

/// A matrix, and in `sizes` the same formulas of magnitudes, all signs positive: every number is
/// off by at most kMatrixError times its size.
struct SizedMatrix {
  glm::dmat3 matrix{0};
  glm::dmat3 sizes{0};
};
/// Derived in quad.cpp, as the next.
inline constexpr double kMatrixError = 18 * 0x1p-53;
/// Each w_r is off by at most this share of itself, but for a common factor.
inline constexpr double kWeightError = 6 * 0x1p-53;

struct QuadMap {
  std::array<double, 4> w_r{};  ///< of the corners, positive, the greatest in [1/2, 1)
  SizedMatrix to_parameters;    ///< H: (x, y, w) to (u q, v q, q)
  SizedMatrix to_clip;          ///< H^-1 but for a factor: (u, v, 1) to (x, y, w)
};

/// `error` set: there is no map.
struct QuadResult {
  std::optional<QuadError> error;
  QuadMap map;
};

QuadResult infer(const Quad& quad);

/// S of the corners' columns and σ: (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1) to σ_i p_i.
SizedMatrix square_to_quad(const std::array<glm::dvec3, 4>& corners,
                           const std::array<double, 4>& sigma);

}  // namespace rastercheck::rasterizer
