// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/cell_kernels.h"

#include <algorithm>
#include <bit>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/cell_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

#include "rasterizer/internal/cells-inl.h"
#include "rasterizer/internal/evaluation-inl.h"
#include "rasterizer/internal/tile_spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// The mask of columns begin … end − 1, which must lie within a tile.
inline Mask ColumnsFrom(std::int32_t begin, std::int32_t end) {
  if (begin >= end) return 0;
  return ~Mask{0} >> (kTileSize - (end - begin)) << begin;
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

/// Evaluates cells of a triangle with `kAttributes` attributes, all of them smooth. If
/// `kAttributes` is 0, the setting gives the attributes' number and kinds.
template <std::size_t kAttributes, bool kDerives>
class Evaluator {
 public:
  HWY_INLINE Evaluator(const KernelSetting& setting, const double* planes, const TileArea& area)
      : setting_(setting),
        planes_of_(planes),
        u_(area.u),
        v_(area.v),
        depths_(area.depth),
        depth_(PlaneAt(planes, TrianglePlanes::kDepth)),
        sum_(PlaneAt(planes, TrianglePlanes::kSum)) {
    for (std::size_t a = 0; a < kAttributes; ++a) {
      planes_[a] = PlaneAt(planes, TrianglePlanes::kValues + 3 * a);
    }
  }

  /// The depths of a cell's lanes from `lane` on.
  HWY_INLINE hn::Vec<Halves> DepthAt(const TileCell& cell, std::size_t lane) const {
    const auto value =
        Clamped(At(depth_, cell, lane), setting_.depth_least, setting_.depth_greatest);
    return Stored(value, setting_.depth_steps);
  }

  /// Stores the depths of a cell's lanes; returns the lanes that may pass the test.
  HWY_INLINE std::uint16_t PutDepths(DepthTest test, const TileCell& cell, float* depths) const {
    const Halves floats;
    const bool tests = lets_fall(test) || lets_rise(test);
    std::uint64_t passing = 0;
    for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(floats)) {
      const auto depth = DepthAt(cell, lane);
      hn::StoreU(depth, floats, depths + lane);
      if (!tests) continue;
      const auto column = static_cast<std::size_t>(cell.column);
      const auto row = static_cast<std::size_t>(cell.row);
      const auto old = hn::LoadU(floats, depths_ + PlaceOf(column, row, lane));
      passing |= BitsOf(floats, Passes(floats, test, depth, old)) << lane;
    }
    return tests ? static_cast<std::uint16_t>(passing) : std::uint16_t{0xffff};
  }

  /// Stores the values and derivatives of a cell in the batch's lanes from `first` on.
  HWY_INLINE void PutValues(const TileCell& cell, std::size_t first, const CellBatch& batch) const {
    for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(Doubles())) {
      EvaluateAttributes(PlanesOfCell{*this, cell, lane},
                         [&](std::size_t a, Vector value, Vector reciprocal)
                             HWY_ATTR { PutValue(a, value, reciprocal, first + lane, batch); });
    }
  }

 private:
  /// A triangle's planes at the lanes of a cell from `lane` on.
  struct PlanesOfCell {
    const Evaluator& of;
    const TileCell& cell;
    std::size_t lane;

    HWY_INLINE std::size_t Count() const {
      return kAttributes == 0 ? of.setting_.attributes : kAttributes;
    }
    HWY_INLINE bool HasSmooth() const { return kAttributes > 0 || of.setting_.has_smooth; }
    HWY_INLINE Interpolation InterpolationOf(std::size_t a) const { return of.InterpolationOf(a); }
    HWY_INLINE Vector Sum() const { return of.At(of.sum_, cell, lane); }
    HWY_INLINE Vector Value(std::size_t a) const {
      return of.At(of.PlaneOfAttribute(a), cell, lane);
    }
    HWY_INLINE Vector Flat(std::size_t a) const {
      return hn::Set(Doubles(), of.PlaneOfAttribute(a).c);
    }
  };

  HWY_INLINE Interpolation InterpolationOf(std::size_t a) const {
    return kAttributes > 0 ? Interpolation::smooth : setting_.interpolation[a];
  }
  HWY_INLINE Plane PlaneOfAttribute(std::size_t a) const {
    if (kAttributes > 0) return planes_[a];
    return PlaneAt(planes_of_, TrianglePlanes::kValues + 3 * a);
  }

  HWY_INLINE Vector At(const Plane& plane, const TileCell& cell, std::size_t lane) const {
    const auto u = hn::LoadU(Doubles(), u_ + cell.column + lane % kWidth);
    const double v = v_[cell.row + static_cast<int>(lane / kWidth)];
    return OnPlane(plane.a, u, plane.b * v + plane.c);
  }

  HWY_INLINE void PutValue(std::size_t a, Vector value, Vector reciprocal, std::size_t at,
                           const CellBatch& batch) const {
    const Doubles d;
    hn::Store(value, d, batch.values[a] + at);
    if (!kDerives) return;
    const Interpolation interpolation = InterpolationOf(a);
    const Plane plane = PlaneOfAttribute(a);
    const auto along = [&](double numerator, double denominator, double step) HWY_ATTR {
      if (interpolation == Interpolation::flat) return hn::Zero(d);
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
  const double* const planes_of_;
  const double* const u_;  ///< [column]
  const double* const v_;  ///< [row]
  const float* const depths_;
  const Plane depth_;
  const Plane sum_;
  Plane planes_[std::max<std::size_t>(kAttributes, 1)];  ///< [attribute]
};

HWY_INLINE FragmentBatch::Cell PlaceIn(const CellSource& source, std::uint32_t triangle,
                                       const TileCell& cell, std::uint16_t covered) {
  return {triangle, covered, static_cast<std::uint16_t>(source.left + cell.column),
          static_cast<std::uint16_t>(source.top + cell.row), source.sample};
}

template <std::size_t kAttributes, bool kDerives>
std::size_t EvaluateCellsBy(const KernelSetting& setting, const double* planes,
                            const Merging& merging, const TileArea& area, const CellSource& source,
                            std::span<const TileCell> cells, CellBatch& batch) {
  const bool has_depths = needs_depths(merging);
  const Evaluator<kAttributes, kDerives> evaluator(setting, planes, area);
  std::size_t done = 0;
  for (; done < cells.size() && !batch.is_full(); ++done) {
    const TileCell& cell = cells[done];
    const std::size_t first = batch.count * FragmentBatch::kCellLanes;
    std::uint16_t covered = cell.covered;
    if (has_depths) covered &= evaluator.PutDepths(merging.test, cell, batch.depth + first);
    if (covered == 0) continue;
    evaluator.PutValues(cell, first, batch);
    batch.cells[batch.count++] = PlaceIn(source, source.triangle, cell, covered);
  }
  return done;
}

template <std::size_t kAttributes, bool kDerives>
std::size_t EvaluateMarkedBy(const KernelSetting& setting,
                             std::span<const MarkedTriangle> triangles, const TileArea& area,
                             const CellSource& source, std::span<const MarkedCells::Cell> cells,
                             CellBatch& batch) {
  std::size_t done = 0;
  for (; done < cells.size() && !batch.is_full(); ++done) {
    const TileCell& cell = cells[done].cell;
    const MarkedTriangle& of = triangles[cells[done].mark - 1];
    const Evaluator<kAttributes, kDerives> evaluator(setting, of.planes, area);
    evaluator.PutValues(cell, batch.count * FragmentBatch::kCellLanes, batch);
    batch.cells[batch.count++] = PlaceIn(source, of.triangle, cell, cell.covered);
  }
  return done;
}

/// Calls work(attributes, derives) with Evaluator's template arguments as constants.
template <class Work>
HWY_INLINE std::size_t ByKind(const KernelSetting& setting, const CellBatch& batch,
                              const Work& work) {
  const auto by = [&](auto attributes) HWY_ATTR {
    return batch.has_derivatives() ? work(attributes, std::true_type())
                                   : work(attributes, std::false_type());
  };
  if (!setting.all_smooth) return by(std::integral_constant<std::size_t, 0>());
  if (setting.attributes == 2) return by(std::integral_constant<std::size_t, 2>());
  if (setting.attributes == 4) return by(std::integral_constant<std::size_t, 4>());
  return by(std::integral_constant<std::size_t, 0>());
}

std::size_t EvaluateCells(const KernelSetting& setting, const double* planes,
                          const Merging& merging, const TileArea& area, const CellSource& source,
                          std::span<const TileCell> cells, CellBatch& batch) {
  return ByKind(setting, batch, [&](auto attributes, auto derives) HWY_ATTR {
    return EvaluateCellsBy<decltype(attributes)::value, decltype(derives)::value>(
        setting, planes, merging, area, source, cells, batch);
  });
}

std::size_t EvaluateMarked(const KernelSetting& setting, std::span<const MarkedTriangle> triangles,
                           const TileArea& area, const CellSource& source,
                           std::span<const MarkedCells::Cell> cells, CellBatch& batch) {
  return ByKind(setting, batch, [&](auto attributes, auto derives) HWY_ATTR {
    return EvaluateMarkedBy<decltype(attributes)::value, decltype(derives)::value>(
        setting, triangles, area, source, cells, batch);
  });
}

bool MarkCells(const KernelSetting& setting, const double* planes, const Merging& merging,
               const TileArea& area, std::span<const TileCell> cells, std::uint32_t mark,
               std::uint32_t* marks) {
  const Halves floats;
  const Evaluator<0, false> evaluator(setting, planes, area);
  const HalfWords tag;
  const auto marked = hn::Set(tag, mark);
  auto any = hn::FirstN(floats, 0);
  for (const TileCell& cell : cells) {
    const auto column = static_cast<std::size_t>(cell.column);
    const auto row = static_cast<std::size_t>(cell.row);
    for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; lane += hn::Lanes(floats)) {
      const auto covered = LanesOf(floats, cell.covered, lane);
      const std::size_t place = PlaceOf(column, row, lane);
      const auto depth = evaluator.DepthAt(cell, lane);
      const auto old = hn::LoadU(floats, area.depth + place);
      const auto seen = hn::And(covered, Passes(floats, merging.test, depth, old));
      any = hn::Or(any, seen);
      if (merging.writes_depth) PutWhere(floats, seen, depth, area.depth + place);
      PutWhere(tag, hn::RebindMask(tag, seen), marked, marks + place);
    }
  }
  return !hn::AllFalse(floats, any);
}

