#pragma once

// The vertex stage: transforms positions from object space to clip space, and normals to world
// space.
//
// Conventions. As in GLM, a matrix is indexed [column][row] and multiplies column vectors from the
// left. u = 2^-53 is the unit roundoff of double. ulp(f) = 2^(max(floor(log2 |f|), −126) − 23) is
// the ulp of float32, with ulp(0) = 2^-149.
//
// Clip positions. clip = P V M p is computed as (P (V M)) p in double and rounded to float32 once.
// A product of two float32 numbers is exact in double. A sum of four terms, added by pairs, rounds
// each term twice. Each of the 64 terms P_ka V_ab M_bc p_c of clip_k is rounded as follows:
//
//   V M                  2 times    (products exact)
//   P (V M)              3 times
//   (P V M) p            3 times
//
// The terms' magnitudes add up to S = |P| |V| |M| |p|. The double therefore has an error of at most
// ((1 + u)^8 − 1) S_k = (8 u + 28 u² + …) S_k < 8 (1 + 2^-23) u S_k, and the float32 f satisfies
//
//   |f − clip_k| <= kTransformBound · 2^-53 · S_k + ulp(f) / 2.
//
// This holds for all finite inputs, including subnormals, and for subnormal results. The numbers in
// double are multiples of 2^-596 and at most 64 · 2^512, so none of them is subnormal or overflows.
// Beyond the range of float32, f is infinite and stands for ±2^128, with 2^103 as its half ulp.
//
// Normals. n' = s m / ‖m‖ with m = C n, where C holds the cofactors of the model's upper left 3×3
// part A and s is the sign of det A. (The inverse transpose is C / det A; after normalization, only
// the sign of det A matters.) s is exact, so a mirrored model keeps outward normals outward. In
// double, each cofactor is rounded once, its product with n once and the sum of three twice, so m
// has an error of |δ_i| <= ((1 + u)^4 − 1) (|C| |n|)_i. Two vectors that differ by δ have
// directions that differ by at most 2 ‖δ‖ / ‖m‖. The unit vector has components of at most 1. Its
// length and quotient add 3 1/2 roundings: 3 of squares and sums, halved by the root; the root; and
// the division. Together, with the Euclidean norm ‖·‖,
//
//   |f_i − n'_i| <= kNormalBound · 2^-53 · K + 4 · 2^-53 + ulp(f_i) / 2,   K = ‖|C| |n|‖ / ‖C n‖.
//
// K is 1 if nothing cancels: for rotations, and for scales along the axes if the normal lies along
// an axis. K is always at most √3 cond(A). If det A = 0, m may be zero, K infinite, and rounding
// errors may give m a meaningless direction; m is then summed without rounding. Squares are
// multiples of 2^-894 and at most 2^780, so none is subnormal or infinite.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Matrices from object space to world, eye and clip space. The projection must map to the clip
/// space of State::convention.
struct Camera {
  glm::mat4 model{1};
  glm::mat4 view{1};
  glm::mat4 projection{1};
};

/// Error bound of clip coordinates, in addition to half an ulp, in units of 2^-53 (|P| |V| |M|
/// |p|)_k.
inline constexpr float kTransformBound = 8 + 0x1p-20F;
/// Error bound of normals' components, in addition to 2^-51 and half an ulp, in units of 2^-53 K.
inline constexpr float kNormalBound = 8 + 0x1p-20F;

/// Appends the clip position of each object position; a vec3 has w = 1. Results beyond float32
/// become infinite. Inputs that are not finite give positions that are not finite; a draw discards
/// and counts their triangles. `positions` must not be part of `clip`. If memory runs out, `clip`
/// is left unchanged.
std::optional<Error> transform(const Camera& camera, std::span<const glm::vec4> positions,
                               std::vector<glm::vec4>& clip);
std::optional<Error> transform(const Camera& camera, std::span<const glm::vec3> positions,
                               std::vector<glm::vec4>& clip);

/// Appends the unit normal in world space of each normal in object space. Normals in object space
/// may have any length. The result is zero if the normal or its image is zero, or if any number is
/// not finite. A model with determinant 0 has no inverse; its cofactors are used as they are.
/// `normals` must not be part of `world`. If memory runs out, `world` is left unchanged.
std::optional<Error> transform_normals(const glm::mat4& model, std::span<const glm::vec3> normals,
                                       std::vector<glm::vec3>& world);

}  // namespace rastercheck::rasterizer
