// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Triangles in the lanes of vectors, for the group kernels: corners, edges, planes, and the storage
// of their numbers. Included once per SIMD target, as Highway requires.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#if defined(RASTERCHECK_GROUP_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_GROUP_LANES_INL_H_
#undef RASTERCHECK_GROUP_LANES_INL_H_
#else
#define RASTERCHECK_GROUP_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "rasterizer/internal/group_kernels.h"
#include "rasterizer/internal/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

static_assert(hn::MaxLanes(Doubles()) <= kGroup);

using Bits = hn::Vec<Words>;
using Lanes = hn::Mask<Doubles>;
using Three = std::array<Vector, 3>;
using Numbers = TriangleNumbers;

HWY_INLINE Lanes Never() { return hn::FirstN(Doubles(), 0); }

/// a AND b AND c.
HWY_INLINE Lanes All(Lanes a, Lanes b, Lanes c) { return hn::And(hn::And(a, b), c); }

/// The part of a group that one vector holds: the lanes from `from` on.
struct Part {
  std::size_t from = 0;
  GroupOutput* output = nullptr;

  HWY_INLINE void Put(std::size_t number, Vector value) const {
    hn::Store(value, Doubles(), output->numbers[number].data() + from);
  }
  HWY_INLINE Vector Get(std::size_t number) const {
    return hn::Load(Doubles(), output->numbers[number].data() + from);
  }
};

/// Clip positions, [vertex].
struct Corners {
  Three x;
  Three y;
  Three z;
  Three w;
};

HWY_INLINE Corners LoadCorners(const GroupInput& input, std::size_t from) {
  const Doubles d;
  Corners p;
  for (std::size_t i = 0; i < 3; ++i) {
    hn::Vec<Halves> x;
    hn::Vec<Halves> y;
    hn::Vec<Halves> z;
    hn::Vec<Halves> w;
    hn::LoadInterleaved4(Halves(), &input.positions[i][from].x, x, y, z, w);
    p.x[i] = hn::PromoteTo(d, x);
    p.y[i] = hn::PromoteTo(d, y);
    p.z[i] = hn::PromoteTo(d, z);
    p.w[i] = hn::PromoteTo(d, w);
  }
  return p;
}

/// Lanes whose coordinates are all finite: infinity or NaN times 0 is not 0.
HWY_INLINE Lanes AreFinite(const Corners& p) {
  const auto zero = hn::Zero(Doubles());
  auto sum = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto terms = hn::Add(hn::Add(p.x[i], p.y[i]), hn::Add(p.z[i], p.w[i]));
    sum = hn::Add(sum, hn::Mul(zero, terms));
  }
  return hn::Eq(sum, zero);
}

/// Lanes where two corners are equal except for z, so that the determinant is 0.
HWY_INLINE Lanes HaveTwins(const Corners& p) {
  const auto are_same = [&p](std::size_t q, std::size_t r) HWY_ATTR {
    return All(hn::Eq(p.x[q], p.x[r]), hn::Eq(p.y[q], p.y[r]), hn::Eq(p.w[q], p.w[r]));
  };
  return hn::Or(are_same(0, 1), hn::Or(are_same(1, 2), are_same(2, 0)));
}

/// The edges' coefficients, before the sign of the orientation is applied.
struct Edges {
  Three a;
  Three b;
  Three c;
};

HWY_INLINE Edges EdgesOf(const Corners& p) {
  Edges edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t q = (i + 1) % 3;
    const std::size_t r = (i + 2) % 3;
    edges.a[i] = hn::Sub(hn::Mul(p.y[q], p.w[r]), hn::Mul(p.w[q], p.y[r]));
    edges.b[i] = hn::Sub(hn::Mul(p.w[q], p.x[r]), hn::Mul(p.x[q], p.w[r]));
    edges.c[i] = hn::Sub(hn::Mul(p.x[q], p.y[r]), hn::Mul(p.y[q], p.x[r]));
  }
  return edges;
}

/// (k_0 t_0 + k_1 t_1) + k_2 t_2.
HWY_INLINE Vector Sum(const Three& k, const Three& t) {
  return hn::Add(hn::Add(hn::Mul(k[0], t[0]), hn::Mul(k[1], t[1])), hn::Mul(k[2], t[2]));
}

HWY_INLINE Vector SumOfSizes(const Three& k, const Three& t) {
  return hn::Add(hn::Add(hn::Abs(hn::Mul(k[0], t[0])), hn::Abs(hn::Mul(k[1], t[1]))),
                 hn::Abs(hn::Mul(k[2], t[2])));
}

