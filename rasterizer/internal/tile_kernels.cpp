// Compiled once per SIMD target. The best one that the processor supports is chosen at run time.

#include "rasterizer/internal/tile_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <type_traits>

#include "rasterizer/internal/depth_store.h"
#include "rasterizer/internal/group_kernels.h"
#include "rasterizer/internal/masks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/tile_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

#include "rasterizer/internal/evaluation-inl.h"
#include "rasterizer/internal/tile_spans-inl.h"
#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// The part of a plane that is constant along each row: B V + C.
struct RowsOf {
  alignas(64) std::array<double, kTileSize + kTilePadding> at;
};

HWY_INLINE void SetRows(const Plane& plane, const TileArea& area, const TilePart& part,
                        RowsOf& rows) {
  const Doubles d;
  for (int y = part.rows.begin; y < part.rows.end; y += static_cast<int>(hn::Lanes(d))) {
    const auto v = hn::LoadU(d, area.v + y);
    hn::StoreU(hn::Add(hn::Mul(hn::Set(d, plane.b), v), hn::Set(d, plane.c)), d,
               rows.at.data() + y);
  }
}

/// Stands for a mask of all lanes.
struct Everywhere {};

/// Draws samples of a triangle with `kAttributes` attributes; 0 means the setting's number.
/// `kPlain`: all attributes are smooth, and depth is tested.
template <std::size_t kAttributes, bool kPlain>
class PartDrawing {
 public:
  HWY_INLINE PartDrawing(const KernelSetting& setting, const double* numbers, const TileArea& area,
                         const TilePart& part)
      : setting_(setting), part_(part), u_(area.u), depth_(area.depth) {
    const Plane sum{numbers[Numbers::kA + Numbers::kDenominator],
                    numbers[Numbers::kB + Numbers::kDenominator],
                    numbers[Numbers::kC + Numbers::kDenominator]};
    const Plane depth = PlaneAt(numbers, Numbers::kDepth);
    if (HasSmooth()) SetRows(sum, area, part, sum_rows_);
    SetRows(depth, area, part, depth_rows_);
    sum_a_ = sum.a;
    depth_a_ = depth.a;
    for (std::size_t a = 0; a < Count(); ++a) {
      const Plane value = PlaneAt(numbers, Numbers::kValues + 3 * a);
      SetRows(value, area, part, value_rows_[a]);
      value_a_[a] = InterpolationOf(a) == Interpolation::flat ? value.c : value.a;
      values_[a] = area.attributes[a];
    }
  }

  /// Draws rows of the part, each from spans.begin to spans.end.
  HWY_INLINE void DrawSpans(const Spans& spans, std::uint64_t rows) const {
    const Halves floats;
    for (; rows != 0; rows &= rows - 1) {
      const auto y = static_cast<std::size_t>(std::countr_zero(rows));
      const std::int32_t end = spans.end[y];
      for (std::int32_t x = spans.begin[y]; x < end; x += kLanes) {
        const auto within = hn::FirstN(floats, static_cast<std::size_t>(end - x));
        Draw<true>(AlongColumns(x), y, x, within);
      }
    }
  }

  /// Draws the whole part: all rows of one vector of columns, then the next, so that numbers that
  /// are constant along columns are computed once. `kClamps`: a depth may be out of range.
  template <bool kClamps>
  HWY_INLINE void DrawAll() const {
    const Halves floats;
    for (std::int32_t x = part_.columns.begin; x < part_.columns.end; x += kLanes) {
      const Along along = AlongColumns(x);
      const std::int32_t rest = part_.columns.end - x;
      if (rest >= kLanes) {
        DrawColumns<kClamps>(along, x, Everywhere());
      } else {
        DrawColumns<true>(along, x, hn::FirstN(floats, static_cast<std::size_t>(rest)));
      }
    }
  }

