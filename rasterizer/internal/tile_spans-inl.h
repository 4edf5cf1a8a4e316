// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Finds where a triangle lies relative to a part of a tile: beside the part, over all of it, or in
// spans of its rows. Also finds whether the triangle is hidden there. Included once for each SIMD
// target, as Highway requires.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#if defined(RASTERCHECK_TILE_SPANS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_TILE_SPANS_INL_H_
#undef RASTERCHECK_TILE_SPANS_INL_H_
#else
#define RASTERCHECK_TILE_SPANS_INL_H_
#endif

#include <hwy/highway.h>

#include "rasterizer/internal/plane.h"
#include "rasterizer/internal/tile_kernels.h"
#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

using Numbers = TriangleNumbers;

HWY_INLINE Plane PlaneAt(const double* numbers, std::size_t at) {
  return {numbers[at], numbers[at + 1], numbers[at + 2]};
}

/// The columns of each row that are surely inside all half-planes.
struct Spans {
  using Columns = std::array<std::int32_t, kTileSize + kTilePadding>;
  alignas(64) Columns begin;
  alignas(64) Columns end;
  std::uint64_t touched = 0;   ///< rows that may have samples inside
  std::uint64_t doubtful = 0;  ///< `touched` rows with samples that may or may not be inside
  std::uint64_t on_two = 0;    ///< rows whose first or last sample is inside and on two edges
};

/// Where a half-plane's line crosses a vector of rows. The line's values rise or fall along a row,
/// so the samples that are surely inside begin or end near the column where the values cross the
/// limit. They begin or end exactly there if the samples on either side confirm it.
struct Crossing {
  Vector after;               ///< the first column after the crossing
  hn::Mask<Doubles> rises;    ///< true if the inside comes after the crossing
  hn::Mask<Doubles> is_sure;  ///< true if both samples confirm `after`
  /// True if the sample on the outside is surely outside. Otherwise all samples beyond it may be
  /// inside.
  hn::Mask<Doubles> is_far;
  hn::Mask<Doubles> is_on;  ///< true if the sample on the inside is exactly on the line
};

HWY_INLINE Crossing CrossingAt(const KernelSetting& setting, const double* numbers,
                               std::size_t index, const TileArea& area, const TilePart& part,
                               Vector v) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const auto a = hn::Set(d, numbers[Numbers::kA + index]);
  const auto sure = hn::Set(d, numbers[Numbers::kSure + index]);
  const auto possible = hn::Set(d, numbers[Numbers::kPossible + index]);
  const auto u_first = hn::Set(d, area.u[0]);
  const auto u_step = hn::Set(d, setting.u_step);
  const auto first = hn::Set(d, static_cast<double>(part.columns.begin - 1));
  const auto last = hn::Set(d, static_cast<double>(part.columns.end - 1));
  const auto slope = hn::Mul(a, u_step);
  const auto row = hn::Add(hn::Mul(hn::Set(d, numbers[Numbers::kB + index]), v),
                           hn::Set(d, numbers[Numbers::kC + index]));
  // Samples on a line without a band are inside if the line's limit is below 0. The crossing at
  // such a sample is exact, because the quotient is a whole number.
  const auto at_first = hn::Add(hn::Mul(a, u_first), row);
  const auto exact = hn::Div(hn::Sub(hn::Max(sure, zero), at_first), slope);
  const auto rises = hn::Gt(slope, zero);
  // True if a sample exactly at the crossing counts as lying after it. `crossing` is then the
  // column before that sample.
  const auto counts_as_after = hn::Not(hn::Xor(rises, hn::Lt(sure, zero)));
  auto crossing = hn::IfThenElse(counts_as_after, hn::Sub(hn::Ceil(exact), one), hn::Floor(exact));
  const auto of_level = hn::IfThenElse(hn::Gt(row, sure), last, first);
  crossing = hn::IfThenElse(hn::Eq(slope, zero), of_level, crossing);
  // The samples on either side, clamped to the part.
  const auto before = hn::Min(hn::Max(crossing, first), last);
  const auto u = hn::Add(u_first, hn::Mul(before, u_step));
  const auto e_before = hn::Add(hn::Mul(a, u), row);
  const auto e_after = hn::Add(hn::Mul(a, hn::Add(u, u_step)), row);
  const auto starts = hn::Eq(before, first);
  const auto ends = hn::Eq(before, last);
  const auto outside = hn::IfThenElse(rises, e_before, e_after);
  const auto inside = hn::IfThenElse(rises, e_after, e_before);
  const auto no_outside = hn::Or(hn::And(rises, starts), hn::AndNot(rises, ends));
  const auto no_inside = hn::Or(hn::And(rises, ends), hn::AndNot(rises, starts));
  const auto is_out = hn::Or(no_outside, hn::Not(hn::Gt(outside, sure)));
  const auto is_in = hn::Or(no_inside, hn::Gt(inside, sure));
  return {hn::Add(before, one), rises, hn::And(is_out, is_in),
          hn::Or(no_outside, hn::Not(hn::Gt(outside, possible))), hn::Eq(inside, zero)};
}

