// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/merge_kernels.h"

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/merge_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

#include "rasterizer/internal/cells-inl.h"
#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

// A sample's four bytes as a word, red lowest.
using Pixels = hn::RebindToUnsigned<Floats>;
using Word = hn::Vec<HalfWords>;

/// Clamps to [0, 1]; NaN becomes 0.
template <class D>
HWY_INLINE hn::Vec<D> Held(D d, hn::Vec<D> value) {
  const auto positive = hn::IfThenElseZero(hn::Gt(value, hn::Zero(d)), value);
  return hn::Min(positive, hn::Set(d, 1.0F));
}

/// If this is added to a number in [0, 255], the last bits of the sum are the nearest whole number.
constexpr float kOnes = 0x1.8p23F;

/// kOnes plus 255 s for s in [0, 1]. 255 s is rounded to the nearest byte, ties to even.
HWY_INLINE hn::Vec<Floats> NearestByte(hn::Vec<Floats> held) {
  const Floats d;
  const auto most = hn::Set(d, 255.0F);
  const auto ones = hn::Set(d, kOnes);
#if HWY_NATIVE_FMA
  return hn::MulAdd(held, most, ones);  // rounded once
#else
  const auto half = hn::Set(d, 0.5F);
  const auto product = hn::Mul(held, most);
  auto nearest = hn::Round(product);
  // Rounding is monotone, so the nearest byte can be wrong only if the product was rounded to the
  // middle between two bytes. The difference 256 s − product − s, exact because the numbers are so
  // close, then shows on which side of the middle 255 s is.
  const auto is_middle = hn::Eq(hn::Abs(hn::Sub(product, nearest)), half);
  if (!hn::AllFalse(d, is_middle)) {
    const auto rest = hn::Sub(hn::Sub(hn::Mul(held, hn::Set(d, 256.0F)), product), held);
    const auto up = hn::And(is_middle, hn::Gt(rest, hn::Zero(d)));
    const auto down = hn::And(is_middle, hn::Lt(rest, hn::Zero(d)));
    nearest = hn::IfThenElse(up, hn::Add(product, half), nearest);
    nearest = hn::IfThenElse(down, hn::Sub(product, half), nearest);
  }
  return hn::Add(nearest, ones);  // exact
#endif
}

/// Packs four bytes into a word. Each byte is given with kOnes added.
HWY_INLINE hn::Vec<Pixels> WordOf(hn::Vec<Floats> red, hn::Vec<Floats> green, hn::Vec<Floats> blue,
                                  hn::Vec<Floats> alpha) {
  const Pixels d;
  // The bits of kOnes, shifted to the four places and added up.
  constexpr auto kOnesBits = std::bit_cast<std::uint32_t>(kOnes);
  constexpr std::uint32_t kRest =
      kOnesBits + (kOnesBits << 8) + (kOnesBits << 16) + (kOnesBits << 24);
  const auto low = hn::Add(hn::BitCast(d, red), hn::ShiftLeft<8>(hn::BitCast(d, green)));
  const auto high = hn::Add(hn::BitCast(d, blue), hn::ShiftLeft<8>(hn::BitCast(d, alpha)));
  return hn::Sub(hn::Add(low, hn::ShiftLeft<16>(high)), hn::Set(d, kRest));
}

/// A vector of a cell's colours, clamped to [0, 1].
struct HeldColor {
  hn::Vec<Floats> channel[4];
};

HWY_INLINE HeldColor HeldAt(const CellBatch& batch, std::size_t at) {
  const Floats d;
  const auto held = [&](std::size_t k)
                        HWY_ATTR { return Held(d, hn::Load(d, batch.color[k] + at)); };
  return {{held(0), held(1), held(2), held(3)}};
}

HWY_INLINE hn::Vec<Pixels> WordsOf(const HeldColor& color) {
  return WordOf(NearestByte(color.channel[0]), NearestByte(color.channel[1]),
                NearestByte(color.channel[2]), NearestByte(color.channel[3]));
}

