#pragma once

// Quads as projective maps: parameters given at the four corners of a quad are assumed to be
// object-projective, and each corner has a w_r of its own (Heckbert & Moreton 1991, §3.4; P. S.
// Heckbert, Fundamentals of Texture Mapping and Image Warping, 1989, which Heckbert & Moreton cite
// for maps that must be inferred).
//
// The mathematics. p_i = (x_i, y_i, w_i) are the corners' clip positions and U_i = (u_i, v_i, 1)
// their parameters, i = 0…3 around the quad. Four columns are linearly dependent (Cramer):
//
//   a_0 p_0 − a_1 p_1 + a_2 p_2 − a_3 p_3 = 0,     a_i = det(p_{i+1}, p_{i+2}, p_{i+3}),
//   d_0 U_0 − d_1 U_1 + d_2 U_2 − d_3 U_3 = 0,     d_i likewise from the U_i,
//
// and the relation is unique up to a factor if no three are on a line. A linear H with H p_i =
// w_r,i U_i therefore has
//
//   w_r,i = d_i / a_i                                      (up to a common factor)
//
// Then (u w_r, v w_r, w_r) is linear in clip space, so (u w_r/w, v w_r/w, w_r/w) is screen-affine,
// as interpolation by object_projective.h requires. For the unit square, d_i = 1; with σ_i = a_i,
//
//   S = [σ_1 p_1 − σ_0 p_0   σ_3 p_3 − σ_0 p_0   σ_0 p_0]
//
// takes (s, t, 1) to the quad. This is Heckbert's closed form for any w_i. If all w_i are 1 and σ
// is scaled so that σ_0 = 1, then σ_1 = 1 + g and σ_3 = 1 + h with his g = det(Σ, Δ2)/det(Δ1, Δ2)
// and h = det(Δ1, Σ)/det(Δ1, Δ2), and the columns are his (a, d, g), (b, e, h) and (c, f, 1). Let T
// be the matrix S with parameters in place of positions; then
//
//   H = T S^-1,     H^-1 = S T^-1,     S^-1 = adj S and T^-1 = adj T up to factors.
//
// The sign of a_i is the sense in which the eye sees p_{i+1}, p_{i+2}, p_{i+3} turn. The quad is
// convex if all four a_i have one sign, whatever the signs of the w_i; its diagonals then cross, by
// a_0 p_0 + a_2 p_2 = a_1 p_1 + a_3 p_3. If the parameters are convex too, all w_r have one sign,
// and no pole runs through the quad.
//
// More than two parameters: four points in a space of higher dimension do not in general lie in a
// plane, so no single projective map takes four corners to them. Parameters are taken in pairs,
// each pair with a w_r of its own.

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string_view>

namespace rastercheck::rasterizer {

/// Corners in order around the quad, in either direction.
struct Quad {
  std::array<glm::vec4, 4> positions;   ///< in clip space; z is ignored; w <= 0 is allowed
  std::array<glm::vec2, 4> parameters;  ///< u and v
};

/// Why a quad has no map; the first reason in this order.
enum class QuadError {
  not_finite,          ///< a position or a parameter is not finite
  corners_in_line,     ///< three corners are in line, as the eye sees them: degenerate mapping
  not_convex,          ///< the corners in the given order, as the eye sees them, are not convex
  parameters_in_line,  ///< three of the four (u, v) are in line: degenerate mapping
  /// The (u, v) in the given order are not convex: the w_r differ in sign, and the map has a pole
  /// within the quad.
  parameters_not_convex,
  factors_out_of_range,  ///< the σ_i of one side differ by a factor of more than 2^64
};

/// One sentence that explains the error.
std::string_view to_string(QuadError error);

/// A matrix with error bounds: `sizes` holds the same formulas with magnitudes in place of numbers
/// and all signs positive. Each element's error is at most kMatrixError times its size.
struct SizedMatrix {
  glm::dmat3 matrix{0};
  glm::dmat3 sizes{0};
};
/// Derived in quad.cpp, as is kWeightError.
inline constexpr double kMatrixError = 18 * 0x1p-53;
/// Maximum relative error of each w_r, apart from a common factor.
inline constexpr double kWeightError = 6 * 0x1p-53;

struct QuadMap {
  std::array<double, 4> w_r{};  ///< one per corner, positive, the greatest in [1/2, 1)
  SizedMatrix to_parameters;    ///< H: (x, y, w) to (u q, v q, q)
  SizedMatrix to_clip;          ///< H^-1 up to a factor: (u, v, 1) to (x, y, w)
};

/// If `error` is set, the quad has no map.
struct QuadResult {
  std::optional<QuadError> error;
  QuadMap map;
};

QuadResult infer(const Quad& quad);

/// Returns S for the corners' columns and σ. It maps (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1) to
/// σ_i p_i.
SizedMatrix square_to_quad(const std::array<glm::dvec3, 4>& corners,
                           const std::array<double, 4>& sigma);

}  // namespace rastercheck::rasterizer
