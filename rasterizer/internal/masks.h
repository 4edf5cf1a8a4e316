#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Bit sets in a word: the samples of a block (bit j is pixel `first + j`), the rows of a tile, or
// lanes.

#include <algorithm>
#include <bit>
#include <cstdint>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/draw_bounds.h"

namespace rastercheck::rasterizer {

using Mask = std::uint64_t;

/// Calls `visit` with the index of every set bit, in ascending order.
template <typename Visit>
void for_each_bit(Mask mask, const Visit& visit) {
  for (; mask != 0; mask &= mask - 1) visit(std::countr_zero(mask));
}

/// Returns the bits j with begin <= first + j < end.
inline Mask columns_mask(const PixelRange& columns, int first) {
  const int begin = std::clamp(columns.begin - first, 0, kBlockSize);
  const int end = std::clamp(columns.end - first, 0, kBlockSize);
  if (begin >= end) return 0;
  const Mask below_end = end == kBlockSize ? ~Mask{0} : (Mask{1} << end) - 1;
  return below_end & ~((Mask{1} << begin) - 1);
}

}  // namespace rastercheck::rasterizer