/// Words with a 1 in byte kByte where the channel is 1/2, and 0 elsewhere.
template <int kByte>
HWY_INLINE hn::Vec<Pixels> OneWhereHalf(hn::Vec<Floats> held) {
  const Floats d;
  const Pixels tag;
  const auto is_half = hn::RebindMask(tag, hn::Eq(held, hn::Set(d, 0.5F)));
  return hn::IfThenElseZero(is_half, hn::Set(tag, std::uint32_t{1} << 8 * kByte));
}

/// Adds two words byte by byte. Each sum is clamped to 255.
HWY_INLINE hn::Vec<Pixels> SumOfBytes(hn::Vec<Pixels> a, hn::Vec<Pixels> b) {
  const Pixels d;
#if HWY_TARGET == HWY_SCALAR
  const auto every_other = hn::Set(d, std::uint32_t{0x00ff00ff});
  const auto carries = hn::Set(d, std::uint32_t{0x01000100});
  const auto sum = [&](hn::Vec<Pixels> x, hn::Vec<Pixels> y) HWY_ATTR {
    const auto of_both = hn::Add(hn::And(x, every_other), hn::And(y, every_other));
    const auto carried = hn::And(of_both, carries);
    return hn::And(hn::Or(of_both, hn::Sub(carried, hn::ShiftRight<8>(carried))), every_other);
  };
  const auto high = sum(hn::ShiftRight<8>(a), hn::ShiftRight<8>(b));
  return hn::Or(sum(a, b), hn::ShiftLeft<8>(high));
#else
  const hn::Repartition<std::uint8_t, Pixels> bytes;
  return hn::BitCast(d, hn::SaturatedAdd(hn::BitCast(bytes, a), hn::BitCast(bytes, b)));
#endif
}

/// min(255, 255 s + d), ties to even. If 255 s is halfway between two bytes, then 510 s is a whole
/// number. As s is a float, 255 divides this number, so s = 1/2. For s = 1/2 the nearest byte of
/// 255 s is 128, which is one too much if d is odd. Otherwise the nearest byte of 255 s + d is the
/// nearest byte of 255 s, plus d.
HWY_INLINE hn::Vec<Pixels> AddedWords(const HeldColor& color, hn::Vec<Pixels> old) {
  const auto low = hn::Or(OneWhereHalf<0>(color.channel[0]), OneWhereHalf<1>(color.channel[1]));
  const auto high = hn::Or(OneWhereHalf<2>(color.channel[2]), OneWhereHalf<3>(color.channel[3]));
  return SumOfBytes(hn::Sub(WordsOf(color), hn::And(hn::Or(low, high), old)), old);
}

/// Bytes of s over d as float32 computes them, and the lanes that float32 cannot decide.
struct NearlyOver {
  hn::Vec<Pixels> words;
  hn::Mask<Floats> is_open;
};

/// One channel of NearlyOver, with kOnes added.
struct NearlyOverChannel {
  hn::Vec<Floats> nearest;
  hn::Vec<Floats> away;  ///< distance from the value to the nearest byte
};

/// d + a (c − d), with c = 255 s, or 255 for alpha. |c|, |d| and the sum are at most 255, so each
/// of at most four roundings (of c, the difference, the product, the sum) is at most 2^-17:
/// together 2^-15. In double, which is the reference, four roundings are below 2^-44. Values
/// farther than 2^-14 from the middle between two bytes have the same nearest byte in float32 and
/// in double, whichever roundings a fused operation leaves out.
template <int kByte>
HWY_INLINE NearlyOverChannel NearlyOverByte(const HeldColor& color, hn::Vec<Pixels> old) {
  const Floats d;
  const hn::RebindToSigned<Floats> ints;
  const auto ones = hn::Set(d, kOnes);
  auto byte = hn::ShiftRight<8 * kByte>(old);
  if (kByte != 3) byte = hn::And(byte, hn::Set(Pixels(), 255));
  const auto under = hn::ConvertTo(d, hn::BitCast(ints, byte));
  const auto most = hn::Set(d, 255.0F);
  const auto more =
      kByte == 3 ? hn::Sub(most, under) : hn::MulSub(color.channel[kByte], most, under);
  const auto value = hn::MulAdd(color.channel[3], more, under);
  const auto nearest = hn::Add(value, ones);
  return {nearest, hn::Abs(hn::Sub(value, hn::Sub(nearest, ones)))};
}

