// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// The first half of a group's set-up: the triangles' bounds, visibility and boxes.
// Included once for each SIMD target.

#include <array>
#include <cstddef>

#if defined(RASTERCHECK_GROUP_OUTLINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RASTERCHECK_GROUP_OUTLINE_INL_H_
#undef RASTERCHECK_GROUP_OUTLINE_INL_H_
#else
#define RASTERCHECK_GROUP_OUTLINE_INL_H_
#endif

#include "rasterizer/internal/group_lanes-inl.h"
#include "rasterizer/internal/weights.h"

HWY_BEFORE_NAMESPACE();
namespace rastercheck::rasterizer {
namespace HWY_NAMESPACE {

/// Error bounds. The first four are relative to the sum of the terms' magnitudes: for a plane of
/// edges (plane.h), a plane of snapped vertices' weights (weights.h), a determinant
/// (determinant.cpp) and the numerator of a window coordinate. The last is for the quotient of that
/// numerator and w, in half grid units (grid_position.cpp).
constexpr double kPlaneError = 8 * 0x1p-53;
constexpr double kPlacedPlaneError = 10 * 0x1p-53;
constexpr double kDeterminantError = 8 * 0x1p-53;
constexpr double kNumeratorError = 0x1p-51;
constexpr double kQuotientError = 0x1p-20;

/// The triangles' bounding lines and weights. They are known before samples and values are
/// examined.
struct Outline {
  Edges lines;  ///< lines that bound the triangles; c is multiplied by T
  Three sure;   ///< TriangleNumbers::kSure of the lines
  Three possible;
  Edges edges;  ///< the weights E_i
  Three band;   ///< plane_band of `edges` (plane.h)
  Vector det_t;
  Clip near;
  Clip far;
  Lanes left;      ///< triangles that the kernels leave to the fallback
  Lanes hidden;    ///< hidden triangles, except those in `left`
  Lanes drawable;  ///< of the others, triangles whose coverage the kernels can draw
  Lanes is_whole;  ///< triangles that no depth plane cuts
  Lanes in_front;  ///< triangles with all w > 0
  Extent columns;
  Extent rows;
};

HWY_INLINE Vector TurnedBy(Vector turn, Vector value) { return hn::Xor(value, turn); }

HWY_INLINE Lanes IsCulled(const KernelSetting& setting, Vector turn) {
  const auto zero = hn::Zero(Doubles());
  Lanes culled = Never();
  if (setting.culls_positive) culled = hn::Or(culled, hn::Gt(turn, zero));
  if (setting.culls_negative) culled = hn::Or(culled, hn::Lt(turn, zero));
  return culled;
}

HWY_INLINE Lanes IsEmpty(const Extent& columns, const Extent& rows) {
  return hn::Or(hn::Ge(columns.begin, columns.end), hn::Ge(rows.begin, rows.end));
}

/// Moves the lines to the corners of pixels that decide (conservative_coverage.h), and finds the
/// pixels between the triangles' ends. Returns the triangles that the kernels can draw: no plane
/// cuts them, they do not reach behind the eye, and no vertex may lie at a sample, whose values
/// would have to be the vertex's.
HWY_INLINE Lanes MoveToCorners(const KernelSetting& setting, const Corners& p, const Three& share,
                               Outline& out) {
  const Doubles d;
  const auto two = hn::Set(d, 2.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto reach = hn::Add(hn::Mul(hn::Abs(out.lines.a[i]), hn::Set(d, setting.u_reach)),
                               hn::Mul(hn::Abs(out.lines.b[i]), hn::Set(d, setting.v_reach)));
    out.lines.c[i] = hn::Add(out.lines.c[i], hn::Mul(hn::Set(d, setting.corner_sign), reach));
    // Twice the band covers the roundings of the way, too: it is no longer than S.
    out.sure[i] = hn::Mul(two, out.band[i]);
    out.possible[i] = BeyondBand(out.sure[i]);
  }
  Lanes certain = hn::And(out.in_front, out.is_whole);
  const Three u = PositionsOf(p.x, share, setting.u_middle, setting.u_half);
  const Three v = PositionsOf(p.y, share, setting.v_middle, setting.v_half);
  out.columns =
      PixelsOf(u, p.x, p.w, setting.u_middle, setting.u_half, out.in_front, setting.bounds.columns);
  out.rows =
      PixelsOf(v, p.y, p.w, setting.v_middle, setting.v_half, out.in_front, setting.bounds.rows);
  for (std::size_t i = 0; i < 3; ++i) {
    certain = hn::AndNot(hn::And(IsCentral(u[i]), IsCentral(v[i])), certain);
  }
  return certain;
}

/// The outline of the exact clip positions.
HWY_INLINE Outline ExactOutline(const KernelSetting& setting, const Corners& p) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const auto t = hn::Set(d, setting.t);
  const Three& w = p.w;
  Outline out;
  out.edges = EdgesOf(p);
  const auto determinant = Sum(w, out.edges.c);
  const auto size = SumOfSizes(w, out.edges.c);
  const auto is_above = [&](double share) HWY_ATTR {
    return hn::Gt(hn::Abs(determinant), hn::Mul(hn::Set(d, share), size));
  };
  out.det_t = hn::Mul(hn::Abs(determinant), t);
  const auto turn = hn::And(determinant, hn::SignBit(d));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto a = TurnedBy(turn, out.edges.a[i]);
    const auto b = TurnedBy(turn, out.edges.b[i]);
    const auto c = TurnedBy(turn, out.edges.c[i]);
    out.edges.a[i] = out.lines.a[i] = a;
    out.edges.b[i] = out.lines.b[i] = b;
    out.edges.c[i] = c;
    out.lines.c[i] = hn::Mul(c, t);
    out.band[i] = hn::Mul(hn::Set(d, kPlaneError), GreatestOf(setting, a, b, c));
    out.sure[i] = out.band[i];
    out.possible[i] = BeyondBand(out.band[i]);
  }

