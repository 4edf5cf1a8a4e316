// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/color_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/color_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

using Integers = hn::RebindToSigned<Floats>;
using Texels = hn::RebindToUnsigned<Floats>;
using Color = hn::Vec<Floats>;

/// The lanes from `lane` on that are in a mask.
HWY_INLINE hn::Mask<Integers> LanesOf(const LaneMask& lanes, std::size_t lane) {
  return MaskOf(Integers(), lanes[lane / 64] >> lane % 64);
}

/// A channel of texels, in units of 1/255.
template <int kChannel>
HWY_INLINE Color ChannelOf(hn::Vec<Texels> texels) {
  const Texels unsigned_tag;
  auto bytes = kChannel == 0 ? texels : hn::ShiftRight<8 * kChannel>(texels);
  if (kChannel != 3) bytes = hn::And(bytes, hn::Set(unsigned_tag, 255));
  return hn::ConvertTo(Floats(), hn::BitCast(Integers(), bytes));
}

/// value / 255 (fetch_texels).
HWY_INLINE Color Scaled(Color value) {
  const Floats d;
  const auto q = hn::Mul(value, hn::Set(d, 0x1.01p-8F));
  return hn::Add(q, hn::Mul(q, hn::Set(d, 0x1.0001p-16F)));
}

HWY_INLINE Color Between(Color a, Color b, Color fraction) {
  return hn::Add(a, hn::Mul(fraction, hn::Sub(b, a)));
}

template <int kChannel>
HWY_INLINE void StoreChannel(hn::Vec<Texels> texels, std::size_t lane, ColorArrays color) {
  hn::Store(Scaled(ChannelOf<kChannel>(texels)), Floats(), color[kChannel] + lane);
}

/// Prefetches all texels before the first is used, because memory is slow. Prefetches only one
/// texel per two lanes: neighbouring lanes' texels are mostly in the same cache line.
HWY_INLINE void FetchAhead(const std::uint32_t* texels, const LaneArray<std::int32_t>& at,
                           std::size_t lanes) {
  for (std::size_t i = 0; i < lanes; i += 2) hwy::Prefetch(texels + at[i]);
}

void FetchTexels(const TexelLevels& texture, const std::int32_t* columns, const std::int32_t* rows,
                 const LaneMask& wanted, std::size_t lanes, ColorArrays color) {
  const Integers integers;
  const auto width = hn::Set(integers, texture.width);
  alignas(64) LaneArray<std::int32_t> at;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(integers)) {
    const auto row = hn::Mul(hn::Load(integers, rows + i), width);
    const auto place = hn::Add(hn::Load(integers, columns + i), row);
    hn::Store(hn::IfThenElseZero(LanesOf(wanted, i), place), integers, at.data() + i);
  }
  FetchAhead(texture.texels, at, lanes);
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(integers)) {
    const auto texel = hn::GatherIndex(Texels(), texture.texels, hn::Load(integers, at.data() + i));
    StoreChannel<0>(texel, i, color);
    StoreChannel<1>(texel, i, color);
    StoreChannel<2>(texel, i, color);
    StoreChannel<3>(texel, i, color);
  }
}

/// The texels on either side of the lanes' coordinates.
struct Sides {
  hn::Vec<Integers> low;
  hn::Vec<Integers> high;
};

HWY_INLINE Sides SidesAt(const Neighbors& neighbors, std::size_t lane, hn::Vec<Integers> size,
                         bool repeats) {
  const Integers d;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1);
  const auto last = hn::Sub(size, one);
  const auto low = hn::Load(d, neighbors.low.data() + lane);
  const auto high = hn::Add(low, one);
  const auto before = repeats ? last : zero;
  const auto after = repeats ? zero : last;
  return {hn::IfThenElse(hn::Lt(low, zero), before, low),
          hn::IfThenElse(hn::Gt(high, last), after, high)};
}

/// Pairs of adjacent texels, as vectors.
struct TexelPairs {
  hn::Vec<Texels> left;
  hn::Vec<Texels> right;
};

#if HWY_TARGET <= HWY_AVX2
/// The texels at `at` and `at` + 1, fetched together.
HWY_INLINE TexelPairs AdjacentPairs(const std::uint32_t* texels, hn::Vec<Integers> at) {
  const Texels tag;
  const hn::Repartition<std::int64_t, Integers> offsets;
  const hn::Repartition<std::uint64_t, Texels> pairs;
  const hn::Half<Integers> half;
  const auto* base = reinterpret_cast<const std::uint64_t*>(texels);
  const auto low = hn::ShiftLeft<2>(hn::PromoteTo(offsets, hn::LowerHalf(half, at)));
  const auto high = hn::ShiftLeft<2>(hn::PromoteTo(offsets, hn::UpperHalf(half, at)));
  const auto first = hn::BitCast(tag, hn::GatherOffset(pairs, base, low));
  const auto second = hn::BitCast(tag, hn::GatherOffset(pairs, base, high));
  return {hn::ConcatEven(tag, second, first), hn::ConcatOdd(tag, second, first)};
}
#endif