HWY_INLINE hn::Mask<Floats> IsNearMiddle(hn::Vec<Floats> away) {
  return hn::Gt(away, hn::Set(Floats(), 0.5F - 0x1p-14F));
}

HWY_INLINE hn::Mask<Floats> IsWhole256th(hn::Vec<Floats> x) {
  const Floats d;
  const auto parts = hn::Mul(x, hn::Set(d, 256.0F));
  return hn::Eq(hn::Round(parts), parts);
}

HWY_INLINE NearlyOver NearlyOverWords(const HeldColor& color, hn::Vec<Pixels> old) {
  const Floats d;
  const NearlyOverChannel red = NearlyOverByte<0>(color, old);
  const NearlyOverChannel green = NearlyOverByte<1>(color, old);
  const NearlyOverChannel blue = NearlyOverByte<2>(color, old);
  const NearlyOverChannel alpha = NearlyOverByte<3>(color, old);
  const auto words = WordOf(red.nearest, green.nearest, blue.nearest, alpha.nearest);
  // If alpha and s are whole 256ths, neither float32 nor double rounds anything. A constant alpha
  // such as 1/2 can be near the middle in every fragment; colours almost never are.
  auto is_open = IsNearMiddle(alpha.away);
  if (!hn::AllFalse(d, is_open)) is_open = hn::AndNot(IsWhole256th(color.channel[3]), is_open);
  const auto most = hn::Max(hn::Max(red.away, green.away), blue.away);
  if (!hn::AllFalse(d, IsNearMiddle(most))) {
    const auto is_whole = IsWhole256th(color.channel[3]);
    const auto add = [&](hn::Vec<Floats> s, hn::Vec<Floats> away) HWY_ATTR {
      const auto is_exact = hn::And(is_whole, IsWhole256th(s));
      is_open = hn::Or(is_open, hn::AndNot(is_exact, IsNearMiddle(away)));
    };
    add(color.channel[0], red.away);
    add(color.channel[1], green.away);
    add(color.channel[2], blue.away);
  }
  return {words, is_open};
}

/// A byte of words as a number.
template <int kByte>
HWY_INLINE Vector ByteOf(Word word) {
  const HalfWords words;
  const auto byte = hn::And(hn::ShiftRight<8 * kByte>(word), hn::Set(words, 255));
  return hn::PromoteTo(Doubles(), hn::BitCast(Ints(), byte));
}

/// A channel after blending; `color` and `old` are in the same units.
template <Blend kBlend, bool kIsAlpha>
HWY_INLINE Vector Blended(Vector alpha, Vector color, Vector old) {
  const Doubles d;
  if (kBlend == Blend::additive) return hn::Add(color, old);
  const auto rest = hn::Mul(hn::Sub(hn::Set(d, 1.0), alpha), old);
  return hn::Add(kIsAlpha ? color : hn::Mul(alpha, color), rest);
}

/// Byte kByte of s over d, at its place in the word.
template <int kByte>
HWY_INLINE Word OverByte(const CellBatch& batch, std::size_t at, Vector alpha, Word old) {
  const Doubles d;
  const Halves floats;
  const auto held = Held(floats, hn::LoadU(floats, batch.color[kByte] + at));
  const auto color = hn::Mul(hn::PromoteTo(d, held), hn::Set(d, 255.0));  // exact
  const auto value = Blended<Blend::over, kByte == 3>(alpha, color, ByteOf<kByte>(old));
  const auto nearest = hn::Round(hn::Min(value, hn::Set(d, 255.0)));
  const auto byte = hn::BitCast(HalfWords(), hn::DemoteTo(Ints(), nearest));
  return hn::ShiftLeft<8 * kByte>(byte);
}

