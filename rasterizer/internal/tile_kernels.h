#pragma once

// What is done to a row of a tile at once, on the widest vectors that the processor has. All
// targets compute the same bits, and values those of block_kernels.h.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/internal/block_kernels.h"

namespace rastercheck::rasterizer {

/// out[count · i + k] = rows[k][i] for i below `width`, count = rows.size().
void interleave(std::span<const float* const> rows, std::size_t width, float* out);
/// rows[k][i] = in[count · i + k].
void separate(const float* in, std::span<float* const> rows, std::size_t width);

/// An attribute of a triangle.
struct ShadedValue {
  ValueKind kind = ValueKind::copied;
  std::array<double, 3> numerators{};
  float copy = 0;
};

/// A triangle whose values double holds, but for some samples (Certificates).
struct ShadedTriangle {
  std::array<double, 3> a{};
  std::array<double, 3> band{};
  /// What double knows of an edge: its sign beyond the band, or, where evaluating rounds nothing,
  /// all; then a sample with E_i = 0 is inside iff the edge is closed.
  enum class Edge { banded, open, closed };
  std::array<Edge, 3> edges{};
  double least_sum = 0;  ///< smooth values are certain where Σ E_i is above this
  bool has_smooth = false;
  double affine_scale = 0;  ///< 1 / (|det| T)
  bool has_constant_depth = false;
  float constant_depth = 0;
  DepthLine depth;
  std::span<const ShadedValue> attributes;
  bool tests_depth = false;  ///< keeps a fragment iff its depth is less; else always
};

/// A row of a tile.
struct TileRow {
  const double* u = nullptr;     ///< U of each column's samples (sample_frame.h)
  std::array<double, 3> edge{};  ///< b_i V + c_i T of the row
  int begin = 0;                 ///< the columns that may be drawn
  int end = 0;
  float* depth = nullptr;
  std::span<float* const> attributes;  ///< [attribute]
};

/// Draws the samples of the row that are surely inside and whose values are certain. Returns those
/// left out that may be inside, by column.
std::uint64_t shade_row(const ShadedTriangle& triangle, const TileRow& row);

}  // namespace rastercheck::rasterizer