/// Plane (plane.h) in every lane.
struct PlaneLanes {
  Vector a;
  Vector b;
  Vector c;
};

/// plane_of (plane.h).
HWY_INLINE PlaneLanes Collect(const Edges& edges, const Three& k, Vector t, Vector scale,
                              Vector offset) {
  return {hn::Mul(Sum(k, edges.a), scale), hn::Mul(Sum(k, edges.b), scale),
          hn::Add(hn::Mul(hn::Mul(Sum(k, edges.c), t), scale), offset)};
}

/// Replaces the plane by a constant in some lanes.
HWY_INLINE PlaneLanes Constant(Lanes lanes, Vector constant, const PlaneLanes& plane) {
  return {hn::IfThenZeroElse(lanes, plane.a), hn::IfThenZeroElse(lanes, plane.b),
          hn::IfThenElse(lanes, constant, plane.c)};
}

HWY_INLINE void PutPlane(const Part& part, std::size_t number, const PlaneLanes& plane) {
  part.Put(number, plane.a);
  part.Put(number + 1, plane.b);
  part.Put(number + 2, plane.c);
}

HWY_INLINE void PutHalfPlane(const Part& part, std::size_t index, const PlaneLanes& plane,
                             Vector sure, Vector possible) {
  part.Put(Numbers::kA + index, plane.a);
  part.Put(Numbers::kB + index, plane.b);
  part.Put(Numbers::kC + index, plane.c);
  part.Put(Numbers::kSure + index, sure);
  part.Put(Numbers::kPossible + index, possible);
}

/// The double just below −band.
HWY_INLINE Vector BeyondBand(Vector band) {
  const Words words;
  return hn::Neg(
      hn::BitCast(Doubles(), hn::Add(hn::BitCast(words, band), hn::Set(words, std::uint64_t{1}))));
}

/// How the triangles lie relative to a clip plane. The signs of the corners' distances decide most
/// cases.
struct Clip {
  Three g;        ///< the corners' distances
  Lanes hides;    ///< the whole triangle is beyond the plane
  Lanes is_away;  ///< no part of the triangle is beyond the plane
};

HWY_INLINE Clip ClipBy(const Three& g) {
  const auto zero = hn::Zero(Doubles());
  return {g, All(hn::Lt(g[0], zero), hn::Lt(g[1], zero), hn::Lt(g[2], zero)),
          All(hn::Ge(g[0], zero), hn::Ge(g[1], zero), hn::Ge(g[2], zero))};
}

/// The distances add · w + times · k of each corner.
HWY_INLINE Three Distances(const Three& w, const Three& k, double add, double times) {
  const Doubles d;
  Three g;
  for (std::size_t i = 0; i < 3; ++i) {
    g[i] = hn::Add(hn::Mul(hn::Set(d, add), w[i]), hn::Mul(hn::Set(d, times), k[i]));
  }
  return g;
}

/// Lanes whose corners are all beyond one side of the viewport. Every point with weights E_i >= 0
/// is then beyond that side, too.
HWY_INLINE Lanes IsBeside(const Three& w, const Three& x, const Three& y) {
  return hn::Or(hn::Or(ClipBy(Distances(w, x, 1, 1)).hides, ClipBy(Distances(w, x, 1, -1)).hides),
                hn::Or(ClipBy(Distances(w, y, 1, 1)).hides, ClipBy(Distances(w, y, 1, -1)).hides));
}

/// Stores the half-plane of a depth plane. The corners' distances are rounded once, and planes of
/// exact edges are rounded as often as other planes. Twice the error bound of plane.h covers both.
HWY_INLINE void PutClip(const Part& part, std::size_t index, const Clip& clip, const Edges& edges,
                        const Three& band, Vector t) {
  const Doubles d;
  const auto one = hn::Set(d, 1.0);
  const auto zero = hn::Zero(d);
  const auto error = hn::Mul(hn::Set(d, 2.0), SumOfSizes(clip.g, band));
  const PlaneLanes plane = Constant(clip.is_away, one, Collect(edges, clip.g, t, one, zero));
  PutHalfPlane(part, index, plane, hn::IfThenZeroElse(clip.is_away, error),
               hn::IfThenZeroElse(clip.is_away, BeyondBand(error)));
}

/// A range of pixels along one axis.
struct Extent {
  Vector begin;
  Vector end;
};