/// Finds the spans of a part that half-planes cut.
HWY_INLINE void FindSpans(const KernelSetting& setting, const double* numbers, std::uint64_t cuts,
                          const TileArea& area, const TilePart& part, Spans& spans) {
  const Doubles d;
  const Ints ints;
  const auto first = hn::Set(d, static_cast<double>(part.columns.begin));
  const auto last = hn::Set(d, static_cast<double>(part.columns.end));
  for (int y = part.rows.begin; y < part.rows.end; y += static_cast<int>(hn::Lanes(d))) {
    const auto v = hn::LoadU(d, area.v + y);
    auto begin = first;
    auto end = last;
    auto possible_begin = first;
    auto possible_end = last;
    auto is_sure = hn::FirstN(d, hn::Lanes(d));
    auto on_one = hn::FirstN(d, 0);
    auto on_two = on_one;
    for (std::uint64_t rest = cuts; rest != 0; rest &= rest - 1) {
      const auto index = static_cast<std::size_t>(std::countr_zero(rest));
      const Crossing at = CrossingAt(setting, numbers, index, area, part, v);
      begin = hn::Max(begin, hn::IfThenElse(at.rises, at.after, first));
      end = hn::Min(end, hn::IfThenElse(at.rises, last, at.after));
      const auto begins = hn::And(at.is_far, at.rises);
      const auto ends = hn::AndNot(at.rises, at.is_far);
      possible_begin = hn::Max(possible_begin, hn::IfThenElse(begins, at.after, first));
      possible_end = hn::Min(possible_end, hn::IfThenElse(ends, at.after, last));
      is_sure = hn::And(is_sure, at.is_sure);
      if (index < 3 && setting.corner_sign == 0) {
        on_two = hn::Or(on_two, hn::And(on_one, at.is_on));
        on_one = hn::Or(on_one, at.is_on);
      }
    }
    hn::StoreU(hn::DemoteTo(ints, begin), ints, spans.begin.data() + y);
    hn::StoreU(hn::DemoteTo(ints, end), ints, spans.end.data() + y);
    const auto is_same = hn::And(hn::Eq(begin, possible_begin), hn::Eq(end, possible_end));
    const auto of_lanes = (std::uint64_t{1} << hn::Lanes(d)) - 1;
    spans.touched |= BitsOf(d, hn::Gt(possible_end, possible_begin)) << y;
    spans.doubtful |= (~BitsOf(d, hn::And(is_same, is_sure)) & of_lanes) << y;
    spans.on_two |= BitsOf(d, on_two) << y;
  }
  const int rows = part.rows.end - part.rows.begin;
  spans.touched &= ~std::uint64_t{0} >> (kTileSize - rows) << part.rows.begin;
  spans.doubtful &= spans.touched;
}

