// Compiled once for each SIMD target; the best that the processor has is chosen at run time.

#include "rasterizer/internal/cell_kernels.h"

#include <algorithm>
#include <bit>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/cell_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include "rasterizer/internal/tile_spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kWidth = FragmentBatch::kCellWidth;

/// Columns begin … end − 1, both within a tile.
inline Mask ColumnsFrom(std::int32_t begin, std::int32_t end) {
  if (begin >= end) return 0;
  return ~Mask{0} >> (kTileSize - (end - begin)) << begin;
}

/// Whether what is there is nowhere behind any of the triangle (tile_kernels.cpp).
inline bool IsHidden(const KernelSetting& setting, DepthTest test, const Depths& depths,
                     const TileArea& area, const TilePart& part) {
  if (test == DepthTest::never) return true;
  if (!lets_fall(test)) return false;
  const auto least = static_cast<float>(
      std::min(std::max(depths.least, setting.depth_least), setting.depth_greatest));
  for (int band = part.rows.begin / kBandSize; band * kBandSize < part.rows.end; ++band) {
    const float greatest = area.greatest[band];
    if (!(test == DepthTest::less ? least >= greatest : least > greatest)) return false;
  }
  return true;
}

Mask FindCells(const KernelSetting& setting, const double* numbers, DepthTest test,
               const TileArea& area, const TilePart& part, TileCells& cells) {
  const Position position = PositionOf(numbers, area, part);
  if (position.is_beside) return 0;
  if (IsHidden(setting, test, DepthsOf(numbers, area, part), area, part)) return 0;
  const Mask of_part = ColumnsFrom(part.rows.begin, part.rows.end);
  Spans spans;
  if (position.cuts != 0) {
    FindSpans(setting, numbers, position.cuts, area, part, spans);
  } else {
    spans.touched = of_part;
    spans.begin.fill(part.columns.begin);
    spans.end.fill(part.columns.end);
  }
  constexpr Mask kEven = 0x5555555555555555;
  const Mask left_out = spans.doubtful | (spans.on_two & spans.touched);
  const Mask first_left_out = (left_out | left_out >> 1) & kEven;
  const Mask first_rows = (spans.touched | spans.touched >> 1) & kEven & ~first_left_out;
  const auto covered = [&spans](int row) -> Mask {
    if ((spans.touched >> row & 1) == 0) return 0;
    const auto at = static_cast<std::size_t>(row);
    return ColumnsFrom(spans.begin[at], spans.end[at]);
  };
  for_each_bit(first_rows, [&](int row) { cells.add_rows(row, covered(row), covered(row + 1)); });
  return (first_left_out | first_left_out << 1) & of_part;
}

/// Whether a fragment of a depth is kept where another is.
HWY_INLINE hn::Mask<Halves> Passes(DepthTest test, hn::Vec<Halves> depth, hn::Vec<Halves> old) {
  const Halves floats;
  switch (test) {
    case DepthTest::never:
      return hn::FirstN(floats, 0);
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
  return hn::FirstN(floats, hn::Lanes(floats));
}

/// Lanes of a cell from `lane` on, as its bits have them.
HWY_INLINE hn::Mask<Halves> LanesOf(std::uint16_t bits, std::size_t lane) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  bytes[0] = static_cast<std::uint8_t>(bits >> lane & ((1U << hn::Lanes(Halves())) - 1));
  return hn::LoadMaskBits(Halves(), bytes.data());
}
HWY_INLINE std::uint16_t BitsAt(hn::Mask<Halves> lanes, std::size_t lane) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(Halves(), lanes, bytes.data());
  return static_cast<std::uint16_t>(bytes[0] << lane);
}

/// Where a cell's lanes from `lane` on are in a tile's arrays.
HWY_INLINE std::size_t PlaceOf(std::size_t column, std::size_t row, std::size_t lane) {
  return (row + lane / kWidth) * kTileSize + column + lane % kWidth;
}

