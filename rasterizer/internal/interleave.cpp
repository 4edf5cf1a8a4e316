// Compiled once for each SIMD target; the best that the processor has is chosen at run time.

#include "rasterizer/internal/interleave.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/interleave.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;

/// The arrays' rows of that number.
template <std::size_t kCount>
std::array<float*, kCount> RowsAt(const TileRows& rows, std::size_t y) {
  std::array<float*, kCount> at{};
  for (std::size_t k = 0; k < kCount; ++k) at[k] = rows.arrays[k] + y * kTileSize;
  return at;
}

template <std::size_t kCount>
HWY_INLINE void InterleaveRow(const std::array<float*, kCount>& in, std::size_t width, float* out) {
  const Floats d;
  const std::size_t whole = width - width % hn::Lanes(d);
  std::size_t i = 0;
  for (; i < whole; i += hn::Lanes(d)) {
    if constexpr (kCount == 1) hn::StoreU(hn::LoadU(d, in[0] + i), d, out + i);
    if constexpr (kCount == 2) {
      hn::StoreInterleaved2(hn::LoadU(d, in[0] + i), hn::LoadU(d, in[1] + i), d, out + 2 * i);
    }
    if constexpr (kCount == 4) {
      hn::StoreInterleaved4(hn::LoadU(d, in[0] + i), hn::LoadU(d, in[1] + i),
                            hn::LoadU(d, in[2] + i), hn::LoadU(d, in[3] + i), d, out + 4 * i);
    }
  }
  for (; i < width; ++i) {
    for (std::size_t k = 0; k < kCount; ++k) out[kCount * i + k] = in[k][i];
  }
}

/// Copies numbers, whole cache lines past the caches.
HWY_INLINE void StreamTo(float* out, const float* in, std::size_t count) {
  const hn::CappedTag<float, 16> d;
  constexpr std::size_t kLine = 64 / sizeof(float);
  const std::size_t beyond = reinterpret_cast<std::uintptr_t>(out) / sizeof(float) % kLine;
  const std::size_t first = std::min((kLine - beyond) % kLine, count);
  const std::size_t end = first + (count - first) / kLine * kLine;
  std::copy_n(in, first, out);
  for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
    hn::Stream(hn::LoadU(d, in + i), d, out + i);
  }
  std::copy_n(in + end, count - end, out + end);
}

template <std::size_t kCount>
void InterleaveRows(const TileRows& rows, float* out) {
  for (std::size_t y = 0; y < rows.height; ++y, out += rows.pitch) {
    const auto in = RowsAt<kCount>(rows, y);
    if (!rows.streams) {
      InterleaveRow<kCount>(in, rows.width, out);
      continue;
    }
    alignas(64) std::array<float, kCount * kTileSize> row;
    InterleaveRow<kCount>(in, rows.width, row.data());
    StreamTo(out, row.data(), kCount * rows.width);
  }
  // Others may read it from now on.
  if (rows.streams) hwy::FlushStream();
}

template <std::size_t kCount>
void SeparateRows(const float* in, const TileRows& rows) {
  const Floats d;
  const std::size_t whole = rows.width - rows.width % hn::Lanes(d);
  for (std::size_t y = 0; y < rows.height; ++y, in += rows.pitch) {
    const auto out = RowsAt<kCount>(rows, y);
    std::size_t i = 0;
    for (; i < whole; i += hn::Lanes(d)) {
      std::array<hn::Vec<Floats>, 4> v;
      if constexpr (kCount == 1) v[0] = hn::LoadU(d, in + i);
      if constexpr (kCount == 2) hn::LoadInterleaved2(d, in + 2 * i, v[0], v[1]);
      if constexpr (kCount == 4) hn::LoadInterleaved4(d, in + 4 * i, v[0], v[1], v[2], v[3]);
      for (std::size_t k = 0; k < kCount; ++k) hn::StoreU(v[k], d, out[k] + i);
    }
    for (; i < rows.width; ++i) {
      for (std::size_t k = 0; k < kCount; ++k) out[k][i] = in[kCount * i + k];
    }
  }
}

void Interleave(const TileRows& rows, float* out) {
  const std::size_t count = rows.arrays.size();
  if (count == 1) return InterleaveRows<1>(rows, out);
  if (count == 2) return InterleaveRows<2>(rows, out);
  if (count == 4) return InterleaveRows<4>(rows, out);
  for (std::size_t y = 0; y < rows.height; ++y) {
    for (std::size_t i = 0; i < rows.width; ++i) {
      for (std::size_t k = 0; k < count; ++k) {
        out[rows.pitch * y + count * i + k] = rows.arrays[k][kTileSize * y + i];
      }
    }
  }
}

void Separate(const float* in, const TileRows& rows) {
  const std::size_t count = rows.arrays.size();
  if (count == 1) return SeparateRows<1>(in, rows);
  if (count == 2) return SeparateRows<2>(in, rows);
  if (count == 4) return SeparateRows<4>(in, rows);
  for (std::size_t y = 0; y < rows.height; ++y) {
    for (std::size_t i = 0; i < rows.width; ++i) {
      for (std::size_t k = 0; k < count; ++k) {
        rows.arrays[k][kTileSize * y + i] = in[rows.pitch * y + count * i + k];
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(Interleave);
HWY_EXPORT(Separate);

void interleave(const TileRows& rows, float* out) { HWY_DYNAMIC_DISPATCH(Interleave)(rows, out); }

void separate(const float* in, const TileRows& rows) { HWY_DYNAMIC_DISPATCH(Separate)(in, rows); }

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
