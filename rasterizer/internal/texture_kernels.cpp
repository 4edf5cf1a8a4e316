// Compiled once for each SIMD target; the best that the processor has is chosen at run time.

#include "rasterizer/internal/texture_kernels.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/texture_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Lanes come in sixteens: whole vectors of either kind.
using Floats = hn::CappedTag<float, 16>;
using Integers = hn::RebindToSigned<Floats>;
using Texels = hn::RebindToUnsigned<Floats>;
using Doubles = hn::CappedTag<double, 8>;
using DoubleBits = hn::RebindToUnsigned<Doubles>;
using HalfFloats = hn::Rebind<float, Doubles>;
using HalfIntegers = hn::Rebind<std::int32_t, Doubles>;
using Vector = hn::Vec<Doubles>;
using Color = hn::Vec<Floats>;

template <class D>
HWY_INLINE void AddBits(D d, hn::Mask<D> mask, std::size_t lane, LaneMask& lanes) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  const std::uint64_t bits = bytes[0] | static_cast<std::uint64_t>(bytes[1]) << 8;
  lanes[lane / 64] |= bits << lane % 64;
}

/// Which lanes from `lane` on are in a mask.
HWY_INLINE hn::Mask<Integers> LanesOf(const LaneMask& lanes, std::size_t lane) {
  const std::uint64_t bits = lanes[lane / 64] >> lane % 64;
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  bytes[0] = static_cast<std::uint8_t>(bits);
  bytes[1] = static_cast<std::uint8_t>(bits >> 8);
  return hn::LoadMaskBits(Integers(), bytes.data());
}

/// In [0, 1], whatever s is.
template <Wrap kWrap>
HWY_INLINE Vector Wrapped(Vector s) {
  const Doubles d;
  const auto one = hn::Set(d, 1.0);
  auto c = s;
  if (kWrap == Wrap::repeat) c = hn::Sub(s, hn::Floor(s));
  if (kWrap == Wrap::mirror) {
    const auto two = hn::Set(d, 2.0);
    const auto m = hn::Sub(s, hn::Mul(two, hn::Floor(hn::Mul(s, hn::Set(d, 0.5)))));
    c = hn::IfThenElse(hn::Lt(m, one), m, hn::Sub(two, m));
  }
  c = hn::IfThenElseZero(hn::Gt(c, hn::Zero(d)), c);
  return kWrap == Wrap::clamp ? hn::Min(c, one) : c;
}

/// What c · size may be off by (find_texels).
HWY_INLINE Vector MarginOf(Vector s, double error, double size) {
  const Doubles d;
  const auto own = hn::Mul(hn::Abs(s), hn::Set(d, FragmentBatch::kErrorShare));
  const auto e = hn::Max(own, hn::Set(d, error));
  return hn::Mul(hn::Add(e, hn::Set(d, 0x1p-51)), hn::Set(d, size));
}

template <Wrap kWrap>
HWY_INLINE LaneMask FindTexelsAlong(const TextureAxis& axis, double error, std::size_t lanes,
                                    std::int32_t* at) {
  const Doubles d;
  const HalfIntegers integers;
  const double texels = axis.size;
  const double infinity = std::numeric_limits<double>::infinity();
  const double most = error < infinity ? error : infinity;  // it may be no number
  const auto quarter = hn::Set(d, 0.25);
  const auto one = hn::Set(d, 1.0);
  const auto size = hn::Set(d, texels);
  const auto before_last = hn::Set(d, texels - 1);
  const auto last = hn::Set(integers, axis.size - 1);
  LaneMask open{};
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    const auto s = hn::Load(d, axis.values + i);
    const auto p = hn::Mul(Wrapped<kWrap>(s), size);
    // Towards 0, which is down.
    hn::Store(hn::Min(hn::DemoteTo(integers, p), last), integers, at + i);
    if (axis.size == 1) continue;
    const auto margin = MarginOf(s, most, texels);
    const auto nearest = hn::Round(p);
    auto is_certain = hn::Gt(hn::Abs(hn::Sub(p, nearest)), margin);
    if (kWrap != Wrap::repeat) {
      const auto is_edge = hn::Or(hn::Lt(nearest, one), hn::Gt(nearest, before_last));
      is_certain = hn::Or(is_certain, is_edge);
    }
    // What is no number is not certain.
    is_certain = hn::And(is_certain, hn::Lt(margin, quarter));
    if (!hn::AllTrue(d, is_certain)) AddBits(d, hn::Not(is_certain), i, open);
  }
  return open;
}