/// Evaluates cells of a triangle, with `kAttributes` attributes, all of them smooth, or as many and
/// as the setting says where it is 0.
template <std::size_t kAttributes, bool kDerives>
class Evaluator {
 public:
  HWY_INLINE Evaluator(const KernelSetting& setting, const double* numbers, const TileArea& area)
      : setting_(setting),
        numbers_(numbers),
        area_(area),
        depth_(PlaneAt(numbers, Numbers::kDepth)),
        sum_{numbers[Numbers::kA + Numbers::kDenominator],
             numbers[Numbers::kB + Numbers::kDenominator],
             numbers[Numbers::kC + Numbers::kDenominator]} {}

  /// The depths of a cell's lanes; returns those that may pass the test.
  HWY_INLINE std::uint16_t PutDepths(DepthTest test, const TileCell& cell, float* depths) const {
    const Doubles d;
    const Halves floats;
    const bool tests = lets_fall(test) || lets_rise(test);
    std::uint16_t passing = 0;
    for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(d)) {
      const auto value = hn::Min(hn::Max(At(depth_, cell, lane), hn::Set(d, setting_.depth_least)),
                                 hn::Set(d, setting_.depth_greatest));
      const auto depth = hn::DemoteTo(floats, value);
      hn::StoreU(depth, floats, depths + lane);
      if (!tests) continue;
      const auto column = static_cast<std::size_t>(cell.column);
      const auto row = static_cast<std::size_t>(cell.row);
      const auto old = hn::LoadU(floats, area_.depth + PlaceOf(column, row, lane));
      passing = static_cast<std::uint16_t>(passing | BitsAt(Passes(test, depth, old), lane));
    }
    return tests ? passing : std::uint16_t{0xffff};
  }

  /// The values, and their derivatives, of a cell whose lanes are those from `first` on.
  HWY_INLINE void PutValues(const TileCell& cell, std::size_t first, const CellBatch& batch) const {
    const Doubles d;
    const std::size_t attributes = kAttributes == 0 ? setting_.attributes : kAttributes;
    for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(d)) {
      auto reciprocal = hn::Zero(d);
      if (kAttributes > 0 || setting_.has_smooth) {
        reciprocal = hn::Div(hn::Set(d, 1.0), At(sum_, cell, lane));
      }
      for (std::size_t a = 0; a < attributes; ++a) {
        PutValue(a, cell, lane, first + lane, reciprocal, batch);
      }
    }
  }

 private:
  HWY_INLINE Vector At(const PlaneOf& plane, const TileCell& cell, std::size_t lane) const {
    const Doubles d;
    const auto u = hn::LoadU(d, area_.u + cell.column + lane % kWidth);
    const double v = area_.v[cell.row + static_cast<int>(lane / kWidth)];
    const double row = plane.b * v + plane.c;
    return hn::Add(hn::Mul(hn::Set(d, plane.a), u), hn::Set(d, row));
  }

  HWY_INLINE void PutValue(std::size_t a, const TileCell& cell, std::size_t lane, std::size_t at,
                           Vector reciprocal, const CellBatch& batch) const {
    const Doubles d;
    const auto interpolation = kAttributes > 0 ? Interpolation::smooth : setting_.interpolation[a];
    const PlaneOf plane = PlaneAt(numbers_, Numbers::kValues + 3 * a);
    const bool is_flat = interpolation == Interpolation::flat;
    auto value = is_flat ? hn::Set(d, plane.c) : At(plane, cell, lane);
    if (interpolation == Interpolation::smooth) value = hn::Mul(value, reciprocal);
    hn::Store(value, d, batch.values[a] + at);
    if (!kDerives) return;
    const auto along = [&](double numerator, double denominator, double step) HWY_ATTR {
      if (is_flat) return hn::Zero(d);
      const auto slope = hn::Set(d, numerator * step);
      if (interpolation == Interpolation::noperspective) return slope;
      // (N / D)' = (N' − r D') / D
      const auto rest = hn::Sub(slope, hn::Mul(value, hn::Set(d, denominator * step)));
      return hn::Mul(rest, reciprocal);
    };
    hn::Store(along(plane.a, sum_.a, setting_.u_step), d, batch.along_u[a] + at);
    hn::Store(along(plane.b, sum_.b, setting_.v_step), d, batch.along_v[a] + at);
  }

  const KernelSetting& setting_;
  const double* const numbers_;
  const TileArea& area_;
  const PlaneOf depth_;
  const PlaneOf sum_;
};