 private:
  static constexpr std::int32_t kLanes = hn::MaxLanes(Doubles());
  static constexpr std::size_t kMost = kAttributes == 0 ? kMaxAttributes : kAttributes;

  /// The terms A U of the planes, for a vector of columns.
  struct Along {
    Vector depth;
    Vector sum;
    std::array<Vector, kMost> values;
  };

  /// The triangle's planes at a vector of samples of row y.
  struct PlanesOfRow {
    const PartDrawing& of;
    const Along& along;
    std::size_t y;

    HWY_INLINE std::size_t Count() const { return of.Count(); }
    HWY_INLINE bool HasSmooth() const { return of.HasSmooth(); }
    HWY_INLINE Interpolation InterpolationOf(std::size_t a) const { return of.InterpolationOf(a); }
    HWY_INLINE Vector Sum() const { return At(along.sum, of.sum_rows_); }
    HWY_INLINE Vector Value(std::size_t a) const { return At(along.values[a], of.value_rows_[a]); }
    HWY_INLINE Vector Flat(std::size_t a) const { return hn::Set(Doubles(), of.value_a_[a]); }
    HWY_INLINE Vector At(Vector along_columns, const RowsOf& rows) const {
      return hn::Add(along_columns, hn::Set(Doubles(), rows.at[y]));
    }
  };

  HWY_INLINE std::size_t Count() const {
    return kAttributes == 0 ? setting_.attributes : kAttributes;
  }
  HWY_INLINE bool HasSmooth() const { return kPlain || setting_.has_smooth; }
  HWY_INLINE bool TestsDepth() const { return kPlain || setting_.tests_depth; }
  HWY_INLINE Interpolation InterpolationOf(std::size_t a) const {
    return kPlain ? Interpolation::smooth : setting_.interpolation[a];
  }

  HWY_INLINE Along AlongColumns(std::int32_t x) const {
    const Doubles d;
    const auto u = hn::LoadU(d, u_ + x);
    Along along;
    along.depth = hn::Mul(hn::Set(d, depth_a_), u);
    if (HasSmooth()) along.sum = hn::Mul(hn::Set(d, sum_a_), u);
    for (std::size_t a = 0; a < Count(); ++a) {
      along.values[a] = hn::Mul(hn::Set(d, value_a_[a]), u);
    }
    return along;
  }

  template <bool kClamps, typename Within>
  HWY_INLINE void DrawColumns(const Along& along, std::int32_t x, const Within& within) const {
    const auto end = static_cast<std::size_t>(part_.rows.end);
    for (auto y = static_cast<std::size_t>(part_.rows.begin); y < end; ++y) {
      Draw<kClamps>(along, y, x, within);
    }
  }

  /// Draws the lanes `within` of a vector of samples, which begins at column x of row y.
  template <bool kClamps, typename Within>
  HWY_INLINE void Draw(const Along& along, std::size_t y, std::int32_t x,
                       const Within& within) const {
    const Halves floats;
    const std::size_t at = y * kTileSize + static_cast<std::size_t>(x);
    const PlanesOfRow planes{*this, along, y};
    auto value = planes.At(along.depth, depth_rows_);
    if (kClamps) value = Clamped(value, setting_.depth_least, setting_.depth_greatest);
    // A plain setting has no steps.
    const auto depth = kPlain ? hn::DemoteTo(floats, value) : Stored(value, setting_.depth_steps);
    auto mask = hn::FirstN(floats, hn::Lanes(floats));
    if constexpr (!std::is_same_v<Within, Everywhere>) mask = within;
    if (TestsDepth()) {
      const auto is_nearer = hn::Lt(depth, hn::LoadU(floats, depth_ + at));
      mask = std::is_same_v<Within, Everywhere> ? is_nearer : hn::And(mask, is_nearer);
      if (std::is_same_v<Within, Everywhere> && hn::AllFalse(floats, mask)) return;
    }
    // If all lanes are replaced, no old values need to be loaded.
    const bool is_all =
        !kStoresMasked && std::is_same_v<Within, Everywhere> && hn::AllTrue(floats, mask);
    const auto put = [&](hn::Vec<Halves> values, float* out) HWY_ATTR {
      if (is_all) {
        hn::StoreU(values, floats, out + at);
      } else {
        PutWhere(Halves(), mask, values, out + at);
      }
    };
    put(depth, depth_);
    EvaluateAttributes(planes, [&](std::size_t a, Vector result, Vector /*reciprocal*/)
                                   HWY_ATTR { put(RoundToFloats(result), values_[a]); });
  }