LaneMask FindTexels(const TextureAxis& axis, double error, std::size_t lanes, std::int32_t* at) {
  switch (axis.wrap) {
    case Wrap::repeat:
      return FindTexelsAlong<Wrap::repeat>(axis, error, lanes, at);
    case Wrap::clamp:
      return FindTexelsAlong<Wrap::clamp>(axis, error, lanes, at);
    case Wrap::mirror:
      break;
  }
  return FindTexelsAlong<Wrap::mirror>(axis, error, lanes, at);
}

/// Sizes of levels: the same for all lanes, or each its own.
class SameSize {
 public:
  HWY_INLINE explicit SameSize(double size) : size_(size) {}
  HWY_INLINE Vector At(std::size_t /*lane*/) const { return hn::Set(Doubles(), size_); }

 private:
  const double size_;
};
class OwnSizes {
 public:
  HWY_INLINE OwnSizes(double size, const double* shrink) : size_(size), shrink_(shrink) {}
  HWY_INLINE Vector At(std::size_t lane) const {
    const Doubles d;
    const auto size = hn::Mul(hn::Set(d, size_), hn::Load(d, shrink_ + lane));
    return hn::Max(hn::Floor(size), hn::Set(d, 1.0));
  }

 private:
  const double size_;
  const double* const shrink_;
};

template <Wrap kWrap, class Sizes>
HWY_INLINE void FindNeighborsAlong(const double* values, std::size_t lanes, const Sizes& sizes,
                                   Neighbors& out) {
  const Doubles d;
  const HalfFloats floats;
  const HalfIntegers integers;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    const auto p = hn::Mul(Wrapped<kWrap>(hn::Load(d, values + i)), sizes.At(i));
    const auto x = hn::Sub(p, hn::Set(d, 0.5));
    const auto low = hn::Floor(x);
    hn::Store(hn::DemoteTo(integers, low), integers, out.low.data() + i);
    hn::Store(hn::DemoteTo(floats, hn::Sub(x, low)), floats, out.fraction.data() + i);
  }
}

template <class Sizes>
HWY_INLINE void FindNeighborsIn(const TextureAxis& axis, std::size_t lanes, const Sizes& sizes,
                                Neighbors& out) {
  switch (axis.wrap) {
    case Wrap::repeat:
      return FindNeighborsAlong<Wrap::repeat>(axis.values, lanes, sizes, out);
    case Wrap::clamp:
      return FindNeighborsAlong<Wrap::clamp>(axis.values, lanes, sizes, out);
    case Wrap::mirror:
      return FindNeighborsAlong<Wrap::mirror>(axis.values, lanes, sizes, out);
  }
}

void FindNeighbors(const TextureAxis& axis, std::size_t lanes, Neighbors& out) {
  FindNeighborsIn(axis, lanes, SameSize(axis.size), out);
}

void FindNeighborsOfLevels(const TextureAxis& axis, std::size_t lanes, double factor,
                           const double* shrink, Neighbors& out) {
  FindNeighborsIn(axis, lanes, OwnSizes(axis.size * factor, shrink), out);
}

/// log2 of x >= 1, finite (find_levels).
HWY_INLINE Vector Log2(Vector x) {
  const Doubles d;
  const DoubleBits bits;
  const auto one = hn::Set(d, 1.0);
  const auto pattern = hn::BitCast(bits, x);
  // The exponent, 1023 more, as the last bits of a double from 2^52 on.
  const auto shift = hn::BitCast(bits, hn::Set(d, 0x1p52));
  const auto exponent = hn::BitCast(d, hn::Or(hn::ShiftRight<52>(pattern), shift));
  const auto fraction = hn::And(pattern, hn::Set(bits, (std::uint64_t{1} << 52) - 1));
  auto m = hn::BitCast(d, hn::Or(fraction, hn::BitCast(bits, one)));
  auto e = hn::Sub(exponent, hn::Set(d, 0x1p52 + 1023));
  const auto is_high = hn::Gt(m, hn::Set(d, 0x1.6a09e667f3bcdp0));
  m = hn::IfThenElse(is_high, hn::Mul(m, hn::Set(d, 0.5)), m);
  e = hn::IfThenElse(is_high, hn::Add(e, one), e);
  const auto z = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  const auto square = hn::Mul(z, z);
  // 2 / ln 2 divided by 11, 9, … 1.
  const double factor = 0x1.71547652b82fep1;
  auto sum = hn::Set(d, factor / 11);
  for (int n = 9; n > 0; n -= 2) {
    sum = hn::Add(hn::Mul(sum, square), hn::Set(d, factor / n));
  }
  return hn::Add(e, hn::Mul(sum, z));
}

