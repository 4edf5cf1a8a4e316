// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/interleave.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "rasterizer/internal/tile_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/interleave.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// Row y of each array.
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

/// Copies numbers. Writes of whole cache lines bypass the caches.
HWY_INLINE void StreamTo(float* out, const float* in, std::size_t count) {
  const Floats d;
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
  for (std::size_t y = 0; y < rows.height; ++y, out += kCount * rows.pitch) {
    const auto in = RowsAt<kCount>(rows, y);
    if (!rows.streams) {
      InterleaveRow<kCount>(in, rows.width, out);
      continue;
    }
    alignas(64) std::array<float, kCount * kTileSize> row;
    InterleaveRow<kCount>(in, rows.width, row.data());
    StreamTo(out, row.data(), kCount * rows.width);
  }
  // Other threads may read the output from now on.
  if (rows.streams) hwy::FlushStream();
}

template <std::size_t kCount>
void SeparateRows(const float* in, const TileRows& rows) {
  const Floats d;
  const std::size_t whole = rows.width - rows.width % hn::Lanes(d);
  for (std::size_t y = 0; y < rows.height; ++y, in += kCount * rows.pitch) {
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
        out[count * (rows.pitch * y + i) + k] = rows.arrays[k][kTileSize * y + i];
      }
    }
  }
}

/// Converts numbers to bytes. Each byte has its own word.
HWY_INLINE hn::Vec<HalfWords> BytesOf(const float* in) {
  const Doubles d;
  const auto one = hn::Set(d, 1.0);
  const auto value = hn::PromoteTo(d, hn::LoadU(Halves(), in));
  const auto positive = hn::IfThenElseZero(hn::Gt(value, hn::Zero(d)), value);
  const auto held = hn::IfThenElse(hn::Gt(positive, one), one, positive);
  // The product of a float and 255 is exact in double.
  const auto nearest = hn::Round(hn::Mul(held, hn::Set(d, 255.0)));
  return hn::BitCast(HalfWords(), hn::DemoteTo(Ints(), nearest));
}

/// Converts row y of one sample to words. The first channel is the lowest byte.
void RowsToWords(const TileRows& rows, std::size_t sample, std::size_t y, std::uint32_t* out) {
  const HalfWords words;
  std::array<const float*, 4> in{};
  for (std::size_t k = 0; k < 4; ++k) in[k] = rows.arrays[4 * sample + k] + y * kTileSize;
  for (std::size_t i = 0; i < rows.width; i += hn::Lanes(words)) {
    const auto low = hn::Or(BytesOf(in[0] + i), hn::ShiftLeft<8>(BytesOf(in[1] + i)));
    const auto high = hn::Or(BytesOf(in[2] + i), hn::ShiftLeft<8>(BytesOf(in[3] + i)));
    hn::StoreU(hn::Or(low, hn::ShiftLeft<16>(high)), words, out + i);
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
        rows.arrays[k][kTileSize * y + i] = in[count * (rows.pitch * y + i) + k];
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
HWY_EXPORT(RowsToWords);

void interleave(const TileRows& rows, float* out) { HWY_DYNAMIC_DISPATCH(Interleave)(rows, out); }

void separate(const float* in, const TileRows& rows) { HWY_DYNAMIC_DISPATCH(Separate)(in, rows); }

namespace {

/// Writes four bytes, lowest first in memory, whatever the processor's byte order.
void put_word(std::uint32_t word, std::uint8_t* out) {
  for (int k = 0; k < 4; ++k) out[k] = static_cast<std::uint8_t>(word >> 8 * k);
}
std::uint32_t word_at(const std::uint8_t* in) {
  std::uint32_t word = 0;
  for (int k = 0; k < 4; ++k) word |= std::uint32_t{in[k]} << 8 * k;
  return word;
}

/// The index of a sample's four bytes.
std::size_t place_of(const TileRows& rows, std::size_t samples, std::size_t sample, std::size_t y,
                     std::size_t x) {
  return 4 * (samples * (rows.pitch * y + x) + sample);
}

/// Calls visit(sample, y, x) for each word.
template <typename Visit>
void for_each_word(const TileRows& rows, std::size_t samples, const Visit& visit) {
  for (std::size_t s = 0; s < samples; ++s) {
    for (std::size_t y = 0; y < rows.height; ++y) {
      for (std::size_t x = 0; x < rows.width; ++x) visit(s, y, x);
    }
  }
}

}  // namespace

void interleave(const TileRows& rows, std::uint8_t* out) {
  const std::size_t samples = rows.arrays.size() / 4;
  std::array<std::uint32_t, kTileSize> row{};
  for (std::size_t s = 0; s < samples; ++s) {
    for (std::size_t y = 0; y < rows.height; ++y) {
      HWY_DYNAMIC_DISPATCH(RowsToWords)(rows, s, y, row.data());
      for (std::size_t x = 0; x < rows.width; ++x) {
        put_word(row[x], out + place_of(rows, samples, s, y, x));
      }
    }
  }
}

void separate(const std::uint8_t* in, const TileRows& rows) {
  const std::size_t samples = rows.arrays.size() / 4;
  for_each_word(rows, samples, [&](std::size_t s, std::size_t y, std::size_t x) {
    const std::uint8_t* const bytes = in + place_of(rows, samples, s, y, x);
    for (std::size_t k = 0; k < 4; ++k) {
      rows.arrays[4 * s + k][kTileSize * y + x] = static_cast<float>(bytes[k]) / 255;
    }
  });
}

void interleave_words(const TileRows& rows, std::uint8_t* out) {
  const std::size_t samples = rows.arrays.size();
  for_each_word(rows, samples, [&](std::size_t s, std::size_t y, std::size_t x) {
    put_word(std::bit_cast<std::uint32_t>(rows.arrays[s][kTileSize * y + x]),
             out + place_of(rows, samples, s, y, x));
  });
}

void separate_words(const std::uint8_t* in, const TileRows& rows) {
  const std::size_t samples = rows.arrays.size();
  for_each_word(rows, samples, [&](std::size_t s, std::size_t y, std::size_t x) {
    rows.arrays[s][kTileSize * y + x] =
        std::bit_cast<float>(word_at(in + place_of(rows, samples, s, y, x)));
  });
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