/// How a triangle's half-planes lie relative to a part of a tile: `cuts` are the half-planes
/// that cut the part; `is_beside` is true if one half-plane excludes all of the part. A line's
/// extremes in the part are at corners (plane.h).
struct Position {
  bool is_beside = false;
  std::uint64_t cuts = 0;
};

HWY_INLINE Position PositionOf(const double* numbers, const TileArea& area, const TilePart& part) {
  const Doubles d;
  const auto u0 = hn::Set(d, area.u[part.columns.begin]);
  const auto u1 = hn::Set(d, area.u[part.columns.end - 1]);
  const auto v0 = hn::Set(d, area.v[part.rows.begin]);
  const auto v1 = hn::Set(d, area.v[part.rows.end - 1]);
  Position position;
  for (std::size_t i = 0; i < Numbers::kHalfPlanes; i += hn::Lanes(d)) {
    const auto a = hn::LoadU(d, numbers + Numbers::kA + i);
    const auto b = hn::LoadU(d, numbers + Numbers::kB + i);
    const auto c = hn::LoadU(d, numbers + Numbers::kC + i);
    const auto sure = hn::LoadU(d, numbers + Numbers::kSure + i);
    const auto possible = hn::LoadU(d, numbers + Numbers::kPossible + i);
    const auto a0 = hn::Mul(a, u0);
    const auto a1 = hn::Mul(a, u1);
    const auto b0 = hn::Mul(b, v0);
    const auto b1 = hn::Mul(b, v1);
    const auto least = hn::Add(hn::Min(a0, a1), hn::Add(hn::Min(b0, b1), c));
    const auto greatest = hn::Add(hn::Max(a0, a1), hn::Add(hn::Max(b0, b1), c));
    // The vector may extend beyond the last half-plane.
    const auto those = hn::FirstN(d, Numbers::kHalfPlanes - i);
    const auto beside = hn::And(those, hn::Not(hn::Gt(greatest, possible)));
    const auto within = hn::Gt(least, hn::Max(sure, hn::Zero(d)));
    position.is_beside = position.is_beside || BitsOf(d, beside) != 0;
    position.cuts |= BitsOf(d, hn::AndNot(within, those)) << i;
  }
  return position;
}

/// The least and the greatest depth of a part, before clamping; both are at corners (plane.h).
struct Depths {
  double least;
  double greatest;
};

HWY_INLINE Depths DepthsOf(const double* numbers, const TileArea& area, const TilePart& part) {
  const Plane plane = PlaneAt(numbers, Numbers::kDepth);
  const auto [u_least, u_greatest] =
      std::minmax({plane.a * area.u[part.columns.begin], plane.a * area.u[part.columns.end - 1]});
  const auto [v_least, v_greatest] =
      std::minmax({plane.b * area.v[part.rows.begin], plane.b * area.v[part.rows.end - 1]});
  return {u_least + (v_least + plane.c), u_greatest + (v_greatest + plane.c)};
}

/// True if no fragment of a triangle with these depths can pass the test in a part. This includes
/// fragments whose coverage is decided later, because their depths come from the same plane.
/// Clamping and storing are monotone too.
HWY_INLINE bool IsHidden(const KernelSetting& setting, DepthTest test, const Depths& depths,
                         const TileArea& area, const TilePart& part) {
  if (test == DepthTest::never) return true;
  if (!lets_fall(test)) return false;
  const float least =
      stored(std::min(std::max(depths.least, setting.depth_least), setting.depth_greatest),
             setting.depth_steps);
  for (int band = part.rows.begin / kBandSize; band * kBandSize < part.rows.end; ++band) {
    const float greatest = area.greatest[band];
    if (!(test == DepthTest::less ? least >= greatest : least > greatest)) return false;
  }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#endif  // RASTERCHECK_TILE_SPANS_INL_H_