/// The square of a length; 1 where it is less or no number.
HWY_INLINE Vector SquareFromOne(Vector s, Vector t) {
  const auto one = hn::Set(Doubles(), 1.0);
  const auto square = hn::Add(hn::Mul(s, s), hn::Mul(t, t));
  return hn::IfThenElse(hn::Gt(square, one), square, one);
}

bool FindLevels(const CoordinateSlopes& slopes, double width, double height, int last,
                std::size_t lanes, LevelsOfDetail& levels) {
  const Doubles d;
  const DoubleBits bits;
  const HalfFloats floats;
  const HalfIntegers integers;
  const auto one = hn::Set(d, 1.0);
  const auto w = hn::Set(d, width);
  const auto h = hn::Set(d, height);
  const auto greatest = hn::Set(d, static_cast<double>(std::uint64_t{1} << (2 * last)));
  auto is_above = hn::Gt(one, one);
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    const auto along_u = SquareFromOne(hn::Mul(hn::Load(d, slopes.s_u + i), w),
                                       hn::Mul(hn::Load(d, slopes.t_u + i), h));
    const auto along_v = SquareFromOne(hn::Mul(hn::Load(d, slopes.s_v + i), w),
                                       hn::Mul(hn::Load(d, slopes.t_v + i), h));
    const auto square = hn::Min(hn::Max(along_u, along_v), greatest);
    const auto has_lambda = hn::Gt(square, one);
    is_above = hn::Or(is_above, has_lambda);
    auto lambda = hn::Zero(d);
    if (!hn::AllFalse(d, has_lambda)) lambda = hn::Mul(Log2(square), hn::Set(d, 0.5));
    const auto level = hn::Floor(lambda);
    // The last bits of the difference, 1023 − level, are the exponent of 2^-level.
    const auto exponent = hn::Sub(hn::Set(d, 0x1p52 + 1023), level);
    const auto shrink = hn::BitCast(d, hn::ShiftLeft<52>(hn::BitCast(bits, exponent)));
    hn::Store(shrink, d, levels.shrink.data() + i);
    hn::Store(hn::DemoteTo(integers, level), integers, levels.level.data() + i);
    hn::Store(hn::DemoteTo(floats, hn::Sub(lambda, level)), floats, levels.fraction.data() + i);
  }
  return !hn::AllFalse(d, is_above);
}

/// A channel of texels, in units of 1/255.
template <int kChannel>
HWY_INLINE Color ChannelOf(hn::Vec<Texels> texels) {
  const Texels unsigned_tag;
  auto bytes = kChannel == 0 ? texels : hn::ShiftRight<8 * kChannel>(texels);
  if (kChannel != 3) bytes = hn::And(bytes, hn::Set(unsigned_tag, 255));
  return hn::ConvertTo(Floats(), hn::BitCast(Integers(), bytes));
}

/// A 255th (fetch_texels).
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

/// Texels are far away: begins to fetch those that will be wanted first of all. One for each two
/// lanes of a row, as those of its neighbour are mostly in the same cache line.
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

/// The texels on either side of where lanes are.
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

/// Texels next to each other, of vectors of them.
struct TexelPairs {
  hn::Vec<Texels> left;
  hn::Vec<Texels> right;
};

#if HWY_TARGET <= HWY_AVX2
/// Texels at `at` and at + 1, fetched together.
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