/// The pixels whose samples lie within the extent of the corners (`clip` times `share`), enlarged
/// by 2^-20 on each side. That is far more than the error of window positions near the target.
HWY_INLINE Extent ExtentOf(const KernelSetting& setting, Lanes in_front, const Three& clip,
                           const Three& share, double middle, double half,
                           const PixelRange& bounds) {
  const Doubles d;
  Three at;
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = hn::Add(hn::Set(d, middle), hn::Mul(hn::Set(d, half), hn::Mul(clip[i], share[i])));
  }
  const auto low = hn::Min(hn::Min(at[0], at[1]), at[2]);
  const auto high = hn::Max(hn::Max(at[0], at[1]), at[2]);
  constexpr double kMargin = 0x1p-20;
  const auto begin = hn::Ceil(hn::Sub(low, hn::Set(d, setting.greatest_offset + kMargin)));
  const auto end = hn::Add(hn::Floor(hn::Add(high, hn::Set(d, kMargin - setting.least_offset))),
                           hn::Set(d, 1.0));
  const auto least = hn::Set(d, static_cast<double>(bounds.begin));
  const auto most = hn::Set(d, static_cast<double>(bounds.end));
  return {hn::IfThenElse(in_front, hn::Min(hn::Max(begin, least), most), least),
          hn::IfThenElse(in_front, hn::Min(hn::Max(end, least), most), most)};
}

/// The window positions of the corners (`clip` times `share`) along one axis.
HWY_INLINE Three PositionsOf(const Three& clip, const Three& share, double middle, double half) {
  const Doubles d;
  Three at;
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = hn::Add(hn::Set(d, middle), hn::Mul(hn::Set(d, half), hn::Mul(clip[i], share[i])));
  }
  return at;
}

/// The pixels from ⌊least⌋ to ⌈greatest⌉ of the positions `at`, for conservative coverage. An error
/// of 2^-20 is far more than that of a position near the target. A position within it of a whole
/// number n is compared with n exactly: x 2 half against w 2 (n − middle), two products that double
/// holds in a viewport on a grid of 1/256 pixel (sample_frame.h).
HWY_INLINE Extent PixelsOf(const Three& at, const Three& clip, const Three& w, double middle,
                           double half, Lanes in_front, const PixelRange& bounds) {
  const Doubles d;
  const auto margin = hn::Set(d, 0x1p-20);
  const auto one = hn::Set(d, 1.0);
  Three floors;
  Three ceils;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto whole = hn::Round(at[i]);
    const auto position = hn::Mul(clip[i], hn::Set(d, 2 * half));
    const auto twice = hn::Mul(hn::Set(d, 2.0), hn::Sub(whole, hn::Set(d, middle)));
    const auto limit = hn::Mul(w[i], twice);
    const Lanes is_near = hn::Le(hn::Abs(hn::Sub(at[i], whole)), margin);
    const auto below = hn::IfThenElse(hn::Lt(position, limit), hn::Sub(whole, one), whole);
    const auto above = hn::IfThenElse(hn::Gt(position, limit), hn::Add(whole, one), whole);
    floors[i] = hn::IfThenElse(is_near, below, hn::Floor(at[i]));
    ceils[i] = hn::IfThenElse(is_near, above, hn::Ceil(at[i]));
  }
  const auto begin = hn::Min(hn::Min(floors[0], floors[1]), floors[2]);
  const auto end = hn::Max(hn::Max(ceils[0], ceils[1]), ceils[2]);
  const auto least = hn::Set(d, static_cast<double>(bounds.begin));
  const auto most = hn::Set(d, static_cast<double>(bounds.end));
  // A triangle that reaches behind the eye may touch any pixel.
  return {hn::IfThenElse(in_front, hn::Min(hn::Max(begin, least), most), least),
          hn::IfThenElse(in_front, hn::Min(hn::Max(end, least), most), most)};
}

/// Lanes where a position may be a pixel's centre along an axis.
HWY_INLINE Lanes IsCentral(Vector at) {
  const Doubles d;
  const auto part = hn::Sub(at, hn::Floor(at));
  return hn::Le(hn::Abs(hn::Sub(part, hn::Set(d, 0.5))), hn::Set(d, 0x1p-20));
}