/// Words of s over d for the batch's lanes from `at` on. Rarely needed, therefore not inlined.
HWY_NOINLINE hn::Vec<Pixels> OverWords(const CellBatch& batch, std::size_t at,
                                       const std::uint32_t* old) {
  const Halves floats;
  const HalfWords tag;
  const Pixels all;
  alignas(64) std::array<std::uint32_t, FragmentBatch::kCellLanes> words;
  for (std::size_t lane = 0; lane < hn::Lanes(all); lane += hn::Lanes(tag)) {
    const std::size_t from = at + lane;
    const auto alpha =
        hn::PromoteTo(Doubles(), Held(floats, hn::LoadU(floats, batch.color[3] + from)));
    const auto under = hn::LoadU(tag, old + lane);
    const auto low =
        hn::Or(OverByte<0>(batch, from, alpha, under), OverByte<1>(batch, from, alpha, under));
    const auto high =
        hn::Or(OverByte<2>(batch, from, alpha, under), OverByte<3>(batch, from, alpha, under));
    hn::StoreU(hn::Or(low, high), tag, words.data() + lane);
  }
  return hn::Load(all, words.data());
}

/// Writes a vector of the batch's lanes, from `from` on, to the tile's arrays where `kept` is set.
template <Blend kBlend>
HWY_INLINE void PutFloats(const CellBatch& batch, std::size_t from, hn::Mask<Halves> kept,
                          std::span<float* const> arrays, std::size_t place) {
  const Doubles d;
  const Halves floats;
  const auto color_of = [&](std::size_t k)
                            HWY_ATTR { return hn::LoadU(floats, batch.color[k] + from); };
  auto alpha = hn::Zero(d);
  if (kBlend == Blend::over) alpha = hn::PromoteTo(d, color_of(3));
  for (std::size_t k = 0; k < arrays.size(); ++k) {
    float* const out = arrays[k] + place;
    auto result = color_of(k);
    if constexpr (kBlend != Blend::off) {
      const auto color = hn::PromoteTo(d, result);
      const auto old = hn::PromoteTo(d, hn::LoadU(floats, out));
      const auto value = k == 3 ? Blended<kBlend, true>(alpha, color, old)
                                : Blended<kBlend, false>(alpha, color, old);
      result = RoundToFloats(value);
    }
    PutWhere(floats, kept, result, out);
  }
}

// Load and store a vector of a cell in a tile's array: both rows of the cell, one row, or a part of
// a row.
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE hn::Vec<Floats> LoadPart(const float* from, std::size_t place) {
  const Floats d;
  const hn::Half<Floats> half;
  return hn::Combine(d, hn::LoadU(half, from + place + kTileSize), hn::LoadU(half, from + place));
}
HWY_INLINE void StorePart(hn::Vec<Floats> value, float* out, std::size_t place) {
  const hn::Half<Floats> half;
  hn::StoreU(hn::LowerHalf(half, value), half, out + place);
  hn::StoreU(hn::UpperHalf(half, value), half, out + place + kTileSize);
}
#else
static_assert(hn::MaxLanes(Floats()) <= kWidth);
HWY_INLINE hn::Vec<Floats> LoadPart(const float* from, std::size_t place) {
  return hn::LoadU(Floats(), from + place);
}
HWY_INLINE void StorePart(hn::Vec<Floats> value, float* out, std::size_t place) {
  hn::StoreU(value, Floats(), out + place);
}
#endif

/// The words after merging a vector of the batch's lanes, from `at` on, into `old`.
template <Blend kBlend>
HWY_INLINE hn::Vec<Pixels> MergedWords(const CellBatch& batch, std::size_t at,
                                       hn::Vec<Pixels> old) {
  const HeldColor color = HeldAt(batch, at);
  if (kBlend == Blend::off) return WordsOf(color);
  if (kBlend == Blend::additive) return AddedWords(color, old);
  const NearlyOver near = NearlyOverWords(color, old);
  if (hn::AllFalse(Floats(), near.is_open)) return near.words;
  alignas(64) std::array<std::uint32_t, FragmentBatch::kCellLanes> under;
  hn::Store(old, Pixels(), under.data());
  return OverWords(batch, at, under.data());
}

