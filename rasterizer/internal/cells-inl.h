// Serves the route “shaded frames” (docs/rasterizer.md, Routes).
//
// Lanes of cells, and their depth tests. Included once per SIMD target, as Highway requires.

#include <cstddef>
#include <cstdint>

#if defined(RASTERCHECK_CELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_CELLS_INL_H_
#undef RASTERCHECK_CELLS_INL_H_
#else
#define RASTERCHECK_CELLS_INL_H_
#endif

#include <hwy/highway.h>

#include "rasterizer/internal/tile_kernels.h"
#include "rasterizer/internal/vectors-inl.h"
#include "rasterizer/shading.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

constexpr std::size_t kWidth = FragmentBatch::kCellWidth;

/// Lanes whose fragment of depth `depth` passes the test against `old`.
template <class D>
HWY_INLINE hn::Mask<D> Passes(D d, DepthTest test, hn::Vec<D> depth, hn::Vec<D> old) {
  switch (test) {
    case DepthTest::never:
      return hn::FirstN(d, 0);
    case DepthTest::less:
      return hn::Lt(depth, old);
    case DepthTest::equal:
      return hn::Eq(depth, old);
    case DepthTest::less_or_equal:
      return hn::Le(depth, old);
    case DepthTest::greater:
      return hn::Gt(depth, old);
    case DepthTest::not_equal:
      return hn::Ne(depth, old);
    case DepthTest::greater_or_equal:
      return hn::Ge(depth, old);
    case DepthTest::always:
      break;
  }
  return hn::FirstN(d, hn::Lanes(d));
}

/// The lanes of a cell, from `lane` on, whose bits are set.
template <class D>
HWY_INLINE hn::Mask<D> LanesOf(D d, std::uint16_t bits, std::size_t lane) {
  return MaskOf(d, std::uint64_t{bits} >> lane);
}

/// The index of a cell's lane in a tile's arrays.
HWY_INLINE std::size_t PlaceOf(std::size_t column, std::size_t row, std::size_t lane) {
  return (row + lane / kWidth) * kTileSize + column + lane % kWidth;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#endif  // RASTERCHECK_CELLS_INL_H_
