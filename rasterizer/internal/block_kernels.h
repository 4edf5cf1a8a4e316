#pragma once

// The arithmetic of up to 64 samples of a row at once, in double, on the widest vectors that the
// processor has. Every target computes the same bits: products and sums are rounded one by one and
// never fused.

#include <array>
#include <cstddef>
#include <cstdint>

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

/// Fills `reciprocal`, and tells which samples have Σ E_i > least.
std::uint64_t sum_weights(double least, int count, BlockWeights& weights);

/// out[j] = Σ r_i E_i / Σ E_i, rounded once to float32.
void evaluate_smooth(const std::array<double, 3>& r, int count, const BlockWeights& weights,
                     float* out);

/// out[j] = scale · Σ k_i E_i, rounded once.
void evaluate_affine(const std::array<double, 3>& k, double scale, int count,
                     const BlockWeights& weights, float* out);

/// How a value comes from the weights: not at all, as evaluate_smooth or as evaluate_affine has it.
enum class ValueKind { copied, smooth, affine };

/// Depth: low + span · (scale · Σ k_i E_i), clamped to [least, greatest] and rounded once.
struct DepthLine {
  std::array<double, 3> k{};
  double scale = 0;
  double low = 0;
  double span = 0;
  double least = 0;
  double greatest = 0;
};
void evaluate_depth(const DepthLine& line, int count, const BlockWeights& weights, float* out);

}  // namespace rastercheck::rasterizer
