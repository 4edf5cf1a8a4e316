#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Evaluates up to 64 samples of a row at once, in double, on the processor's widest vectors. Every
// target computes the same bits: each product and each sum is rounded separately and never fused.

#include <array>
#include <cstddef>
#include <cstdint>

#include "rasterizer/internal/plane.h"

namespace rastercheck::rasterizer {

inline constexpr int kBlockSize = 64;

/// Three edge functions on a row of samples. For sample j:
///   E_i = a_i · scale · (2 (first + offset + j) − shift) + row_i.
struct EdgeRow {
  std::array<double, 3> a{};
  std::array<double, 3> row{};
  std::array<double, 3> band{};
  double scale = 0;
  double shift = 0;
  double offset = 0;  ///< position of the sample in its pixel
};

/// E_i and their sum for the samples of a block.
struct BlockWeights {
  alignas(64) std::array<double, kBlockSize> u;  ///< U (sample_frame.h)
  alignas(64) std::array<std::array<double, kBlockSize>, 3> e;
  alignas(64) std::array<double, kBlockSize> reciprocal;  ///< 1 / Σ E_i
};

/// Sample masks: bit j stands for sample j.
struct BlockCoverage {
  std::uint64_t possible = 0;  ///< no E_i < −band_i
  std::uint64_t sure = 0;      ///< all E_i > band_i
};

/// Evaluates the edges for `count` samples, starting at pixel `first`; fills the arrays in whole
/// vectors.
BlockCoverage evaluate_edges(const EdgeRow& row, int first, int count, BlockWeights& weights);

/// Fills `reciprocal` from the row of Σ E_i. Returns the samples whose sum exceeds `least`.
std::uint64_t sum_weights(const PlaneRow& sum, double least, int count, BlockWeights& weights);

/// out[j] = numerator / Σ E_i, rounded once to float32.
void evaluate_smooth(const PlaneRow& numerator, int count, const BlockWeights& weights, float* out);

/// out[j] = the plane's value, rounded once to float32.
void evaluate_affine(const PlaneRow& plane, int count, const BlockWeights& weights, float* out);

/// out[j] = the plane's value clamped to [least, greatest], then stored (depth_store.h).
void evaluate_depth(const PlaneRow& plane, double least, double greatest, double steps, int count,
                    const BlockWeights& weights, float* out);

// The same functions with the same operations, but before values are rounded or stored.
void evaluate_smooth(const PlaneRow& numerator, int count, const BlockWeights& weights,
                     double* out);
void evaluate_affine(const PlaneRow& plane, int count, const BlockWeights& weights, double* out);
void evaluate_depth(const PlaneRow& plane, double least, double greatest, int count,
                    const BlockWeights& weights, double* out);

}  // namespace rastercheck::rasterizer
