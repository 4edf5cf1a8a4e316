#pragma once

// Attributes in float32, the rasterizer's second precision (RULES §6), for the samples of a block.
//
//   r = r_p + Σ_i c_i (r_i+1 − r_i),     p the vertex of the largest share (the *pivot*),
//   c_p = b_p+1,  c_p+2 = −b_p+2,  c_p+1 = 0,     b_i the shares, indices modulo 3.
//
// That is r_p + (r_j − r_p) b_j + (r_k − r_p) b_k, j and k the other two, written so that all lanes
// use the same three differences: 0 times one of them is added without rounding. The shares are
// E_i / Σ E_i (smooth) or factor_i E_i (affine); negative ones, which only errors of the E_i can
// make, count as 0. Every target computes the same bits: nothing is fused.
//
// Bound. Let v = 2^-24 and U = 1 scale ULP, and take lengths so that U = 2 v and all |r_i| < R = 2.
// Rounding x costs at most v 2^floor(log2 |x|). The pivot's share is the largest, so
// m = b_j + b_k <= 2/3, and b_j, b_k <= 1/2 also as computed. With X = r − r_p, |X| <= 4 m.
//
//   differences   |r_j − r_p| < 4: 2 v, times the share                               m U
//   shares        below 1/2: v / 4, times less than 4, for both                       1 U
//   products      (r_j − r_p) b_j < 2: v, for both                                    1 U
//   their sum     below 4: 2 v; below 2: v                                            1 U
//   r_p + sum     below 2: v; below 1: v / 2                                        1/2 U
//
// The last two are not both so large, unless the shares cost less: sum >= 2 and r_p + sum >= 1,
// with sum <= 2/3 (2 − r_p), leave r_p = −1 only; then |r_j − r_p| < 3 and the shares cost 3/4 U.
// So the last four are 3 1/4 U together. Affine shares have no other error: 3 1/4 + 2/3 = 3 11/12.
//
// Smooth shares are quotients of f_i = scale E_i, rounded, by f = (f_j + f_k) + f_p.
// - Sums: let f be between 1 and 2. Either f_j + f_k < 1 and they cost v / 2 + v, or it is not and
//   f >= 3/2, and they cost v + v; 3/2 v relative to f each time. r is off by X times that: 3 m U.
// - The f_i: v Σ b_i |r_i − r|. That is convex in the r_i, hence largest where they are ±R: then it
//   is 4 q (1 − q) R v, q the share of those that are R, at most 8 m (1 − m) v = 4 m (1 − m) U.
// With the differences that is 4 m + 4 m (1 − m) <= 32/9, in all 3 1/4 + 32/9 = 6 29/36.
//
// Besides. The E_i (affine: the shares) are off by 2^-32 of their sum together, and two negative
// ones by as much each when taken for 0: 3 · 2^-32 · 2R = 3/128 U. Products of errors, and what
// they move the limits of the cases above, are below 512 v² = 2^-16 U. Underflow: a product below
// 2^-126 is off by 2^-150, at most the U / 2 granted above; sums do not underflow; in a share, Σ
// being 2^-20 at least, it is 2^-129. R >= 1 was used nowhere, so all of this holds for subnormal
// r_i, U = 2^-149, too. Together: kFloatSmoothBound and kFloatAffineBound (rasterizer.h).
//
// Attained: 6.197 smooth, 3.662 affine, by a search of some 10^9 samples; random ones reach 5.03
// and 3.34 in 10^7.
//
// Exact: constants (−0 may come out as 0), and r_i where the other two weights are 0. No value
// leaves [min r_i, max r_i]: each step is at most half, and all are at most some two thirds, of the
// way from r_p to the farthest value on their side.
//
// Rejected: (r_p + first) + second, which is bounded by half a U less: values that hardly change
// over a triangle would have two roundings of their own size where this has one. Σ r_i E_i / Σ E_i:
// bounded by 6 U, but it misses constants. Dividing in double: smooth values would be bounded as
// the affine ones are, but by the first precision's arithmetic.

#include <array>

#include "rasterizer/internal/block_kernels.h"

namespace rastercheck::rasterizer {

/// The shares of the samples of a block. Of samples whose weights are not what the functions ask
/// for they are some numbers or NaN.
struct FloatWeights {
  /// [i][sample]: c_i, how much of r_i+1 − r_i is added.
  alignas(64) std::array<std::array<float, kBlockSize>, 3> steps;
  /// Which vertex the pivot is: 0, 1 or 2.
  alignas(64) std::array<float, kBlockSize> pivot;
};

/// Shares E_i / Σ E_i. `scale` is a power of two with scale · E_i <= 2; for samples that count,
/// scale · Σ E_i >= 2^-20, Σ E_i is at least 2^32 times what the E_i are off by together, and
/// E_i >= −2^-32 Σ E_i. `reciprocal` is not used.
void float_smooth_weights(const BlockWeights& weights, double scale, int count, FloatWeights& out);

/// Shares factors_i · E_i: w_i / (|det| T) for noperspective. For samples that count they are at
/// least −2^-32, and off by at most 2^-32 together from numbers whose sum is 1.
void float_affine_weights(const BlockWeights& weights, const std::array<double, 3>& factors,
                          int count, FloatWeights& out);

/// Whether nothing overflows: all |r_i| < 2^127, so that differences are finite.
bool fits_float_precision(const std::array<float, 3>& r);

/// out[j] is the value of sample j; `r` fits. Written in whole vectors: `out` has kBlockSize
/// places, of which the first `count` mean something.
void evaluate_float(const std::array<float, 3>& r, int count, const FloatWeights& weights,
                    float* out);

}  // namespace rastercheck::rasterizer
