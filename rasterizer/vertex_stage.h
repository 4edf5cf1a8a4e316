#pragma once

// The vertex stage: object space to clip space, and normals to world space.
//
// Conventions. GLM's: a matrix is [column][row] and multiplies column vectors from the left. Below
// u = 2^-53, and ulp(f) = 2^(max(floor(log2 |f|), −126) − 23) of float32, ulp(0) = 2^-149.
//
// Clip positions. clip = P V M p, computed as (P (V M)) p in double and rounded to float32 once. A
// product of two float32 is exact in double; a sum of four, by pairs, rounds each term twice. Of
// each of the 64 terms P_ka V_ab M_bc p_c of clip_k,
//
//   V M        is rounded 2 times    (products exact)
//   P (V M)              3 times
//   (P V M) p            3 times
//
// and the terms' sizes add up to S = |P| |V| |M| |p|, so that the double is off by at most
// ((1 + u)^8 − 1) S_k = (8 u + 28 u² + …) S_k < 8 (1 + 2^-23) u S_k, and the float32 f by
//
//   |f − clip_k| <= kTransformBound · 2^-53 · S_k + ulp(f) / 2.
//
// That holds of all finite inputs, subnormals and subnormal results included. Numbers in double are
// multiples of 2^-596 and at most 64 · 2^512, so that none of them is subnormal or overflows.
// Beyond float32 f is infinite and stands for ±2^128, with half an ulp of 2^103.
//
// Normals. n' = s m / ‖m‖ with m = C n, C the cofactors of the model's upper left 3×3 part A and s
// the sign of det A: the inverse transpose is C / det A, of which a unit vector keeps the sign. s
// is exact, so a mirrored model keeps outward normals outward. In double each cofactor is rounded
// once, its product with n once and the sum of three twice, so that m is off by
// |δ_i| <= ((1 + u)^4 − 1) (|C| |n|)_i; and two vectors that differ by δ have directions that
// differ by at most 2 ‖δ‖ / ‖m‖. Of the unit vector, whose components are at most 1, length and
// quotient are off by 3 1/2 roundings: squares and sums 3, halved by the root, the root and the
// division. Together, with ‖·‖ Euclid's,
//
//   |f_i − n'_i| <= kNormalBound · 2^-53 · K + 4 · 2^-53 + ulp(f_i) / 2,   K = ‖|C| |n|‖ / ‖C n‖.
//
// K is 1 where nothing cancels, as for rotations and scales along the axes of a normal along an
// axis, and at most √3 cond(A) always. Where det A = 0 m may be zero, K infinite and what roundings
// leave of m a direction of no meaning: there it is summed without rounding. Squares are multiples
// of 2^-894 and at most 2^780: neither subnormal nor infinite.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Object space to world, eye and clip space. The clip space is that of State::convention, which
/// the projection has to know.
struct Camera {
  glm::mat4 model{1};
  glm::mat4 view{1};
  glm::mat4 projection{1};
};

/// How far clip coordinates may be off besides half an ulp, in 2^-53 (|P| |V| |M| |p|)_k.
inline constexpr float kTransformBound = 8 + 0x1p-20F;
/// How far components of normals may be off besides 2^-51 and half an ulp, in 2^-53 K.
inline constexpr float kNormalBound = 8 + 0x1p-20F;

/// Appends the clip positions of object positions, one for each; w of a vec3 is 1. What is beyond
/// float32 becomes infinite, and inputs that are not finite make positions that are not: a draw
/// discards and counts their triangles. `positions` is no part of `clip`, which stays as it was
/// where memory runs out.
std::optional<Error> transform(const Camera& camera, std::span<const glm::vec4> positions,
                               std::vector<glm::vec4>& clip);
std::optional<Error> transform(const Camera& camera, std::span<const glm::vec3> positions,
                               std::vector<glm::vec4>& clip);

/// Appends the unit normals in world space of normals in object space of any length, one for each.
/// Zero where there is no direction: the normal is zero or its image is, or something is not
/// finite. A model with determinant 0 has no inverse; its cofactors count as they are. `normals` is
/// no part of `world`, which stays as it was where memory runs out.
std::optional<Error> transform_normals(const glm::mat4& model, std::span<const glm::vec3> normals,
                                       std::vector<glm::vec3>& world);

}  // namespace rastercheck::rasterizer
