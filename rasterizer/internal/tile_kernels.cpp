// Compiled once for each SIMD target; the best that the processor has is chosen at run time.

#include "rasterizer/internal/tile_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <type_traits>

#include "rasterizer/internal/group_kernels.h"
#include "rasterizer/internal/masks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rasterizer/internal/tile_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
// At most eight lanes: masks are bytes.
using Doubles = hn::CappedTag<double, 8>;
using Halves = hn::Rebind<float, Doubles>;
using Vector = hn::Vec<Doubles>;
using Numbers = TriangleNumbers;

HWY_INLINE std::uint64_t BitsOf(hn::Mask<Doubles> lanes) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(Doubles(), lanes, bytes.data());
  return bytes[0];
}

/// A plane's numbers.
struct PlaneOf {
  double a;
  double b;
  double c;
};

PlaneOf PlaneAt(const double* numbers, std::size_t at) {
  return {numbers[at], numbers[at + 1], numbers[at + 2]};
}

/// Of each row the columns that are surely within all half-planes.
struct Spans {
  using Columns = std::array<std::int32_t, kTileSize + kTilePadding>;
  alignas(64) Columns begin;
  alignas(64) Columns end;
  std::uint64_t touched = 0;   ///< rows in which there may be samples
  std::uint64_t doubtful = 0;  ///< those where not just the surely covered ones are
  std::uint64_t on_two = 0;    ///< rows with a first or last sample on two edges, and within
};

/// Where a half-plane's line crosses a vector of rows. Its values go up, or down, along a row, so
/// that what is surely within begins, or ends, somewhere: about where the line crosses the limit,
/// and exactly there if the samples on either side of that say so.
struct Crossing {
  Vector after;               ///< the first column after it
  hn::Mask<Doubles> rises;    ///< what is within comes after it
  hn::Mask<Doubles> is_sure;  ///< it is exactly there
  /// The sample outside is surely beyond; where it may be within, so may be all beyond it.
  hn::Mask<Doubles> is_far;
  hn::Mask<Doubles> is_on;  ///< the sample within is exactly on the line
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
  // Samples on a line without a band are within where its limit is below 0. A crossing at such
  // a sample is exact, as its quotient is whole.
  const auto at_first = hn::Add(hn::Mul(a, u_first), row);
  const auto exact = hn::Div(hn::Sub(hn::Max(sure, zero), at_first), slope);
  const auto rises = hn::Gt(slope, zero);
  // Where what is at the crossing comes after it; else it comes before.
  const auto is_before = hn::Not(hn::Xor(rises, hn::Lt(sure, zero)));
  auto crossing = hn::IfThenElse(is_before, hn::Sub(hn::Ceil(exact), one), hn::Floor(exact));
  const auto of_level = hn::IfThenElse(hn::Gt(row, sure), last, first);
  crossing = hn::IfThenElse(hn::Eq(slope, zero), of_level, crossing);
  // The samples on either side, where they are in the part.
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

/// The spans of a part that half-planes cut.
HWY_INLINE void FindSpans(const KernelSetting& setting, const double* numbers, std::uint64_t cuts,
                          const TileArea& area, const TilePart& part, Spans& spans) {
  const Doubles d;
  const hn::Rebind<std::int32_t, Doubles> ints;
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
      if (index < 3) {
        on_two = hn::Or(on_two, hn::And(on_one, at.is_on));
        on_one = hn::Or(on_one, at.is_on);
      }
    }
    hn::StoreU(hn::DemoteTo(ints, begin), ints, spans.begin.data() + y);
    hn::StoreU(hn::DemoteTo(ints, end), ints, spans.end.data() + y);
    const auto is_same = hn::And(hn::Eq(begin, possible_begin), hn::Eq(end, possible_end));
    const auto of_lanes = (std::uint64_t{1} << hn::Lanes(d)) - 1;
    spans.touched |= BitsOf(hn::Gt(possible_end, possible_begin)) << y;
    spans.doubtful |= (~BitsOf(hn::And(is_same, is_sure)) & of_lanes) << y;
    spans.on_two |= BitsOf(on_two) << y;
  }
  const int rows = part.rows.end - part.rows.begin;
  spans.touched &= ~std::uint64_t{0} >> (kTileSize - rows) << part.rows.begin;
  spans.doubtful &= spans.touched;
}

#if HWY_TARGET <= HWY_AVX3
constexpr bool kStoresMasked = true;
#else
constexpr bool kStoresMasked = false;
#endif