/// Merges a cell into a tile of words. The cell starts at the batch's lane `first`.
template <Blend kBlend>
HWY_INLINE void MergeWords(const Merging& merging, const CellBatch& batch, std::size_t first,
                           std::uint16_t bits, std::size_t column, std::size_t row,
                           const TileArea& area) {
  const Floats d;
  const Pixels tag;
  const bool has_depths = needs_depths(merging);
  for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(d)) {
    const std::size_t place = PlaceOf(column, row, lane);
    auto kept = LanesOf(d, bits, lane);
    if (has_depths) {
      const auto depth = hn::Load(d, batch.depth + first + lane);
      const auto old = LoadPart(area.depth, place);
      kept = hn::And(kept, Passes(d, merging.test, depth, old));
      if (merging.writes_depth) StorePart(hn::IfThenElse(kept, depth, old), area.depth, place);
    }
    if (hn::AllFalse(d, kept)) continue;
    const auto old = LoadPart(area.attributes[0], place);
    const auto words = MergedWords<kBlend>(batch, first + lane, hn::BitCast(tag, old));
    StorePart(hn::IfThenElse(kept, hn::BitCast(d, words), old), area.attributes[0], place);
  }
}

/// Merges a cell, as MergeWords() does, into a tile of floats.
template <Blend kBlend>
HWY_INLINE void MergeFloats(const Merging& merging, const CellBatch& batch, std::size_t first,
                            std::uint16_t bits, std::size_t column, std::size_t row,
                            const TileArea& area) {
  const Halves floats;
  for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(floats)) {
    const std::size_t from = first + lane;
    const std::size_t place = PlaceOf(column, row, lane);
    const auto depth = hn::LoadU(floats, batch.depth + from);
    const auto old_depth = hn::LoadU(floats, area.depth + place);
    const auto kept =
        hn::And(LanesOf(floats, bits, lane), Passes(floats, merging.test, depth, old_depth));
    if (hn::AllFalse(floats, kept)) continue;
    if (merging.writes_depth) PutWhere(floats, kept, depth, area.depth + place);
    PutFloats<kBlend>(batch, from, kept, area.attributes, place);
  }
}

template <Blend kBlend, bool kWords>
void MergeCellsBy(const Merging& merging, const CellBatch& batch, int left, int top,
                  std::span<const TileArea> areas) {
  for (std::size_t i = 0; i < batch.count; ++i) {
    const FragmentBatch::Cell& cell = batch.cells[i];
    const auto bits = static_cast<std::uint16_t>(cell.covered & ~batch.discarded[i]);
    if (bits == 0) continue;
    const auto merge = kWords ? MergeWords<kBlend> : MergeFloats<kBlend>;
    merge(merging, batch, i * FragmentBatch::kCellLanes, bits,
          static_cast<std::size_t>(cell.x - left), static_cast<std::size_t>(cell.y - top),
          areas[cell.sample]);
  }
}

void MergeCells(const Merging& merging, const CellBatch& batch, int left, int top,
                std::span<const TileArea> areas) {
  const auto by = [&](auto blend) HWY_ATTR {
    constexpr Blend kBlend = decltype(blend)::value;
    const auto merge = merging.has_words ? MergeCellsBy<kBlend, true> : MergeCellsBy<kBlend, false>;
    merge(merging, batch, left, top, areas);
  };
  switch (merging.blend) {
    case Blend::off:
      return by(std::integral_constant<Blend, Blend::off>());
    case Blend::over:
      return by(std::integral_constant<Blend, Blend::over>());
    case Blend::additive:
      return by(std::integral_constant<Blend, Blend::additive>());
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(MergeCells);

void merge_cells(const Merging& merging, const CellBatch& batch, int left, int top,
                 std::span<const TileArea> areas) {
  HWY_DYNAMIC_DISPATCH(MergeCells)(merging, batch, left, top, areas);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
