#pragma once

// What methods share that clip polygons in clip space and scan-convert what is left of them, steps
// 1 to 5 of the algorithm of seed 002 §3.5: what is covered, depth, all attributes but smooth ones,
// and where each is evaluated. A method is a formula: what it puts at a window vertex (step 4), how
// that runs along edges and along spans, and how the value of an attribute comes out of it (step
// 5). A formula is a class template of the number type, so that its operations can be counted
// (counted.h).
//
// Depth z / w is affine in window space as it is (seed 002 §3.2, α x + β y + γ). An attribute
// declared `noperspective` is affine in window space by definition; r_i w is then what is linear in
// clip space, and s_i = (r_i w) / w, so that clipping does not change it.
//
// Window positions. With the viewport (x0, y0, W, H):
//   u = (x W/2 + w (x0 + W/2)) / w     v = (±y H/2 + w (y0 + H/2)) / w     (− for D3D)
// Row v of the target is displayed below the others where v points down (Vulkan, D3D), above where
// it points up (OpenGL). Depth is n + (f − n) z/w; OpenGL: n + (f − n)(z/w + 1)/2; held to the
// range between n and f, which without depth clamp takes away rounding only.
//
// Facing is the sign of det (X, Y, w), X = u w and Y = v w, which is W H times that of (x, y, w)
// and found exactly (determinant.h); it needs no w > 0. Zero covers nothing and is counted.
//
// Locations. `sample`: where the fragment's sample lies. `center`: on the span of the centre's row
// where that covers the centre, otherwise by the plane of s_i, undefined where s_{n+1} <= 0 there.
// The plane is the whole triangle's, as what clipping left of it may be too thin to carry one. With
// the centre as origin of window space and e_0 = X_1 Y_2 - X_2 Y_1 and so on,
//
//   s_k = (sum of p_ik e_i) / (sum of w_i e_i),   p_ik what is linear in clip space (r, r w, or 1).
//
// No w_i is divided by, so vertices with w <= 0 are no different. `centroid`: the centre where
// every sample of the pixel is drawn (viewport included), otherwise the first sample that is.
//
// Error, first order, u = 2^-53 (rounding to float32, once, comes on top).
//
// Vertices. X and Y have at most two roundings of products and sums and one of the division, so
// they are off by δ <= 2 u (|x W/2w| + |x0 + W/2|) + u |position| pixels; what is divided by w has
// one rounding, relative u.
//
// Crossings. Off by δ_c <= 11 u max|u_end| (convex_scan.h), besides what the errors of the vertices
// move the edge. Coordinates reach 2^10 half widths (clip_polygon.h), so a far end costs up to
// 2^-39 half widths; ends within the target cost some 2^-49 widths.
//
// Means. Along an edge and along a span what is linear is a mean of two ends, five roundings each
// time, so with the rounding at the vertices |δs_i| <= 11 u max|s_i|. To this comes what the places
// contribute: an edge that is off by δ carries the values of a row or column δ away, (|∂s_i/∂u| +
// |∂s_i/∂v|) δ. That has no bound in terms of the triangle's values alone: a sliver d pixels wide
// has derivatives of about the range of its values over d, so they are off by δ/d of that range.
//
// By the plane. δe_0 <= 8 u (|X_1| + |w_1| m) (|Y_2| + |w_2| m) and its mirror, m the distance of
// the centre from the viewport's middle; then |δr_i| <= 2 max|r_i| (sum of |δe_i|) / |sum of e_i|.
//
// Coverage. Wrong only for samples within δ_c, and what the vertices' errors move the edge, of it.
//
// What it does not do: snap positions to a subpixel grid; decide coverage exactly (ties come out
// right where positions lie on a coarse grid, see convex_scan.h, but not always on an edge that
// clipping has cut, whose new end is rounded); draw a triangle that touches a clip plane in one
// point only; keep one whose plane passes through the eye but for roundings, which clipping may
// lose whole; bound its errors.
//
// Triangles with a clip distance that is not finite are counted with those that have such a
// position.

#include <array>
#include <cstddef>
#include <span>

#include "rasterizer/methods/internal/convex_scan.h"
#include "rasterizer/methods/internal/counted.h"
#include "rasterizer/methods/method.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A corner of a polygon after clipping: w > 0, and its smooth attributes.
template <class T>
struct ScanVertex {
  T w{};
  std::span<const T> r = {};
};

/// A formula for smooth attributes, of doubles or of numbers that count.
template <class T>
class ScanFormula {
 public:
  virtual ~ScanFormula() = default;

  /// Once for each polygon, before anything else: its vertices, of `count` attributes.
  virtual void set_polygon(std::span<const ScanVertex<T>> /*vertices*/, std::size_t count) {
    count_ = count;
  }
  /// Step 4: what is interpolated, at a vertex.
  virtual void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const = 0;
  /// Between the ends of an edge.
  virtual void along_edge(const Place<T>& place, const Parameters<T>& a, const Parameters<T>& b,
                          Parameters<T>& s) const = 0;
  /// Once for each span, whose first sample in target and viewport is at `first`, whatever the
  /// scissor: `ends` may become whatever along_span takes.
  virtual void set_span(SpanEnds<T>& /*ends*/, T /*first*/) const {}
  /// At a sample; they come from left to right, a sample possibly more than once.
  virtual void along_span(SpanEnds<T>& ends, T u, Parameters<T>& s) const = 0;
  /// Step 5: `count` attributes.
  virtual void values(const Parameters<T>& s, std::span<T> r) const = 0;

