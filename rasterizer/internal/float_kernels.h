#pragma once

// Serves the route “fragments” (docs/rasterizer.md, Routes).
//
// Computes a block's attributes in float32, the rasterizer's second precision (RULES §6).
//
//   r = r_p + Σ_i c_i (r_(i+1) − r_i),   p the vertex of the largest share (the *pivot*),
//   c_p = b_(p+1),  c_(p+2) = −b_(p+2),  c_(p+1) = 0,     b_i the shares, indices modulo 3.
//
// This equals r_p + (r_j − r_p) b_j + (r_k − r_p) b_k, where j and k are the other two vertices.
// The form above lets all lanes use the same three differences; adding 0 times a difference rounds
// nothing. The shares are E_i / Σ E_i (smooth) or factor_i E_i (affine). Negative shares, which
// only errors of the E_i can cause, count as 0. Every target computes the same bits: nothing is
// fused.
//
// Bound. Let v = 2^-24 and U = 1 scale ULP, and choose the unit of length so that U = 2 v and all
// |r_i| < R = 2. Rounding x costs at most v 2^floor(log2 |x|). The pivot's share is the largest, so
// m = b_j + b_k <= 2/3, and b_j, b_k <= 1/2 even as computed. With X = r − r_p, |X| <= 4 m.
//
//   differences   |r_j − r_p| < 4: 2 v, times the share                               m U
//   shares        below 1/2: v / 4, times less than 4, for both                       1 U
//   products      (r_j − r_p) b_j < 2: v, for both                                    1 U
//   their sum     below 4: 2 v; below 2: v                                            1 U
//   r_p + sum     below 2: v; below 1: v / 2                                        1/2 U
//
// The last two errors cannot both be that large unless the shares cost less. sum >= 2 and
// r_p + sum >= 1, with sum <= 2/3 (2 − r_p), leave r_p = −1 only; then |r_j − r_p| < 3 and the
// shares cost 3/4 U. So the last four rows are 3 1/4 U together. Affine shares have no other error:
// 3 1/4 + 2/3 = 3 11/12.
//
// Smooth shares are f_i / f, where f_i is scale E_i rounded and f = (f_j + f_k) + f_p.
// - Sums: let f be between 1 and 2. If f_j + f_k < 1, the two sums cost v / 2 + v. Otherwise
//   f >= 3/2, and they cost v + v. Either way this is at most 3/2 v relative to f. r is off by X
//   times that: 3 m U.
// - The f_i: v Σ b_i |r_i − r|. This is convex in the r_i, so it is largest where the r_i are ±R.
//   Then it is 4 q (1 − q) R v, where q is the share of the vertices with r_i = R: at most
//   8 m (1 − m) v = 4 m (1 − m) U.
// With the differences this makes 4 m + 4 m (1 − m) <= 32/9; in all 3 1/4 + 32/9 = 6 29/36.
//
// Other errors. The E_i (affine: the shares) have a total error of 2^-32 of their sum. Two negative
// ones each add as much again when they are replaced by 0: 3 · 2^-32 · 2R = 3/128 U. Products of
// errors, and their effect on the limits of the cases above, are below 512 v² = 2^-16 U. Underflow:
// a product below 2^-126 has an error of 2^-150, at most the U / 2 granted above; sums do not
// underflow; a share's error is 2^-129, because Σ is at least 2^-20. Nothing above needs max|r_i|
// >= 1, so all of this also holds for subnormal r_i, with U = 2^-149. Together these give
// kFloatSmoothBound and kFloatAffineBound (rasterizer.h).
//
// Largest errors found: 6.197 smooth and 3.662 affine, by a search of some 10^9 samples; 10^7
// random samples reach 5.03 and 3.34.
//
// Exact results: constants (but −0 may become 0), and r_i where the other two weights are 0. No
// value leaves [min r_i, max r_i]: each step is at most half of the way from r_p to the farthest
// value on its side, and all steps together are at most about two thirds of that way.
//
// Rejected alternatives. (r_p + first) + second has a bound lower by half a U, but values that
// hardly change over a triangle would have two roundings of their own size instead of one.
// Σ r_i E_i / Σ E_i has a bound of 6 U, but misses constants. Dividing in double would give smooth
// values the bound of affine values, but only by using the first precision's arithmetic.

#include <array>

#include "rasterizer/internal/block_kernels.h"

namespace rastercheck::rasterizer {

/// The shares of a block's samples. Samples whose weights violate the functions' requirements get
/// arbitrary shares or NaN.
struct FloatWeights {
  /// [i][sample]: c_i, the factor of r_i+1 − r_i.
  alignas(64) std::array<std::array<float, kBlockSize>, 3> steps;
  /// The index of the pivot vertex: 0, 1 or 2.
  alignas(64) std::array<float, kBlockSize> pivot;
};

/// Computes the shares E_i / Σ E_i. `scale` must be a power of two with scale · E_i <= 2. At every
/// sample whose result is used, scale · Σ E_i must be >= 2^-20, Σ E_i at least 2^32 times the total
/// error of the E_i, and E_i >= −2^-32 Σ E_i. Does not use `reciprocal`.
void float_smooth_weights(const BlockWeights& weights, double scale, int count, FloatWeights& out);

/// Computes the shares factors_i · E_i; for noperspective, factors_i is w_i / (|det| T). At every
/// sample whose result is used, the shares must be at least −2^-32, and their total difference from
/// numbers whose sum is 1 must be at most 2^-32.
void float_affine_weights(const BlockWeights& weights, const std::array<double, 3>& factors,
                          int count, FloatWeights& out);

/// True if all |r_i| < 2^127, so that no difference overflows.
bool fits_float_precision(const std::array<float, 3>& r);

/// Sets out[j] to the value of sample j; `r` must satisfy fits_float_precision(). Writes whole
/// vectors: `out` must have room for kBlockSize numbers, of which the first `count` are meaningful.
void evaluate_float(const std::array<float, 3>& r, int count, const FloatWeights& weights,
                    float* out);

}  // namespace rastercheck::rasterizer