  const KernelSetting& setting_;
  const TilePart part_;
  const double* const u_;
  float* const depth_;
  double sum_a_;
  double depth_a_;
  std::array<double, kMost> value_a_;  ///< A of the plane; for a flat attribute, its value
  std::array<float*, kMost> values_;
  RowsOf sum_rows_;
  RowsOf depth_rows_;
  std::array<RowsOf, kMost> value_rows_;
};

/// Moves the first and the last sample of a row's span to `undrawn` if they are at a vertex, that
/// is, on two edges.
void TakeVertices(const double* numbers, const TileArea& area, int y, Spans& spans,
                  Undrawn& undrawn) {
  const auto take = [&](int x) {
    std::size_t on = 0;
    std::size_t vertex = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double row = numbers[Numbers::kB + i] * area.v[y] + numbers[Numbers::kC + i];
      const bool is_on = numbers[Numbers::kA + i] * area.u[x] + row == 0;
      on += is_on ? 1 : 0;
      if (!is_on) vertex = i;
    }
    if (on < 2) return false;
    undrawn.vertices[undrawn.vertex_count++] = {x, y, vertex};
    return true;
  };
  std::int32_t& begin = spans.begin[static_cast<std::size_t>(y)];
  std::int32_t& end = spans.end[static_cast<std::size_t>(y)];
  if (begin < end && take(begin)) ++begin;
  if (begin < end && take(end - 1)) --end;
}

void FindGreatest(const float* depth, std::span<float, kBands> greatest) {
  const Floats d;
  constexpr std::size_t kBandPixels = std::size_t{kBandSize} * kTileSize;
  for (std::size_t band = 0; band < kBands; ++band) {
    // NaNs are skipped, because no depth is less than a NaN. Several maxima are computed in
    // parallel, so that none waits for another.
    std::array<hn::Vec<Floats>, 4> most;
    most.fill(hn::Set(d, -std::numeric_limits<float>::infinity()));
    const auto greater = [](auto a, auto b) HWY_ATTR { return hn::IfThenElse(hn::Gt(a, b), a, b); };
    const float* const depths = depth + band * kBandPixels;
    for (std::size_t i = 0; i < kBandPixels; i += most.size() * hn::Lanes(d)) {
      for (std::size_t k = 0; k < most.size(); ++k) {
        most[k] = greater(hn::LoadU(d, depths + i + k * hn::Lanes(d)), most[k]);
      }
    }
    const auto of_all = greater(greater(most[0], most[1]), greater(most[2], most[3]));
    greatest[band] = hn::GetLane(hn::MaxOfLanes(d, of_all));
  }
}