/// The four texels of vectors of squares, and where between them.
struct SquareTexels {
  TexelPairs low;
  TexelPairs high;
  Color along_row;
  Color along_column;
};

/// Levels of a vector of lanes: sizes, and where they begin.
struct LevelLanes {
  hn::Vec<Integers> width;
  hn::Vec<Integers> height;
  hn::Vec<Integers> first;
};

/// Where the texels of squares are: the left ones of both rows, and how far from them the right
/// ones.
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
  // The first texel has one beside it, unless there is no other.
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
  // Half as many fetches, unless a square is on an edge.
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

void BlendLevel(const TexelLevels& texture, const Squares& squares, const LaneMask& wanted,
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

void BlendLevels(const TexelLevels& texture, const LevelsOfDetail& levels,
                 const std::array<Squares, 2>& squares, const LaneMask& wanted, std::size_t lanes,
                 ColorArrays color) {
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

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
// There DemoteTo holds numbers to the greatest of float32.
void RoundLanes(const double* in, std::size_t lanes, float* out) {
  for (std::size_t i = 0; i < lanes; ++i) out[i] = static_cast<float>(in[i]);
}
#else
void RoundLanes(const double* in, std::size_t lanes, float* out) {
  const Doubles d;
  const HalfFloats floats;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    hn::Store(hn::DemoteTo(floats, hn::Load(d, in + i)), floats, out + i);
  }
}
#endif

LaneMask FindBelow(const float* values, float limit, std::size_t lanes) {
  const Floats d;
  LaneMask below{};
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    AddBits(d, hn::Lt(hn::Load(d, values + i), hn::Set(d, limit)), i, below);
  }
  return below;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(FindTexels);
HWY_EXPORT(FindNeighbors);
HWY_EXPORT(FindNeighborsOfLevels);
HWY_EXPORT(FindLevels);
HWY_EXPORT(FetchTexels);
HWY_EXPORT(BlendLevel);
HWY_EXPORT(BlendLevels);
HWY_EXPORT(RoundLanes);
HWY_EXPORT(FindBelow);

LaneMask find_texels(const TextureAxis& axis, double error, std::size_t lanes, std::int32_t* at) {
  return HWY_DYNAMIC_DISPATCH(FindTexels)(axis, error, lanes, at);
}

void find_neighbors(const TextureAxis& axis, std::size_t lanes, Neighbors& neighbors) {
  HWY_DYNAMIC_DISPATCH(FindNeighbors)(axis, lanes, neighbors);
}

void find_neighbors(const TextureAxis& axis, std::size_t lanes, double factor, const double* shrink,
                    Neighbors& neighbors) {
  HWY_DYNAMIC_DISPATCH(FindNeighborsOfLevels)(axis, lanes, factor, shrink, neighbors);
}

bool find_levels(const CoordinateSlopes& slopes, double width, double height, int last,
                 std::size_t lanes, LevelsOfDetail& levels) {
  return HWY_DYNAMIC_DISPATCH(FindLevels)(slopes, width, height, last, lanes, levels);
}

void fetch_texels(const TexelLevels& texture, const std::int32_t* columns, const std::int32_t* rows,
                  const LaneMask& wanted, std::size_t lanes, ColorArrays color) {
  HWY_DYNAMIC_DISPATCH(FetchTexels)(texture, columns, rows, wanted, lanes, color);
}

void blend_level(const TexelLevels& texture, const Squares& squares, const LaneMask& wanted,
                 std::size_t lanes, ColorArrays color) {
  HWY_DYNAMIC_DISPATCH(BlendLevel)(texture, squares, wanted, lanes, color);
}

void blend_levels(const TexelLevels& texture, const LevelsOfDetail& levels,
                  const std::array<Squares, 2>& squares, const LaneMask& wanted, std::size_t lanes,
                  ColorArrays color) {
  HWY_DYNAMIC_DISPATCH(BlendLevels)(texture, levels, squares, wanted, lanes, color);
}

void round_lanes(const double* in, std::size_t lanes, float* out) {
  HWY_DYNAMIC_DISPATCH(RoundLanes)(in, lanes, out);
}

LaneMask find_below(const float* values, float limit, std::size_t lanes) {
  return HWY_DYNAMIC_DISPATCH(FindBelow)(values, limit, lanes);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