/// Replaces what `lanes` says.
HWY_INLINE void PutWhere(hn::Mask<Halves> lanes, hn::Vec<Halves> value, float* out) {
  const Halves floats;
  if (kStoresMasked) {
    hn::BlendedStore(value, lanes, floats, out);
  } else {
    hn::StoreU(hn::IfThenElse(lanes, value, hn::LoadU(floats, out)), floats, out);
  }
}

/// What is the same along each row: B V + C of a plane.
struct RowsOf {
  alignas(64) std::array<double, kTileSize + kTilePadding> at;
};

HWY_INLINE void SetRows(const PlaneOf& plane, const TileArea& area, const TilePart& part,
                        RowsOf& rows) {
  const Doubles d;
  for (int y = part.rows.begin; y < part.rows.end; y += static_cast<int>(hn::Lanes(d))) {
    const auto v = hn::LoadU(d, area.v + y);
    hn::StoreU(hn::Add(hn::Mul(hn::Set(d, plane.b), v), hn::Set(d, plane.c)), d,
               rows.at.data() + y);
  }
}

/// In place of a mask: all lanes.
struct Everywhere {};

/// Draws samples of a triangle, with `kAttributes` attributes, or as many as the setting says where
/// it is 0. `kPlain`: all attributes are smooth, and depth is tested.
template <std::size_t kAttributes, bool kPlain>
class Shader {
 public:
  HWY_INLINE Shader(const KernelSetting& setting, const double* numbers, const TileArea& area,
                    const TilePart& part)
      : setting_(setting), part_(part), u_(area.u), depth_(area.depth) {
    const PlaneOf sum{numbers[Numbers::kA + Numbers::kDenominator],
                      numbers[Numbers::kB + Numbers::kDenominator],
                      numbers[Numbers::kC + Numbers::kDenominator]};
    const PlaneOf depth = PlaneAt(numbers, Numbers::kDepth);
    if (HasSmooth()) SetRows(sum, area, part, sum_rows_);
    SetRows(depth, area, part, depth_rows_);
    sum_a_ = sum.a;
    depth_a_ = depth.a;
    for (std::size_t a = 0; a < Count(); ++a) {
      const PlaneOf value = PlaneAt(numbers, Numbers::kValues + 3 * a);
      SetRows(value, area, part, value_rows_[a]);
      value_a_[a] = IsFlat(a) ? value.c : value.a;
      values_[a] = area.attributes[a];
    }
  }

  /// Rows of the part, each from spans.begin to spans.end.
  HWY_INLINE void ShadeSpans(const Spans& spans, std::uint64_t rows) const {
    const Halves floats;
    for (; rows != 0; rows &= rows - 1) {
      const auto y = static_cast<std::size_t>(std::countr_zero(rows));
      const std::int32_t end = spans.end[y];
      for (std::int32_t x = spans.begin[y]; x < end; x += kLanes) {
        const auto within = hn::FirstN(floats, static_cast<std::size_t>(end - x));
        Shade<true>(AlongColumns(x), y, x, within);
      }
    }
  }

  /// All of the part: column by column, as what is the same along them are vectors. `kClamps`: a
  /// depth may be out of range.
  template <bool kClamps>
  HWY_INLINE void ShadeAll() const {
    const Halves floats;
    for (std::int32_t x = part_.columns.begin; x < part_.columns.end; x += kLanes) {
      const Along along = AlongColumns(x);
      const std::int32_t rest = part_.columns.end - x;
      if (rest >= kLanes) {
        ShadeColumns<kClamps>(along, x, Everywhere());
      } else {
        ShadeColumns<true>(along, x, hn::FirstN(floats, static_cast<std::size_t>(rest)));
      }
    }
  }

 private:
  static constexpr std::int32_t kLanes = hn::MaxLanes(Doubles());
  static constexpr std::size_t kMost = kAttributes == 0 ? kMaxAttributes : kAttributes;

  /// A U of the planes, for a vector of columns.
  struct Along {
    Vector depth;
    Vector sum;
    std::array<Vector, kMost> values;
  };