template <std::size_t kAttributes, bool kDerives>
std::size_t EvaluateCellsBy(const KernelSetting& setting, const double* numbers, DepthTest test,
                            const TileArea& area, const CellSource& source,
                            std::span<const TileCell> cells, CellBatch& batch) {
  const Evaluator<kAttributes, kDerives> evaluator(setting, numbers, area);
  std::size_t done = 0;
  for (; done < cells.size() && !batch.is_full(); ++done) {
    const TileCell& cell = cells[done];
    const std::size_t first = batch.count * FragmentBatch::kCellLanes;
    const std::uint16_t passing = evaluator.PutDepths(test, cell, batch.depth + first);
    const auto covered = static_cast<std::uint16_t>(cell.covered & passing);
    if (covered == 0) continue;
    evaluator.PutValues(cell, first, batch);
    batch.cells[batch.count++] = {source.triangle, covered,
                                  static_cast<std::uint16_t>(source.left + cell.column),
                                  static_cast<std::uint16_t>(source.top + cell.row), source.sample};
  }
  return done;
}

std::size_t EvaluateCells(const KernelSetting& setting, const double* numbers, DepthTest test,
                          const TileArea& area, const CellSource& source,
                          std::span<const TileCell> cells, CellBatch& batch) {
  const auto by = [&](auto attributes) HWY_ATTR {
    constexpr std::size_t kAttributes = decltype(attributes)::value;
    const auto evaluate = batch.has_derivatives() ? EvaluateCellsBy<kAttributes, true>
                                                  : EvaluateCellsBy<kAttributes, false>;
    return evaluate(setting, numbers, test, area, source, cells, batch);
  };
  if (!setting.all_smooth) return by(std::integral_constant<std::size_t, 0>());
  if (setting.attributes == 2) return by(std::integral_constant<std::size_t, 2>());
  if (setting.attributes == 4) return by(std::integral_constant<std::size_t, 4>());
  return by(std::integral_constant<std::size_t, 0>());
}

using Ints = hn::Rebind<std::int32_t, Doubles>;
using Words = hn::Rebind<std::uint32_t, Doubles>;
using Word = hn::Vec<Words>;

/// Held to [0, 1], NaN as 0.
template <class D>
HWY_INLINE hn::Vec<D> Held(D d, hn::Vec<D> value) {
  const auto one = hn::Set(d, 1.0F);
  const auto positive = hn::IfThenElseZero(hn::Gt(value, hn::Zero(d)), value);
  return hn::IfThenElse(hn::Gt(positive, one), one, positive);
}

