#pragma once

// The arithmetic of up to 64 samples of a row at once, in double, on the widest vectors that the
// processor has. Every target computes the same bits: products and sums are rounded one by one and
// never fused.

#include <array>
#include <cstddef>
#include <cstdint>

#include "rasterizer/internal/plane.h"

namespace rastercheck::rasterizer {

inline constexpr int kBlockSize = 64;

/// A row of samples of three edge functions: E_i = a_i · scale · (2 (first + offset + j) − shift) +
/// row_i for sample j.
struct EdgeRow {
  std::array<double, 3> a{};
  std::array<double, 3> row{};
  std::array<double, 3> band{};
  double scale = 0;
  double shift = 0;
  double offset = 0;  ///< of the sample in its pixel
};

/// E_i and their sum for the samples of a block.
struct BlockWeights {
  alignas(64) std::array<double, kBlockSize> u;  ///< U (sample_frame.h)
  alignas(64) std::array<std::array<double, kBlockSize>, 3> e;
  alignas(64) std::array<double, kBlockSize> reciprocal;  ///< 1 / Σ E_i
};

/// Bit j of a mask is sample j.
struct BlockCoverage {
  std::uint64_t possible = 0;  ///< no E_i < −band_i
  std::uint64_t sure = 0;      ///< all E_i > band_i
};

/// Evaluates the edges for `count` samples from pixel `first`; arrays are filled in whole vectors.
BlockCoverage evaluate_edges(const EdgeRow& row, int first, int count, BlockWeights& weights);

/// Fills `reciprocal` from the row of Σ E_i, and tells which samples have more than `least`.
std::uint64_t sum_weights(const PlaneRow& sum, double least, int count, BlockWeights& weights);

/// out[j] = numerator / Σ E_i, rounded once to float32.
void evaluate_smooth(const PlaneRow& numerator, int count, const BlockWeights& weights, float* out);

/// out[j] = the plane's value, rounded once.
void evaluate_affine(const PlaneRow& plane, int count, const BlockWeights& weights, float* out);

/// The same held to [least, greatest] before it is rounded.
void evaluate_depth(const PlaneRow& plane, double least, double greatest, int count,
                    const BlockWeights& weights, float* out);

// The same by the same operations, but for the last one: not rounded to float32.
void evaluate_smooth(const PlaneRow& numerator, int count, const BlockWeights& weights,
                     double* out);
void evaluate_affine(const PlaneRow& plane, int count, const BlockWeights& weights, double* out);
void evaluate_depth(const PlaneRow& plane, double least, double greatest, int count,
                    const BlockWeights& weights, double* out);

}  // namespace rastercheck::rasterizer
