#pragma once

// Shared part of the methods that clip polygons in clip space and scan-convert the result: steps 1
// to 5 of the algorithm of Heckbert & Moreton 1991, §3.5. The code here computes coverage, depth,
// locations, and all attributes except smooth ones. The method supplies a formula, which computes
// its parameters at a window vertex (step 4), interpolates them along edges and along spans, and
// computes attributes from them (step 5). A formula is a class template over the number type, so
// that its operations can be counted (counted.h).
//
// Depth z / w is affine in window space (Heckbert & Moreton 1991, §3.2, α x + β y + γ). An
// attribute declared `noperspective` is affine in window space by definition; then r_i w is linear
// in clip space, and s_i = (r_i w) / w, so that clipping does not change s_i.
//
// Window positions. With the viewport (x0, y0, W, H):
//   u = (x W/2 + w (x0 + W/2)) / w     v = (±y H/2 + w (y0 + H/2)) / w     (− for D3D)
// Row v of the target is displayed below the rows of smaller v if v points down (Vulkan, D3D),
// above them if v points up (OpenGL). Depth is n + (f − n) z/w; OpenGL: n + (f − n)(z/w + 1)/2. It
// is clamped to the range between n and f, which without depth clamp removes only rounding errors.
//
// Facing is the sign of det(X, Y, w), with X = u w and Y = v w. This determinant is ±W H/4 (− for
// D3D) times det(x, y, w), whose sign is computed exactly (determinant.h); w > 0 is not needed. A
// triangle with determinant zero covers nothing and is counted as degenerate.
//
// Locations. `sample`: the fragment's sample. `center`: the centre, interpolated on the span of the
// centre's row if that span covers the centre, otherwise computed from the plane of s_i; undefined
// if 1/w <= 0 there. The plane is that of the whole triangle, because the clipped part may be too
// thin to define one. With the centre as origin of window space and e_0 = X_1 Y_2 - X_2 Y_1 and so
// on,
//
//   s_k = (sum of p_ik e_i) / (sum of w_i e_i),   p_ik linear in clip space (r, r w, or 1).
//
// The formula does not divide by w_i, so vertices with w <= 0 need no special case. `centroid`: the
// centre if every sample of the pixel is drawn (viewport included), otherwise the first drawn
// sample.
//
// Error, first order, u = 2^-53 (rounding to float32, once, comes on top).
//
// Vertices. Window positions have at most two roundings of products and sums and one of the
// division, so their error is δ <= 2 u (|x W/2w| + |x0 + W/2|) + u |position| pixels; quotients by
// w have one rounding, relative u.
//
// Crossings. The error is δ_c <= 11 u max|u_end| (convex_scan.h), besides the edge's displacement
// by the errors of the vertices. Coordinates reach 2^10 half widths (clip_polygon.h), so a far end
// costs up to 2^-39 half widths; ends within the target cost some 2^-49 widths.
//
// Means. Along an edge and along a span a linear value is a mean of two ends, with five roundings
// each time. With the rounding at the vertices, |δs_i| <= 11 u max|s_i|. Errors of positions come
// on top: an edge displaced by δ has values that belong to places δ away, which adds (|∂s_i/∂u| +
// |∂s_i/∂v|) δ. The triangle's values alone do not bound this error: a sliver d pixels wide has
// derivatives of about (range of its values)/d, so the error is δ/d of that range.
//
// By the plane. δe_0 <= 8 u (|X_1| + |w_1| m) (|Y_2| + |w_2| m) plus the same product with 1 and 2
// exchanged, where m is the distance of the centre from the viewport's middle. Then |δr_i| <= 2
// max|r_i| (sum of |δe_i|) / |sum of e_i|.
//
// Coverage. Wrong only for samples closer to an edge than δ_c plus the edge's displacement by the
// errors of the vertices.
//
// Not done here: snapping positions to a subpixel grid; deciding coverage exactly (ties are right
// if positions lie on a coarse grid, see convex_scan.h, but not always on an edge cut by clipping,
// whose new end is rounded); drawing a triangle that touches the clip volume only in one point;
// keeping a triangle whose plane passes through the eye up to rounding (clipping may drop it
// entirely), or bounding its errors.
//
// Triangles with a clip distance that is not finite are counted as discarded_not_finite, like
// those with a position that is not finite.

#include <array>
#include <cstddef>
#include <span>

#include "rasterizer/methods/internal/convex_scan.h"
#include "rasterizer/methods/internal/counted.h"
#include "rasterizer/methods/method.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A corner of a polygon after clipping: w, which is > 0, and its smooth attributes.
template <class T>
struct ScanVertex {
  T w{};
  std::span<const T> r = {};
};