/// A vector of squares: the four texels of each, and the sample's position between the texels.
struct SquareTexels {
  TexelPairs low;
  TexelPairs high;
  Color along_row;
  Color along_column;
};

/// The mip levels of a vector of lanes: sizes, and the indices of the first texels.
struct LevelLanes {
  hn::Vec<Integers> width;
  hn::Vec<Integers> height;
  hn::Vec<Integers> first;
};

/// Indices of the squares' texels: the left texel of either row, and the step from the left texels
/// to the right ones.
struct SquarePlaces {
  alignas(64) LaneArray<std::int32_t> low;
  alignas(64) LaneArray<std::int32_t> high;
  alignas(64) LaneArray<std::int32_t> step;
};

HWY_INLINE void PutPlaces(const TexelLevels& texture, const LevelLanes& level,
                          const Squares& squares, const LaneMask& wanted, std::size_t lane,
                          SquarePlaces& places) {
  const Integers d;
  const Sides columns = SidesAt(squares.columns, lane, level.width, texture.repeats_columns);
  const Sides rows = SidesAt(squares.rows, lane, level.height, texture.repeats_rows);
  const auto low = hn::Add(hn::Mul(rows.low, level.width), level.first);
  const auto high = hn::Add(hn::Mul(rows.high, level.width), level.first);
  const auto is_wanted = LanesOf(wanted, lane);
  const auto put = [&](hn::Vec<Integers> place, LaneArray<std::int32_t>& out) HWY_ATTR {
    hn::Store(hn::IfThenElseZero(is_wanted, place), d, out.data() + lane);
  };
  put(hn::Add(low, columns.low), places.low);
  put(hn::Add(high, columns.low), places.high);
  // Unwanted lanes read the first texel and, if the texture has another texel, the texel after it.
  const auto of_unwanted = hn::Set(d, texture.width > 1 || texture.height > 1 ? 1 : 0);
  const auto step = hn::Sub(columns.high, columns.low);
  hn::Store(hn::IfThenElse(is_wanted, step, of_unwanted), d, places.step.data() + lane);
}

HWY_INLINE void FetchAhead(const std::uint32_t* texels, const SquarePlaces& places,
                           std::size_t lanes) {
  FetchAhead(texels, places.low, lanes);
  FetchAhead(texels, places.high, lanes);
}

HWY_INLINE SquareTexels SquareAt(const std::uint32_t* texels, const SquarePlaces& places,
                                 const Squares& squares, std::size_t lane) {
  const Floats floats;
  const Integers integers;
  const Texels tag;
  const auto low = hn::Load(integers, places.low.data() + lane);
  const auto high = hn::Load(integers, places.high.data() + lane);
  const auto step = hn::Load(integers, places.step.data() + lane);
  SquareTexels square;
  square.along_row = hn::Load(floats, squares.columns.fraction.data() + lane);
  square.along_column = hn::Load(floats, squares.rows.fraction.data() + lane);
#if HWY_TARGET <= HWY_AVX2
  // Halves the number of fetches, unless a square is on an edge.
  if (hn::AllTrue(integers, hn::Eq(step, hn::Set(integers, 1)))) {
    square.low = AdjacentPairs(texels, low);
    square.high = AdjacentPairs(texels, high);
    return square;
  }
#endif
  square.low = {hn::GatherIndex(tag, texels, low),
                hn::GatherIndex(tag, texels, hn::Add(low, step))};
  square.high = {hn::GatherIndex(tag, texels, high),
                 hn::GatherIndex(tag, texels, hn::Add(high, step))};
  return square;
}

template <int kChannel>
HWY_INLINE Color Bilinear(const SquareTexels& square) {
  const auto low = Between(ChannelOf<kChannel>(square.low.left),
                           ChannelOf<kChannel>(square.low.right), square.along_row);
  const auto high = Between(ChannelOf<kChannel>(square.high.left),
                            ChannelOf<kChannel>(square.high.right), square.along_row);
  return Between(low, high, square.along_column);
}

template <int kChannel>
HWY_INLINE void StoreBilinear(const SquareTexels& square, std::size_t lane, ColorArrays color) {
  hn::Store(Scaled(Bilinear<kChannel>(square)), Floats(), color[kChannel] + lane);
}