Undrawn DrawPart(const KernelSetting& setting, const double* numbers, const TileArea& area,
                 const TilePart& part) {
  const Position position = PositionOf(numbers, area, part);
  if (position.is_beside) return {};
  const Depths depths = DepthsOf(numbers, area, part);
  const DepthTest test = setting.tests_depth ? DepthTest::less : DepthTest::always;
  if (IsHidden(setting, test, depths, area, part)) return {};
  Spans spans;
  if (position.cuts != 0) FindSpans(setting, numbers, position.cuts, area, part, spans);
  const std::uint64_t rows = spans.touched & ~spans.doubtful;
  Undrawn undrawn;
  undrawn.rows = spans.doubtful;
  for_each_bit(spans.on_two & rows, [&](int y) { TakeVertices(numbers, area, y, spans, undrawn); });
  const auto draw = [&](auto attributes, auto is_plain) {
    const PartDrawing<decltype(attributes)::value, decltype(is_plain)::value> drawing(
        setting, numbers, area, part);
    if (position.cuts != 0) {
      drawing.DrawSpans(spans, rows);
    } else if (depths.least >= setting.depth_least && depths.greatest <= setting.depth_greatest) {
      drawing.template DrawAll<false>();
    } else {
      drawing.template DrawAll<true>();
    }
  };
  using Many = std::integral_constant<std::size_t, 0>;
  if (!setting.is_plain) {
    draw(Many(), std::false_type());
  } else if (setting.attributes == 1) {
    draw(std::integral_constant<std::size_t, 1>(), std::true_type());
  } else if (setting.attributes == 2) {
    draw(std::integral_constant<std::size_t, 2>(), std::true_type());
  } else if (setting.attributes == 4) {
    draw(std::integral_constant<std::size_t, 4>(), std::true_type());
  } else {
    draw(Many(), std::true_type());
  }
  return undrawn;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(DrawPart);
HWY_EXPORT(FindGreatest);

void find_greatest(const float* depth, std::span<float, kBands> greatest) {
  HWY_DYNAMIC_DISPATCH(FindGreatest)(depth, greatest);
}

Undrawn draw_part(const KernelSetting& setting, const double* numbers, const TileArea& area,
                  const TilePart& part) {
  return HWY_DYNAMIC_DISPATCH(DrawPart)(setting, numbers, area, part);
}

namespace {

/// `kAttributes` is the number of attributes; 0 means the setting's number.
template <std::size_t kAttributes>
void put_fragments_of(const KernelSetting& setting, std::span<const std::uint32_t> words,
                      const TileArea& area) {
  const std::size_t attributes = kAttributes == 0 ? setting.attributes : kAttributes;
  for (std::size_t at = 0; at < words.size(); at += 2 + attributes) {
    // Writes unchanged values, too, because the processor could not predict a branch on `is_kept`.
    const std::size_t place = place_of(words[at]);
    const float depth = std::bit_cast<float>(words[at + 1]);
    const float old_depth = area.depth[place];
    const bool is_kept = !setting.tests_depth || depth < old_depth;
    area.depth[place] = is_kept ? depth : old_depth;
    for (std::size_t a = 0; a < attributes; ++a) {
      float& out = area.attributes[a][place];
      const float value = std::bit_cast<float>(words[at + 2 + a]);
      out = is_kept ? value : out;
    }
  }
}

}  // namespace

void put_vertex(const KernelSetting& setting, const double* numbers, const VertexSample& sample,
                std::span<const float> values, const TileArea& area) {
  const double* const plane = numbers + TriangleNumbers::kDepth;
  const double row = plane[1] * area.v[sample.row] + plane[2];
  const double value = plane[0] * area.u[sample.column] + row;
  const float depth = stored(std::min(std::max(value, setting.depth_least), setting.depth_greatest),
                             setting.depth_steps);
  const int place = sample.row * kTileSize + sample.column;
  if (setting.tests_depth && !(depth < area.depth[place])) return;
  area.depth[place] = depth;
  for (std::size_t a = 0; a < setting.attributes; ++a) {
    const bool is_flat = setting.interpolation[a] == Interpolation::flat;
    const auto flat = static_cast<float>(numbers[TriangleNumbers::kValues + 3 * a + 2]);
    area.attributes[a][place] = is_flat ? flat : values[a] + 0.0F;  // an exact sum is never −0
  }
}

void put_fragments(const KernelSetting& setting, std::span<const std::uint32_t> words,
                   const TileArea& area) {
  if (setting.attributes == 2) return put_fragments_of<2>(setting, words, area);
  put_fragments_of<0>(setting, words, area);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