  // If all w <= 0, weights E_i >= 0 give no point in front of the eye.
  out.hidden = hn::Or(IsBeside(w, p.x, p.y), IsCulled(setting, determinant));
  out.hidden = hn::Or(out.hidden, All(hn::Le(w[0], zero), hn::Le(w[1], zero), hn::Le(w[2], zero)));
  out.near = ClipBy(Distances(w, p.z, setting.near_w, 1));
  out.far = ClipBy(Distances(w, p.z, 1, -1));
  out.is_whole = hn::FirstN(d, hn::Lanes(d));
  if (setting.clips_depth) {
    out.hidden = hn::Or(out.hidden, hn::Or(out.near.hides, out.far.hides));
    out.is_whole = hn::And(out.near.is_away, out.far.is_away);
  }
  // A triangle that reaches behind the eye may touch any pixel.
  out.in_front = All(hn::Gt(w[0], zero), hn::Gt(w[1], zero), hn::Gt(w[2], zero));
  const Three share{hn::Div(one, w[0]), hn::Div(one, w[1]), hn::Div(one, w[2])};
  out.drawable = hn::FirstN(d, hn::Lanes(d));
  if (setting.corner_sign != 0) {
    out.drawable = MoveToCorners(setting, p, share, out);
  } else {
    out.columns = ExtentOf(setting, out.in_front, p.x, share, setting.u_middle, setting.u_half,
                           setting.bounds.columns);
    out.rows = ExtentOf(setting, out.in_front, p.y, share, setting.v_middle, setting.v_half,
                        setting.bounds.rows);
  }
  out.hidden = hn::Or(out.hidden, IsEmpty(out.columns, out.rows));
  // For hidden triangles, only the sign of the determinant has to be certain.
  out.left = hn::Not(
      hn::Or(is_above(1 / kCertainDeterminant), hn::And(out.hidden, is_above(kDeterminantError))));
  return out;
}

