// scanline-linear: the naive algorithm of Heckbert & Moreton 1991, §2: parameters are interpolated
// along the edges from scanline to scanline, then across each scanline, linearly in the window. The
// result is right for screen-affine parameters. Object-affine parameters are screen-affine only in
// parallel projection or on a plane across the line of sight (§2.1); otherwise the method shows the
// "rubber sheet" effect.
//
// The mathematics. Between edges with the ends (v_0, r_0), (v_1, r_1) and so on,
//
//   r_left(v) = ((v_1 − v) r_0 + (v − v_0) r_1) / (v_1 − v_0),   r_right(v) likewise,
//   r(u, v) = ((u_right − u) r_left + (u − u_left) r_right) / (u_right − u_left),
//
// where the row crosses the edges at u_left and u_right. On a triangle this is the affine function
// through the three vertices, because no other function is linear along edges and rows. Turning the
// camera about the line of sight does not change it.
//
// For a polygon of more sides an affine function through its vertices does not exist in general.
// Then r is piecewise bilinear, with pieces that depend on the direction of the rows: r changes
// when the camera turns, and has creases along the rows through the vertices (§2.1). Example,
// window coordinates and r: (0, 0) 0, (8, 0) 8, (4, 4) 8, (0, 4) 0. Rows: r_left = 0, r_right = 8
// at u = 8 − v, so r = 8 u/(8 − v). After a quarter turn, the rows are the former columns; for u >
// 4 they run from v = 0 with r = u to v = 8 − u with r = 8, so r = u + v. At (4 1/2, 2 1/2) the two
// results are 72/11 and 7.
//
// Clipped triangles (step 3, linearly in clip space) become such polygons: their new vertices have
// the values of the perspective view, and between these, values are linear in the window. The
// result is neither affine nor that of the perspective view.
//
// Claim. For a draw that needs no clipping: values are affine in the window. For any other draw:
// values of covered samples lie in the range of the vertices' values, because they are means of
// means. The true values lie in it too, so the error is at most that range. Centres that are not
// covered get the claimed values: the triangle's affine function, or the perspective one.
//
// Error, first order, u = 2^-53: 10 u max|r_i| along edges and rows (internal/polygon_drawing.h).
//
// Not done here, besides the limits of polygon_drawing.h: dividing by w.
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
     .source = "Heckbert & Moreton 1991, §2, §2.1",
     .fails = "in perspective; and quads and clipped triangles as the view turns",
     .draw = &draw,
     .promise = &promise,
     .operations = &count_scan<ScanlineLinear>,
     .draw_polygon = &scan_polygon_by<ScanlineLinear>});

}  // namespace
}  // namespace rastercheck::rasterizer