/// The words of a cell's colours, whose lanes are those from `first` on of the batch: bytes nearest
/// to 255 s, ties to even.
HWY_INLINE void PutWords(const CellBatch& batch, std::size_t first, std::uint32_t* out) {
  const hn::CappedTag<float, FragmentBatch::kCellLanes> d;
  const hn::RebindToSigned<decltype(d)> ints;
  const hn::RebindToUnsigned<decltype(d)> words;
  const auto half = hn::Set(d, 0.5F);
  for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(d)) {
    auto word = hn::Zero(words);
    for (int k = 3; k >= 0; --k) {
      const float* const color = batch.color[static_cast<std::size_t>(k)] + first + lane;
      const auto held = Held(d, hn::LoadU(d, color));
      const auto product = hn::Mul(held, hn::Set(d, 255.0F));
      auto nearest = hn::Round(product);
      // Rounding keeps order, so that only a product rounded to the middle between two bytes may
      // have gone to the wrong one: there 256 s − s says on which side 255 s is, as nothing is lost
      // of numbers so close.
      const auto is_middle = hn::Eq(hn::Abs(hn::Sub(product, nearest)), half);
      if (!hn::AllFalse(d, is_middle)) {
        const auto rest = hn::Sub(hn::Sub(hn::Mul(held, hn::Set(d, 256.0F)), product), held);
        const auto up = hn::And(is_middle, hn::Gt(rest, hn::Zero(d)));
        const auto down = hn::And(is_middle, hn::Lt(rest, hn::Zero(d)));
        nearest = hn::IfThenElse(up, hn::Add(product, half), nearest);
        nearest = hn::IfThenElse(down, hn::Sub(product, half), nearest);
      }
      word = hn::Or(hn::ShiftLeft<8>(word), hn::BitCast(words, hn::ConvertTo(ints, nearest)));
    }
    hn::StoreU(word, words, out + lane);
  }
}

/// A byte of words as a number.
template <int kByte>
HWY_INLINE Vector ByteOf(Word word) {
  const Words words;
  const auto byte = hn::And(hn::ShiftRight<8 * kByte>(word), hn::Set(words, 255));
  return hn::PromoteTo(Doubles(), hn::BitCast(Ints(), byte));
}

/// What blending makes of a channel, `color` and `old` in the same units.
template <Blend kBlend, bool kIsAlpha>
HWY_INLINE Vector Blended(Vector alpha, Vector color, Vector old) {
  const Doubles d;
  if (kBlend == Blend::additive) return hn::Add(color, old);
  const auto rest = hn::Mul(hn::Sub(hn::Set(d, 1.0), alpha), old);
  return hn::Add(kIsAlpha ? color : hn::Mul(alpha, color), rest);
}

/// Byte k of a blended word, in its place.
template <Blend kBlend, int kByte>
HWY_INLINE Word BlendedByte(const CellBatch& batch, std::size_t from, Vector alpha, Word old) {
  const Doubles d;
  const Halves floats;
  const auto held = Held(floats, hn::LoadU(floats, batch.color[kByte] + from));
  const auto color = hn::Mul(hn::PromoteTo(d, held), hn::Set(d, 255.0));  // exact
  const auto value = Blended<kBlend, kByte == 3>(alpha, color, ByteOf<kByte>(old));
  const auto nearest = hn::Round(hn::Min(value, hn::Set(d, 255.0)));
  const auto byte = hn::BitCast(Words(), hn::DemoteTo(Ints(), nearest));
  return hn::ShiftLeft<8 * kByte>(byte);
}

/// Puts the kept lanes of a cell, `from` on of the batch, where they go; `words`: PutWords of them,
/// where nothing is blended.
template <Blend kBlend>
HWY_INLINE void PutBytes(const CellBatch& batch, std::size_t from, hn::Mask<Halves> kept,
                         const std::uint32_t* words, float* out) {
  const Doubles d;
  const Halves floats;
  const Words tag;
  auto word = hn::Zero(tag);
  if constexpr (kBlend == Blend::off) {
    word = hn::LoadU(tag, words);
  } else {
    const auto old = hn::BitCast(tag, hn::LoadU(floats, out));
    auto alpha = hn::Zero(d);
    if (kBlend == Blend::over) {
      alpha = hn::PromoteTo(d, Held(floats, hn::LoadU(floats, batch.color[3] + from)));
    }
    const auto low = hn::Or(BlendedByte<kBlend, 0>(batch, from, alpha, old),
                            BlendedByte<kBlend, 1>(batch, from, alpha, old));
    const auto high = hn::Or(BlendedByte<kBlend, 2>(batch, from, alpha, old),
                             BlendedByte<kBlend, 3>(batch, from, alpha, old));
    word = hn::Or(low, high);
  }
  PutWhere(kept, hn::BitCast(floats, word), out);
}