  HWY_INLINE std::size_t Count() const {
    return kAttributes == 0 ? setting_.attributes : kAttributes;
  }
  HWY_INLINE bool HasSmooth() const { return kPlain || setting_.has_smooth; }
  HWY_INLINE bool TestsDepth() const { return kPlain || setting_.tests_depth; }
  HWY_INLINE bool IsFlat(std::size_t a) const {
    return !kPlain && setting_.interpolation[a] == Interpolation::flat;
  }
  HWY_INLINE bool IsSmooth(std::size_t a) const {
    return kPlain || setting_.interpolation[a] == Interpolation::smooth;
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
  HWY_INLINE void ShadeColumns(const Along& along, std::int32_t x, const Within& within) const {
    const auto end = static_cast<std::size_t>(part_.rows.end);
    for (auto y = static_cast<std::size_t>(part_.rows.begin); y < end; ++y) {
      Shade<kClamps>(along, y, x, within);
    }
  }

  /// Those `within` of a vector of samples, from column x of row y.
  template <bool kClamps, typename Within>
  HWY_INLINE void Shade(const Along& along, std::size_t y, std::int32_t x,
                        const Within& within) const {
    const Doubles d;
    const Halves floats;
    const std::size_t at = y * kTileSize + static_cast<std::size_t>(x);
    auto value = hn::Add(along.depth, hn::Set(d, depth_rows_.at[y]));
    if (kClamps) {
      value = hn::Min(hn::Max(value, hn::Set(d, setting_.depth_least)),
                      hn::Set(d, setting_.depth_greatest));
    }
    const auto depth = hn::DemoteTo(floats, value);
    auto mask = hn::FirstN(floats, hn::Lanes(floats));
    if constexpr (!std::is_same_v<Within, Everywhere>) mask = within;
    if (TestsDepth()) {
      const auto is_nearer = hn::Lt(depth, hn::LoadU(floats, depth_ + at));
      mask = std::is_same_v<Within, Everywhere> ? is_nearer : hn::And(mask, is_nearer);
      if (std::is_same_v<Within, Everywhere> && hn::AllFalse(floats, mask)) return;
    }
    // Nothing needs to be fetched where all is replaced.
    const bool is_all =
        !kStoresMasked && std::is_same_v<Within, Everywhere> && hn::AllTrue(floats, mask);
    const auto put = [&](hn::Vec<Halves> values, float* out) HWY_ATTR {
      if (is_all) {
        hn::StoreU(values, floats, out + at);
      } else {
        PutWhere(mask, values, out + at);
      }
    };
    put(depth, depth_);
    auto reciprocal = hn::Zero(d);
    if (HasSmooth()) {
      const auto sum = hn::Add(along.sum, hn::Set(d, sum_rows_.at[y]));
      reciprocal = hn::Div(hn::Set(d, 1.0), sum);
    }
    for (std::size_t a = 0; a < Count(); ++a) {
      auto result = hn::Set(d, value_a_[a]);
      if (!IsFlat(a)) result = hn::Add(along.values[a], hn::Set(d, value_rows_[a].at[y]));
      if (IsSmooth(a)) result = hn::Mul(result, reciprocal);
      put(hn::DemoteTo(floats, result), values_[a]);
    }
  }

  const KernelSetting& setting_;
  const TilePart part_;
  const double* const u_;
  float* const depth_;
  double sum_a_;
  double depth_a_;
  std::array<double, kMost> value_a_;  ///< or, where it is flat, the value
  std::array<float*, kMost> values_;
  RowsOf sum_rows_;
  RowsOf depth_rows_;
  std::array<RowsOf, kMost> value_rows_;
};

/// Takes the sample at a vertex out of a row's span: one on two edges, the first or the last.
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

/// How a triangle's half-planes lie to a part of a tile: those that cut it, or that one has none of
/// it. A line's least and greatest values there are at corners (plane.h).
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
    // The vector may go beyond the last of them.
    const auto those = hn::FirstN(d, Numbers::kHalfPlanes - i);
    const auto beside = hn::And(those, hn::Not(hn::Gt(greatest, possible)));
    const auto within = hn::Gt(least, hn::Max(sure, hn::Zero(d)));
    position.is_beside = position.is_beside || BitsOf(beside) != 0;
    position.cuts |= BitsOf(hn::AndNot(within, those)) << i;
  }
  return position;
}