/// The lowest set bit of |v| as a number; infinite for 0.
HWY_INLINE Vector LowestBit(Vector v) {
  const Doubles d;
  const Words words;
  const auto bits = hn::BitCast(words, v);
  const auto fraction = hn::And(bits, hn::Set(words, (std::uint64_t{1} << 52) - 1));
  const auto cleared = hn::BitCast(d, hn::And(bits, hn::Sub(bits, hn::Set(words, 1))));
  const Lanes is_power = hn::RebindMask(d, hn::Eq(fraction, hn::Zero(words)));
  const auto lowest = hn::Abs(hn::IfThenElse(is_power, v, hn::Sub(v, cleared)));
  return hn::IfThenElse(hn::Eq(v, hn::Zero(d)), hn::Set(d, std::numeric_limits<double>::infinity()),
                        lowest);
}

/// Lanes where p q − r t is computed without rounding.
HWY_INLINE Lanes IsExact(Vector p, Vector q, Vector r, Vector t) {
  const auto x = hn::Mul(p, q);
  const auto y = hn::Mul(r, t);
  const auto difference = hn::Sub(x, y);
  const auto back = hn::Sub(x, difference);
  const auto error = hn::Add(hn::Sub(x, hn::Add(difference, back)), hn::Sub(back, y));
  return hn::Eq(error, hn::Zero(Doubles()));
}

/// S_i for an edge (edge_functions.h).
HWY_INLINE Vector GreatestOf(const KernelSetting& setting, Vector a, Vector b, Vector c) {
  const Doubles d;
  return hn::Add(hn::Add(hn::Mul(hn::Abs(a), hn::Set(d, setting.u_greatest)),
                         hn::Mul(hn::Abs(b), hn::Set(d, setting.v_greatest))),
                 hn::Mul(hn::Abs(c), hn::Set(d, setting.t)));
}

/// The limit of an edge without a band. By the fill rule, a sample is inside the edge if its value
/// is above the limit.
HWY_INLINE Vector LimitOf(const KernelSetting& setting, Vector a, Vector b) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  // Pixels are open squares for outer, closed ones for inner coverage.
  if (setting.corner_sign > 0) return zero;
  if (setting.corner_sign < 0) return hn::Set(d, -std::numeric_limits<double>::denorm_min());
  const auto along_u = hn::Mul(a, hn::Set(d, setting.u_owner));
  const auto along_v = hn::Mul(b, hn::Set(d, setting.v_owner));
  const auto owns = hn::Or(hn::Gt(along_u, zero), hn::And(hn::Eq(a, zero), hn::Gt(along_v, zero)));
  return hn::IfThenElseZero(owns, hn::Set(d, -std::numeric_limits<double>::denorm_min()));
}

/// Sets the limits of edges that are computed without rounding (is_exact of edge_functions.cpp).
/// Returns true if at least one edge is exact.
HWY_INLINE bool SetExactLimits(const KernelSetting& setting, const Part& part, const Corners& p) {
  const Doubles d;
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t q = (i + 1) % 3;
    const std::size_t r = (i + 2) % 3;
    const auto a = part.Get(Numbers::kA + i);
    const auto b = part.Get(Numbers::kB + i);
    const auto c = hn::Sub(hn::Mul(p.x[q], p.y[r]), hn::Mul(p.y[q], p.x[r]));
    auto exact =
        All(IsExact(p.y[q], p.w[r], p.w[q], p.y[r]), IsExact(p.w[q], p.x[r], p.x[q], p.w[r]),
            IsExact(p.x[q], p.y[r], p.y[q], p.x[r]));
    const auto grain = hn::Min(hn::Min(hn::Mul(LowestBit(a), hn::Set(d, setting.u_grain)),
                                       hn::Mul(LowestBit(b), hn::Set(d, setting.v_grain))),
                               hn::Mul(LowestBit(c), hn::Set(d, setting.t_grain)));
    // The way to a pixel's corner may double the row.
    const auto times = hn::Set(d, setting.corner_sign == 0 ? 2.0 : 4.0);
    const auto twice = hn::Mul(times, GreatestOf(setting, a, b, c));
    exact = hn::And(exact, hn::Lt(twice, hn::Mul(grain, hn::Set(d, 0x1p53))));
    if (BitsOf(d, exact) == 0) continue;
    any = true;
    const auto limit = LimitOf(setting, a, b);
    part.Put(Numbers::kSure + i, hn::IfThenElse(exact, limit, part.Get(Numbers::kSure + i)));
    part.Put(Numbers::kPossible + i,
             hn::IfThenElse(exact, limit, part.Get(Numbers::kPossible + i)));
  }
  return any;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#endif  // RASTERCHECK_GROUP_LANES_INL_H_