/// Snaps a coordinate to the grid (grid_position.h). Keeps in `certain` only the lanes that are
/// within the guard band and for which double decides the nearest point.
HWY_INLINE Vector SnappedTo(const GridAxis& axis, double half_units, Vector coordinate, Vector w,
                            Lanes& certain) {
  const Doubles d;
  const auto along = hn::Mul(hn::Set(d, axis.slope), coordinate);
  const auto origin = hn::Mul(hn::Set(d, axis.origin), w);
  const auto size = hn::Mul(hn::Set(d, axis.size), w);
  const auto n = hn::Add(hn::Add(along, origin), size);
  const auto sizes = hn::Add(hn::Add(hn::Abs(along), hn::Abs(origin)), hn::Abs(size));
  const auto scale = hn::Set(d, half_units);
  const auto position = hn::Mul(hn::Div(n, w), scale);
  const auto off = hn::Mul(hn::Set(d, kNumeratorError), sizes);
  const auto error = hn::Add(hn::Mul(hn::Div(off, w), scale), hn::Set(d, kQuotientError));
  const auto below = hn::Floor(position);
  const auto rest = hn::Sub(position, below);
  const auto half = hn::Set(d, 0.5);
  const Lanes is_up = hn::Gt(rest, hn::Add(half, error));
  const Lanes is_down = hn::Lt(rest, hn::Sub(half, error));
  const auto most = hn::Set(d, 2.0 * kGuardBand * half_units);
  const Lanes is_near = hn::Lt(hn::Add(hn::Abs(position), error), most);
  certain = hn::And(certain, hn::And(is_near, hn::Or(is_up, is_down)));
  return hn::Add(below, hn::IfThenElseZero(is_up, hn::Set(d, 1.0)));
}

/// The outline of the snapped vertices, with their weights (weights.h, "placed"), for triangles
/// that are not clipped. With at most kMostKernelBits bits, double holds the lines' whole numbers
/// exactly.
HWY_INLINE Outline SnappedOutline(const KernelSetting& setting, const Corners& p) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const Lanes all = hn::FirstN(d, hn::Lanes(d));
  const Three& w = p.w;
  Outline out;
  out.drawable = all;
  out.in_front = All(hn::Gt(w[0], zero), hn::Gt(w[1], zero), hn::Gt(w[2], zero));
  out.near = ClipBy(Distances(w, p.z, setting.near_w, 1));
  out.far = ClipBy(Distances(w, p.z, 1, -1));
  Lanes certain = out.in_front;
  if (setting.clips_depth) {
    certain = hn::And(certain, hn::And(out.near.is_away, out.far.is_away));
  }
  out.is_whole = all;
  Three x;
  Three y;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = SnappedTo(setting.grid.x, setting.units / 2, p.x[i], w[i], certain);
    y[i] = SnappedTo(setting.grid.y, setting.units / 2, p.y[i], w[i], certain);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t q = (i + 1) % 3;
    const std::size_t r = (i + 2) % 3;
    out.lines.a[i] = hn::Sub(y[q], y[r]);
    out.lines.b[i] = hn::Sub(x[r], x[q]);
    out.lines.c[i] = hn::Neg(hn::Add(hn::Mul(out.lines.a[i], x[q]), hn::Mul(out.lines.b[i], y[q])));
  }
  const auto area = hn::Add(hn::Add(hn::Mul(out.lines.a[0], x[0]), hn::Mul(out.lines.b[0], y[0])),
                            out.lines.c[0]);
  out.left = hn::Not(hn::AndNot(hn::Eq(area, zero), certain));
  out.det_t = hn::Abs(area);
  const auto turn = hn::And(area, hn::SignBit(d));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto a = out.lines.a[i] = TurnedBy(turn, out.lines.a[i]);
    const auto b = out.lines.b[i] = TurnedBy(turn, out.lines.b[i]);
    const auto c = out.lines.c[i] = TurnedBy(turn, out.lines.c[i]);
    const auto limit = LimitOf(setting, a, b);
    out.sure[i] = limit;
    out.possible[i] = limit;
    const auto share = hn::Div(one, w[i]);
    out.edges.a[i] = hn::Mul(a, share);
    out.edges.b[i] = hn::Mul(b, share);
    out.edges.c[i] = hn::Mul(c, share);
    out.band[i] = hn::Mul(hn::Set(d, kPlacedPlaneError),
                          GreatestOf(setting, out.edges.a[i], out.edges.b[i], out.edges.c[i]));
  }
  const auto pixels = hn::Set(d, 1 / setting.units);
  const Three to_pixels{pixels, pixels, pixels};
  out.columns = ExtentOf(setting, all, x, to_pixels, 0, 1, setting.bounds.columns);
  out.rows = ExtentOf(setting, all, y, to_pixels, 0, 1, setting.bounds.rows);
  out.hidden = hn::Or(IsCulled(setting, area), IsEmpty(out.columns, out.rows));
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::rasterizer
HWY_AFTER_NAMESPACE();

#endif  // RASTERCHECK_GROUP_OUTLINE_INL_H_