/// The columns of a cell's row that have this mark.
HWY_INLINE std::uint64_t BitsOfMark(const std::uint32_t* marks, std::uint32_t mark) {
  const HalfWords d;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < kWidth; i += hn::Lanes(d)) {
    bits |= BitsOf(d, hn::Eq(hn::LoadU(d, marks + i), hn::Set(d, mark))) << i;
  }
  return bits;
}

/// The columns of a row that have any mark.
HWY_INLINE Mask ColumnsMarked(const std::uint32_t* marks) {
  Mask unmarked = 0;
  for (std::size_t i = 0; i < kTileSize; i += kWidth) unmarked |= BitsOfMark(marks + i, 0) << i;
  return ~unmarked;
}

void TakeMarked(int row, std::uint32_t* marks, MarkedCells& cells) {
  constexpr int kLast = kTileSize - static_cast<int>(kWidth);
  std::uint32_t* const first = marks + static_cast<std::size_t>(row) * kTileSize;
  std::uint32_t* const second = first + kTileSize;
  Mask of_first = ColumnsMarked(first);
  Mask of_second = ColumnsMarked(second);
  cells.count = 0;
  while ((of_first | of_second) != 0) {
    const int begin = std::countr_zero(of_first | of_second);
    const int column = std::min(begin & ~1, kLast);
    const std::uint32_t mark = (of_first >> begin & 1) != 0 ? first[begin] : second[begin];
    const auto here = [&](Mask& columns, const std::uint32_t* of_row) HWY_ATTR {
      const Mask found = BitsOfMark(of_row + column, mark) << column & columns;
      columns &= ~found;
      return static_cast<unsigned>(found >> column);
    };
    const unsigned upper = here(of_first, first);
    const unsigned lower = here(of_second, second);
    const auto covered = static_cast<std::uint16_t>(upper | lower << kWidth);
    cells.cells[cells.count++] = {{column, row, covered}, mark};
  }
  if (cells.count != 0) std::fill(first, second + kTileSize, 0);
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(FindCells);
HWY_EXPORT(EvaluateCells);
HWY_EXPORT(EvaluateMarked);
HWY_EXPORT(MarkCells);
HWY_EXPORT(TakeMarked);

void TileCells::add_rows(int row, Mask of_first, Mask of_second) {
  constexpr int kCellWidth = static_cast<int>(FragmentBatch::kCellWidth);
  for (Mask rest = of_first | of_second; rest != 0;) {
    const int begin = std::countr_zero(rest) & ~1;
    const int column = std::min(begin, kTileSize - kCellWidth);
    // Columns before `begin` belong to the previous cell.
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

std::size_t evaluate_cells(const KernelSetting& setting, const double* planes,
                           const Merging& merging, const TileArea& area, const CellSource& source,
                           std::span<const TileCell> cells, CellBatch& batch) {
  return HWY_DYNAMIC_DISPATCH(EvaluateCells)(setting, planes, merging, area, source, cells, batch);
}

bool mark_cells(const KernelSetting& setting, const double* planes, const Merging& merging,
                const TileArea& area, std::span<const TileCell> cells, std::uint32_t mark,
                std::uint32_t* marks) {
  return HWY_DYNAMIC_DISPATCH(MarkCells)(setting, planes, merging, area, cells, mark, marks);
}

void take_marked(int row, std::uint32_t* marks, MarkedCells& cells) {
  HWY_DYNAMIC_DISPATCH(TakeMarked)(row, marks, cells);
}

std::size_t evaluate_marked(const KernelSetting& setting, std::span<const MarkedTriangle> triangles,
                            const TileArea& area, const CellSource& source,
                            std::span<const MarkedCells::Cell> cells, CellBatch& batch) {
  return HWY_DYNAMIC_DISPATCH(EvaluateMarked)(setting, triangles, area, source, cells, batch);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