void FindGreatest(const float* depth, std::span<float, kBands> greatest) {
  const Floats d;
  constexpr std::size_t kBandPixels = std::size_t{kBandSize} * kTileSize;
  for (std::size_t band = 0; band < kBands; ++band) {
    // NaNs are passed over: nothing is nearer than they are. Several at once, none of which has to
    // wait for another.
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

/// The least and the greatest depth of a part, before they are clamped: corners' (plane.h).
struct Depths {
  double least;
  double greatest;
};

HWY_INLINE Depths DepthsOf(const double* numbers, const TileArea& area, const TilePart& part) {
  const PlaneOf plane = PlaneAt(numbers, Numbers::kDepth);
  const auto [u_least, u_greatest] =
      std::minmax({plane.a * area.u[part.columns.begin], plane.a * area.u[part.columns.end - 1]});
  const auto [v_least, v_greatest] =
      std::minmax({plane.b * area.v[part.rows.begin], plane.b * area.v[part.rows.end - 1]});
  return {u_least + (v_least + plane.c), u_greatest + (v_greatest + plane.c)};
}

/// Whether what is there is nowhere behind any of the triangle: neither is it where double is left
/// to decide, as its depth is this plane's everywhere. Clamping and rounding are monotone too.
bool IsBehind(const KernelSetting& setting, const Depths& depths, const TileArea& area,
              const TilePart& part) {
  if (!setting.tests_depth) return false;
  const auto least = static_cast<float>(
      std::min(std::max(depths.least, setting.depth_least), setting.depth_greatest));
  for (int band = part.rows.begin / kBandSize; band * kBandSize < part.rows.end; ++band) {
    if (!(least >= area.greatest[band])) return false;
  }
  return true;
}

Undrawn ShadeTriangle(const KernelSetting& setting, const double* numbers, const TileArea& area,
                      const TilePart& part) {
  const Position position = PositionOf(numbers, area, part);
  if (position.is_beside) return {};
  const Depths depths = DepthsOf(numbers, area, part);
  if (IsBehind(setting, depths, area, part)) return {};
  Spans spans;
  if (position.cuts != 0) FindSpans(setting, numbers, position.cuts, area, part, spans);
  const std::uint64_t rows = spans.touched & ~spans.doubtful;
  Undrawn undrawn;
  undrawn.rows = spans.doubtful;
  for_each_bit(spans.on_two & rows, [&](int y) { TakeVertices(numbers, area, y, spans, undrawn); });
  const auto shade = [&](auto attributes, auto is_plain) {
    const Shader<decltype(attributes)::value, decltype(is_plain)::value> shader(setting, numbers,
                                                                                area, part);
    if (position.cuts != 0) {
      shader.ShadeSpans(spans, rows);
    } else if (depths.least >= setting.depth_least && depths.greatest <= setting.depth_greatest) {
      shader.template ShadeAll<false>();
    } else {
      shader.template ShadeAll<true>();
    }
  };
  using Many = std::integral_constant<std::size_t, 0>;
  if (!setting.is_plain) {
    shade(Many(), std::false_type());
  } else if (setting.attributes == 1) {
    shade(std::integral_constant<std::size_t, 1>(), std::true_type());
  } else if (setting.attributes == 2) {
    shade(std::integral_constant<std::size_t, 2>(), std::true_type());
  } else if (setting.attributes == 4) {
    shade(std::integral_constant<std::size_t, 4>(), std::true_type());
  } else {
    shade(Many(), std::true_type());
  }
  return undrawn;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::rasterizer {

HWY_EXPORT(ShadeTriangle);
HWY_EXPORT(FindGreatest);

void find_greatest(const float* depth, std::span<float, kBands> greatest) {
  HWY_DYNAMIC_DISPATCH(FindGreatest)(depth, greatest);
}

Undrawn shade_triangle(const KernelSetting& setting, const double* numbers, const TileArea& area,
                       const TilePart& part) {
  return HWY_DYNAMIC_DISPATCH(ShadeTriangle)(setting, numbers, area, part);
}

namespace {

/// `kAttributes` of them, or as many as the setting says where it is 0.
template <std::size_t kAttributes>
void put_fragments_of(const KernelSetting& setting, std::span<const std::uint32_t> words,
                      const TileArea& area) {
  const std::size_t attributes = kAttributes == 0 ? setting.attributes : kAttributes;
  for (std::size_t at = 0; at < words.size(); at += 2 + attributes) {
    // All is written, what stays as well: which of them are kept no processor foresees.
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
  const auto depth =
      static_cast<float>(std::min(std::max(value, setting.depth_least), setting.depth_greatest));
  const int place = sample.row * kTileSize + sample.column;
  if (setting.tests_depth && !(depth < area.depth[place])) return;
  area.depth[place] = depth;
  for (std::size_t a = 0; a < setting.attributes; ++a) {
    const bool is_flat = setting.interpolation[a] == Interpolation::flat;
    const auto flat = static_cast<float>(numbers[TriangleNumbers::kValues + 3 * a + 2]);
    area.attributes[a][place] = is_flat ? flat : values[a] + 0.0F;  // an exact sum is not −0
  }
}

void put_fragments(const KernelSetting& setting, std::span<const std::uint32_t> words,
                   const TileArea& area) {
  if (setting.attributes == 2) return put_fragments_of<2>(setting, words, area);
  put_fragments_of<0>(setting, words, area);
}

}  // namespace rastercheck::rasterizer
#endif  // HWY_ONCE