/// The same of floats.
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
      result = hn::DemoteTo(floats, value);
    }
    PutWhere(kept, result, out);
  }
}

/// Merges a cell, whose lanes are those from `first` on of the batch.
template <Blend kBlend, bool kWords>
HWY_INLINE void MergeCell(const Merging& merging, const CellBatch& batch, std::size_t first,
                          std::uint16_t bits, std::size_t column, std::size_t row,
                          const TileArea& area) {
  const Halves floats;
  alignas(64) std::array<std::uint32_t, FragmentBatch::kCellLanes> words;
  if (kWords && kBlend == Blend::off) PutWords(batch, first, words.data());
  for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(floats)) {
    const std::size_t from = first + lane;
    const std::size_t place = PlaceOf(column, row, lane);
    const auto depth = hn::LoadU(floats, batch.depth + from);
    const auto old_depth = hn::LoadU(floats, area.depth + place);
    const auto kept = hn::And(LanesOf(bits, lane), Passes(merging.test, depth, old_depth));
    if (hn::AllFalse(floats, kept)) continue;
    if (merging.writes_depth) PutWhere(kept, depth, area.depth + place);
    if constexpr (kWords) {
      PutBytes<kBlend>(batch, from, kept, words.data() + lane, area.attributes[0] + place);
    } else {
      PutFloats<kBlend>(batch, from, kept, area.attributes, place);
    }
  }
}

template <Blend kBlend, bool kWords>
void MergeCellsBy(const Merging& merging, const CellBatch& batch, int left, int top,
                  std::span<const TileArea> areas) {
  for (std::size_t i = 0; i < batch.count; ++i) {
    const FragmentBatch::Cell& cell = batch.cells[i];
    const auto bits = static_cast<std::uint16_t>(cell.covered & ~batch.discarded[i]);
    if (bits == 0) continue;
    MergeCell<kBlend, kWords>(merging, batch, i * FragmentBatch::kCellLanes, bits,
                              static_cast<std::size_t>(cell.x - left),
                              static_cast<std::size_t>(cell.y - top), areas[cell.sample]);
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

HWY_EXPORT(FindCells);
HWY_EXPORT(EvaluateCells);
HWY_EXPORT(MergeCells);

void TileCells::add_rows(int row, Mask of_first, Mask of_second) {
  constexpr int kCellWidth = static_cast<int>(FragmentBatch::kCellWidth);
  for (Mask rest = of_first | of_second; rest != 0;) {
    const int begin = std::countr_zero(rest) & ~1;
    const int column = std::min(begin, kTileSize - kCellWidth);
    // What is before `begin` belongs to the cell before.
    const Mask here = (Mask{0xff} << column) & (~Mask{0} << begin);
    const auto first = static_cast<unsigned>((of_first & here) >> column);
    const auto second = static_cast<unsigned>((of_second & here) >> column);
    add({column, row, static_cast<std::uint16_t>(first | second << kCellWidth)});
    rest &= ~here;
  }
}

Mask find_cells(const KernelSetting& setting, const double* numbers, DepthTest test,
                const TileArea& area, const TilePart& part, TileCells& cells) {
  return HWY_DYNAMIC_DISPATCH(FindCells)(setting, numbers, test, area, part, cells);
}

std::size_t evaluate_cells(const KernelSetting& setting, const double* numbers, DepthTest test,
                           const TileArea& area, const CellSource& source,
                           std::span<const TileCell> cells, CellBatch& batch) {
  return HWY_DYNAMIC_DISPATCH(EvaluateCells)(setting, numbers, test, area, source, cells, batch);
}

void merge_cells(const Merging& merging, const CellBatch& batch, int left, int top,
                 std::span<const TileArea> areas) {
  HWY_DYNAMIC_DISPATCH(MergeCells)(merging, batch, left, top, areas);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
