// scanline-linear: the naive algorithm of Heckbert and Moreton, §2 (seed 002): parameters are
// interpolated along the edges from scanline to scanline, then across each scanline, linearly in
// the window. It is right for what is screen-affine, which object-affine parameters are only in
// parallel projection or on a plane across the line of sight (§2.1); otherwise it shows the "rubber
// sheet" effect.
//
// The mathematics. Between edges with the ends (v_0, r_0), (v_1, r_1) and so on,
//
//   r_left(v) = ((v_1 − v) r_0 + (v − v_0) r_1) / (v_1 − v_0),   r_right(v) alike,
//   r(u, v) = ((u_right − u) r_left + (u − u_left) r_right) / (u_right − u_left),
//
// u_left and u_right where the row crosses the edges: on a triangle the affine function through its
// three vertices, as that is linear along edges and rows, and these determine it. Turning the
// camera about the line of sight does not change it.
//
// A polygon of more sides has no affine function through its vertices in general. r is piecewise
// bilinear then, and which pieces depends on which way the rows run: it changes when the camera is
// turned, and has creases along the rows through the vertices (§2.1). Example, window coordinates
// and r: (0, 0) 0, (8, 0) 8, (4, 4) 8, (0, 4) 0. Rows: r_left = 0, r_right = 8 at u = 8 − v, so
// r = 8 u/(8 − v). Turned by a quarter, the rows are what was columns; where u > 4 they run from
// v = 0 with r = u to v = 8 − u with r = 8, so r = u + v. At (4 1/2, 2 1/2) that is 72/11 and 7.
//
// Triangles that are clipped (step 3, linearly in clip space) become such polygons: their new
// vertices have the values of the perspective view, and the edges between are linear in the window.
// What comes out is neither affine nor what the perspective view shows.
//
// What it claims. Of a draw that needs no clipping: that it is affine in the window. Of any other:
// that values of samples it covers are within the range of the vertices' values, as means of means
// are; the true ones are too, so it is off by at most that range. Centres that are not covered have
// values of what is claimed: the triangle's affine function, or the perspective one.
//
// Error, first order, u = 2^-53: 10 u max|r_i| along edges and rows (internal/polygon_drawing.h).
//
// What it does not do, besides what polygon_drawing.h does not: divide by w.
//
// Operations for two attributes, and the divisions among them:
//   scanline-linear: 11 (2) per pixel, 22 (4) per row

#include <algorithm>
#include <cstddef>
#include <span>

#include "rasterizer/methods/internal/polygon_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

template <class T>
class ScanlineLinear : public LinearFormula<T> {
 public:
  void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const override {
    std::copy_n(vertex.r.begin(), this->count_, s.begin());
  }
  void values(const Parameters<T>& s, std::span<T> r) const override {
    std::copy_n(s.begin(), this->count_, r.begin());
  }

 protected:
  std::size_t parameter_count() const override { return this->count_; }
};

Promise promise(const State& state, const Mesh& mesh, const TargetSize& /*size*/) {
  if (!is_any_clipped(state, mesh)) return scanned_promise(Claim::affine, kScannedLinearBound);
  MethodBound within_range = kScannedPerspectiveBound;
  within_range.range_share = 1;
  return scanned_promise(Claim::perspective, within_range);
}

DrawCounts draw(const State& state, const Mesh& mesh, const TargetSize& size, Fragments& fragments,
                MethodTap* tap) {
  ScanlineLinear<double> formula;
  return scan_triangles(state, mesh, size, formula, promise(state, mesh, size).claims, fragments,
                        tap);
}

const MethodRegistration kRegistration(
    {.name = "scanline-linear",
     .source = "seed 002 §2, §2.1",
     .fails = "in perspective; and quads and clipped triangles as the view turns",
     .draw = &draw,
     .promise = &promise,
     .operations = &count_scan<ScanlineLinear>,
     .draw_polygon = &scan_polygon_by<ScanlineLinear>});

}  // namespace
}  // namespace rastercheck::rasterizer