/// A formula for smooth attributes, in doubles or in counting numbers.
template <class T>
class ScanFormula {
 public:
  virtual ~ScanFormula() = default;

  /// Called once for each polygon, before anything else, with its vertices, each with `count`
  /// attributes.
  virtual void set_polygon(std::span<const ScanVertex<T>> /*vertices*/, std::size_t count) {
    count_ = count;
  }
  /// Step 4: computes the interpolated parameters at a vertex.
  virtual void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const = 0;
  /// Interpolates between the ends of an edge.
  virtual void along_edge(const Place<T>& place, const Parameters<T>& a, const Parameters<T>& b,
                          Parameters<T>& s) const = 0;
  /// Called once for each span; `first` is its first sample inside target and viewport, regardless
  /// of the scissor. May turn `ends` into any data that along_span uses.
  virtual void set_span(SpanEnds<T>& /*ends*/, T /*first*/) const {}
  /// Computes the parameters at a sample. Samples come from left to right, possibly repeated.
  virtual void along_span(SpanEnds<T>& ends, T u, Parameters<T>& s) const = 0;
  /// Step 5: computes `count` attributes.
  virtual void values(const Parameters<T>& s, std::span<T> r) const = 0;

 protected:
  std::size_t count_ = 0;
};

/// A formula with `parameter_count()` parameters that are interpolated linearly.
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

/// Bound of values that are linear in the window, for any formula: 11 u max|s_i|, and 4 u for each
/// of the 14 planes that may have cut an edge (clip_polygon.h: two products, a difference, a
/// quotient). These 67 u are less than 2^-22 scale ULP, as ulp(m) >= 2^-24 m.
inline constexpr MethodBound kScannedLinearBound{.constant = 0.5 + 0x1p-22};

/// Bound of quotients r_i = s_i / s_{n+1}, where s_{n+1} = 1/w, of values with the bound above:
/// |δr_i| <= (|δs_i| + |r_i| |δs_{n+1}|) / s_{n+1} + u |r_i| <= 135 u max|r_i| g, which is less
/// than 2^-21 g. With Claim::perspective it also holds for centres that are not covered.
inline constexpr MethodBound kScannedPerspectiveBound{.constant = 0.5 + 0x1p-22,
                                                      .per_horizon = 0x1p-21};

/// Makes the promise of a formula with this claim, and this bound for smooth attributes.
constexpr Promise scanned_promise(Claim claims, const MethodBound& smooth) {
  return {.claims = claims,
          .scan = ScanKind::scanned,
          .smooth = smooth,
          .noperspective = kScannedLinearBound};
}

/// Appends the fragments of every triangle. Centres outside the polygon get the claimed values.
/// `tap`, unless nullptr, records the window vertices of a triangle that is not clipped, and values
/// before rounding.
DrawCounts scan_triangles(const State& state, const Mesh& mesh, const TargetSize& size,
                          ScanFormula<double>& formula, Claim claims, Fragments& fragments,
                          MethodTap* tap);

/// Implements DrawFragments for a formula that claims Claim::perspective.
template <template <class> class Formula>
DrawCounts scan_triangles_by(const State& state, const Mesh& mesh, const TargetSize& size,
                             Fragments& fragments, MethodTap* tap) {
  Formula<double> formula;
  return scan_triangles(state, mesh, size, formula, Claim::perspective, fragments, tap);
}

/// Appends the fragments of one polygon, as those of triangle 0. The polygon consists of the mesh's
/// vertices in order, must be convex as seen from the eye, and may have attributes only at samples
/// (methods/polygon.h).
DrawCounts scan_polygon(const State& state, const Mesh& mesh, const TargetSize& size,
                        ScanFormula<double>& formula, Fragments& fragments);

/// Implements Method::draw_polygon for a formula.
template <template <class> class Formula>
DrawCounts scan_polygon_by(const State& state, const Mesh& mesh, const TargetSize& size,
                           Fragments& fragments, MethodTap* /*tap*/) {
  Formula<double> formula;
  return scan_polygon(state, mesh, size, formula, fragments);
}

/// True if clipping removes a part, but not all, of some triangle of the mesh.
bool is_any_clipped(const State& state, const Mesh& mesh);

/// Implements Method::operations for a formula: counts a row between two edges of a triangle in
/// perspective, w = 1, 2 and 4, with two attributes, and the step from one pixel of the row to the
/// next.
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