void FilterBilinear(const TexelLevels& texture, const Squares& squares, const LaneMask& wanted,
                    std::size_t lanes, ColorArrays color) {
  const Integers integers;
  const LevelLanes level{hn::Set(integers, texture.width), hn::Set(integers, texture.height),
                         hn::Zero(integers)};
  SquarePlaces places;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(integers)) {
    PutPlaces(texture, level, squares, wanted, i, places);
  }
  FetchAhead(texture.texels, places, lanes);
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(integers)) {
    const SquareTexels square = SquareAt(texture.texels, places, squares, i);
    StoreBilinear<0>(square, i, color);
    StoreBilinear<1>(square, i, color);
    StoreBilinear<2>(square, i, color);
    StoreBilinear<3>(square, i, color);
  }
}

template <int kChannel>
HWY_INLINE void StoreTrilinear(const SquareTexels& here, const SquareTexels& next, Color fraction,
                               std::size_t lane, ColorArrays color) {
  const auto value = Between(Bilinear<kChannel>(here), Bilinear<kChannel>(next), fraction);
  hn::Store(Scaled(value), Floats(), color[kChannel] + lane);
}

HWY_INLINE LevelLanes LevelsAt(const TexelLevels& texture, hn::Vec<Integers> level,
                               const std::array<std::int32_t, kLevelSlots>& first,
                               hn::Vec<Integers> shift) {
  const Integers d;
  const auto one = hn::Set(d, 1);
  return {hn::Max(hn::Shr(hn::Set(d, texture.width), shift), one),
          hn::Max(hn::Shr(hn::Set(d, texture.height), shift), one),
          hn::GatherIndex(d, first.data(), level)};
}

void FilterTrilinear(const TexelLevels& texture, const LevelsOfDetail& levels,
                     const std::array<Squares, 2>& squares, const LaneMask& wanted,
                     std::size_t lanes, ColorArrays color) {
  const Integers integers;
  std::array<SquarePlaces, 2> places;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(integers)) {
    const auto level = hn::Load(integers, levels.level.data() + i);
    const auto after = hn::Add(level, hn::Set(integers, 1));
    const LevelLanes near = LevelsAt(texture, level, texture.first, level);
    const LevelLanes far = LevelsAt(texture, level, texture.next, after);
    PutPlaces(texture, near, squares[0], wanted, i, places[0]);
    PutPlaces(texture, far, squares[1], wanted, i, places[1]);
  }
  for (const SquarePlaces& of_level : places) FetchAhead(texture.texels, of_level, lanes);
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(integers)) {
    const SquareTexels here = SquareAt(texture.texels, places[0], squares[0], i);
    const SquareTexels next = SquareAt(texture.texels, places[1], squares[1], i);
    const auto fraction = hn::Load(Floats(), levels.fraction.data() + i);
    StoreTrilinear<0>(here, next, fraction, i, color);
    StoreTrilinear<1>(here, next, fraction, i, color);
    StoreTrilinear<2>(here, next, fraction, i, color);
    StoreTrilinear<3>(here, next, fraction, i, color);
  }
}

void RoundLanes(const double* in, std::size_t lanes, float* out) {
  const Doubles d;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    hn::Store(RoundToFloats(hn::Load(d, in + i)), Halves(), out + i);
  }
}

LaneMask FindBelow(const float* values, float limit, std::size_t lanes) {
  const Floats d;
  LaneMask below{};
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    below[i / 64] |= BitsOf(d, hn::Lt(hn::Load(d, values + i), hn::Set(d, limit))) << i % 64;
  }
  return below;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(FetchTexels);
HWY_EXPORT(FilterBilinear);
HWY_EXPORT(FilterTrilinear);
HWY_EXPORT(RoundLanes);
HWY_EXPORT(FindBelow);

void fetch_texels(const TexelLevels& texture, const std::int32_t* columns, const std::int32_t* rows,
                  const LaneMask& wanted, std::size_t lanes, ColorArrays color) {
  HWY_DYNAMIC_DISPATCH(FetchTexels)(texture, columns, rows, wanted, lanes, color);
}

void filter_bilinear(const TexelLevels& texture, const Squares& squares, const LaneMask& wanted,
                     std::size_t lanes, ColorArrays color) {
  HWY_DYNAMIC_DISPATCH(FilterBilinear)(texture, squares, wanted, lanes, color);
}

void filter_trilinear(const TexelLevels& texture, const LevelsOfDetail& levels,
                      const std::array<Squares, 2>& squares, const LaneMask& wanted,
                      std::size_t lanes, ColorArrays color) {
  HWY_DYNAMIC_DISPATCH(FilterTrilinear)(texture, levels, squares, wanted, lanes, color);
}

void round_lanes(const double* in, std::size_t lanes, float* out) {
  HWY_DYNAMIC_DISPATCH(RoundLanes)(in, lanes, out);
}

LaneMask find_below(const float* values, float limit, std::size_t lanes) {
  return HWY_DYNAMIC_DISPATCH(FindBelow)(values, limit, lanes);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