 protected:
  std::size_t count_ = 0;
};

/// A formula whose parameters, `parameter_count()` of them, are interpolated linearly.
template <class T>
class LinearFormula : public ScanFormula<T> {
 public:
  void along_edge(const Place<T>& place, const Parameters<T>& a, const Parameters<T>& b,
                  Parameters<T>& s) const override {
    const Weights<T> weights(place);
    for (std::size_t i = 0; i < parameter_count(); ++i) s[i] = weights.mean(a[i], b[i]);
  }
  void along_span(SpanEnds<T>& ends, T u, Parameters<T>& s) const override {
    const Weights<T> weights({u, ends.left_u, ends.right_u});
    for (std::size_t i = 0; i < parameter_count(); ++i) {
      s[i] = weights.mean(ends.left[i], ends.right[i]);
    }
  }

 protected:
  virtual std::size_t parameter_count() const = 0;
};

/// Of what is linear in the window, whatever the formula: 11 u max|s_i|, and 4 u for each of the
/// 14 planes that may have cut an edge (clip_polygon.h: two products, a difference, a quotient).
/// These 67 u are less than 2^-22 scale ULP, as ulp(m) >= 2^-24 m.
inline constexpr MethodBound kScannedLinearBound{.constant = 0.5 + 0x1p-22};

/// Of quotients r_i = s_i / s_{n+1} of two such, |δr_i| <= (|δs_i| + |r_i| |δs_{n+1}|) / s_{n+1} +
/// u |r_i| <= 135 u max|r_i| g, which is less than 2^-21 g; so centres that are not covered have it
/// where Claim::perspective is claimed.
inline constexpr MethodBound kScannedPerspectiveBound{.constant = 0.5 + 0x1p-22,
                                                      .per_horizon = 0x1p-21};

/// The promise of a formula that claims this of smooth attributes.
constexpr Promise scanned_promise(Claim claims, const MethodBound& smooth) {
  return {.claims = claims,
          .scan = ScanKind::scanned,
          .smooth = smooth,
          .noperspective = kScannedLinearBound};
}

/// Appends the fragments of every triangle. Centres that are not covered have the values of what is
/// claimed. `tap`, unless nullptr, is shown the window vertices of a triangle that is not clipped,
/// and values before they are rounded.
DrawCounts scan_triangles(const State& state, const Mesh& mesh, const TargetSize& size,
                          ScanFormula<double>& formula, Claim claims, Fragments& fragments,
                          MethodTap* tap);

/// DrawFragments of a formula that claims Claim::perspective.
template <template <class> class Formula>
DrawCounts scan_triangles_by(const State& state, const Mesh& mesh, const TargetSize& size,
                             Fragments& fragments, MethodTap* tap) {
  Formula<double> formula;
  return scan_triangles(state, mesh, size, formula, Claim::perspective, fragments, tap);
}

/// Appends the fragments of one polygon, as those of triangle 0: the mesh's vertices in their
/// order, which is convex as seen from the eye and has no attributes but at samples
/// (methods/polygon.h).
DrawCounts scan_polygon(const State& state, const Mesh& mesh, const TargetSize& size,
                        ScanFormula<double>& formula, Fragments& fragments);

/// Method::draw_polygon of a formula.
template <template <class> class Formula>
DrawCounts scan_polygon_by(const State& state, const Mesh& mesh, const TargetSize& size,
                           Fragments& fragments, MethodTap* /*tap*/) {
  Formula<double> formula;
  return scan_polygon(state, mesh, size, formula, fragments);
}

/// Whether clipping takes a part away from a triangle of the mesh: not all of it.
bool is_any_clipped(const State& state, const Mesh& mesh);

/// Method::operations of a formula: a row between two edges of a triangle in perspective, w = 1, 2
/// and 4, with two attributes, and on it the step from a pixel to the next.
template <template <class> class Formula>
OperationCounts count_scan() {
  constexpr std::size_t kCount = 2;
  using Pair = std::array<Counted, kCount>;
  const std::array<Pair, 3> r{Pair{Counted(0.125), Counted(0.25)},
                              Pair{Counted(0.875), Counted(0.375)},
                              Pair{Counted(0.75), Counted(0.625)}};
  const std::array<ScanVertex<Counted>, 3> vertices{
      {{Counted(1), r[0]}, {Counted(2), r[1]}, {Counted(4), r[2]}}};
  Formula<Counted> formula;
  OperationCounts counts;
  counts.per_polygon = count_operations([&] { formula.set_polygon(vertices, kCount); });
  std::array<Parameters<Counted>, 3> at;
  for (std::size_t i = 0; i < 3; ++i) {
    counts.per_vertex = count_operations([&] { formula.set_vertex(vertices[i], at[i]); });
  }
  SpanEnds<Counted> ends{.left_u = Counted(0.25), .right_u = Counted(8.75)};
  counts.per_row = count_operations([&] {
    formula.along_edge({Counted(1.5), Counted(0), Counted(16)}, at[0], at[1], ends.left);
    formula.along_edge({Counted(1.5), Counted(0), Counted(32)}, at[0], at[2], ends.right);
    formula.set_span(ends, Counted(1.5));
  });
  Parameters<Counted> s;
  Pair values;
  formula.along_span(ends, Counted(1.5), s);
  counts.per_pixel = count_operations([&] {
    formula.along_span(ends, Counted(2.5), s);
    formula.values(s, values);
  });
  return counts;
}

}  // namespace rastercheck::rasterizer
