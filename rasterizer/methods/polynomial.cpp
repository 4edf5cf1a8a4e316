// polynomial-quadratic and polynomial-cubic: along each row a polynomial in place of the rational
// linear function, so that no pixel divides (Wolberg, 1990, as told by Heckbert and Moreton, §2.1,
// seed 002).
//
// The mathematics. Edges are rational linear: s_i = r_i / w and 1 / w are interpolated to both ends
// of a row's span (rational_linear.cpp). With t from 0 to 1 along it, values at the nodes k/n, k =
// 0 … n, are
//
//   f_k = ((n − k) s_left + k s_right) / ((n − k) 1/w_left + k 1/w_right),
//
// and the polynomial of degree n = 2 or 3 through them takes the place of r, in powers of n t:
//
//   n = 2   f_0 + (d_1 − d_2/2) (2t) + d_2/2 (2t)²
//   n = 3   f_0 + (d_1 − d_2/2 + d_3/3) (3t) + (d_2 − d_3)/2 (3t)² + d_3/6 (3t)³
//
// with the forward differences d_1 = f_1 − f_0, d_2 = f_2 − 2 f_1 + f_0, d_3 = f_3 − 3 f_2 + 3 f_1
// − f_0.
//
// What it is off by. Along the span 1/w is linear, least at one end, say t = 0, and ρ times that at
// the other: up to a factor t + q with q = 1/(ρ − 1), and r = α + β/(t + q). It goes from end to
// end without turning, over R = |β| / (q (1 + q)). The polynomial P through r at the nodes x_k has
//
//   r − P = β Π(t − x_k) / ((t + q) Π(−q − x_k)),
//
// as (t + q) times both sides are polynomials of degree n + 1 that agree at the nodes and at −q. So
//
//   n = 2   |r − P| = R |t (t − 1/2) (t − 1)| / ((t + q) (q + 1/2))
//                  <= R min(√3/36 / (q (q + 1/2)),  1/2 / (q + 1/2)),
//   n = 3   |r − P| = R |t (t − 1/3) (t − 2/3) (t − 1)| / ((t + q) (q + 1/3) (q + 2/3))
//                  <= R min(1/81 / (q (q + 1/3) (q + 2/3)),  2/9 / ((q + 1/3) (q + 2/3))).
//
// The first of each pair: t + q >= q, and the product is greatest where (t − 1/2)² = 1/12, √3/36,
// or 5/36, 1/81. The second: t <= t + q, and what is left of the product is greatest at t = 0. All
// grow with ρ: to 1, the whole range, where w goes to infinity along the span.
//
// R is at most the range of the vertices' values, and ρ at most the ratio of w among the vertices:
// a span lies within the triangle, also what clipping leaves of one. Of a triangle with some w <= 0
// the ratio has no bound; the share is 1 then.
//
// Roundings, first order, u = 2^-53, M = max|r_i|. Nodes are means of numbers of one sign (1/w),
// off by less than 30 u M. Going one way over R <= 2 M they make coefficients of at most 3.7 M, 2 M
// and M/3 for n = 3, and terms of at most 3.7 · 3, 2 · 9 and 1/3 · 27 M: 39 M together, with at
// most 23 roundings each, t's own among them. That is less than 900 u M, and with 8 times what a
// node is off by less than 2^11 u M, 2^-18 scale ULP.
//
// What they do not do, besides what internal/polygon_drawing.h does not: split spans where ρ is
// large ("should be adaptive", seed 002; not recommended there either).
//
// Operations for two attributes, and the divisions among them:
//   polynomial-cubic: 14 per pixel, 104 (23) per row, 3 (3) per vertex
//   polynomial-quadratic: 10 per pixel, 75 (15) per row, 3 (3) per vertex

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "rasterizer/methods/internal/polygon_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

/// Along edges s_i, then 1/w.
template <class T, std::size_t kDegree>
class Polynomial : public LinearFormula<T> {
 public:
  void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const override {
    for (std::size_t i = 0; i < this->count_; ++i) s[i] = vertex.r[i] / vertex.w;
    s[this->count_] = T(1) / vertex.w;
  }
  /// Coefficients in `left`, `right`, `more`; in place of `right_u` the factor that makes n t of
  /// pixels.
  void set_span(SpanEnds<T>& ends, T /*first*/) const override {
    const T width = ends.right_u - ends.left_u;
    ends.right_u = width == T(0) ? T(0) : T(static_cast<double>(kDegree)) / width;
    std::array<T, kDegree + 1> divisors;
    for (std::size_t k = 0; k <= kDegree; ++k) {
      divisors[k] = node(k, ends.left[this->count_], ends.right[this->count_]);
    }
    for (std::size_t i = 0; i < this->count_; ++i) {
      std::array<T, kDegree + 1> f;
      for (std::size_t k = 0; k <= kDegree; ++k) {
        f[k] = node(k, ends.left[i], ends.right[i]) / divisors[k];
      }
      set_coefficients(f, i, ends);
    }
  }
  void along_span(SpanEnds<T>& ends, T u, Parameters<T>& s) const override {
    const T nt = (u - ends.left_u) * ends.right_u;
    for (std::size_t i = 0; i < this->count_; ++i) {
      T sum = ends.more[kDegree - 2][i];
      if constexpr (kDegree == 3) sum = sum * nt + ends.more[0][i];
      s[i] = (sum * nt + ends.right[i]) * nt + ends.left[i];
    }
  }
  void values(const Parameters<T>& s, std::span<T> r) const override {
    std::copy_n(s.begin(), this->count_, r.begin());
  }

 protected:
  std::size_t parameter_count() const override { return this->count_ + 1; }

 private:
  /// n times what is linear, at k/n.
  static T node(std::size_t k, T left, T right) {
    return T(static_cast<double>(kDegree - k)) * left + T(static_cast<double>(k)) * right;
  }

  static void set_coefficients(const std::array<T, kDegree + 1>& f, std::size_t i,
                               SpanEnds<T>& ends) {
    const T d_1 = f[1] - f[0];
    const T d_2 = f[2] - f[1] - d_1;
    ends.left[i] = f[0];
    if constexpr (kDegree == 2) {
      ends.more[0][i] = d_2 / T(2);
      ends.right[i] = d_1 - ends.more[0][i];
    } else {
      const T d_3 = f[3] - f[2] - (f[2] - f[1]) - d_2;
      ends.more[1][i] = d_3 / T(6);
      ends.more[0][i] = (d_2 - d_3) / T(2);
      ends.right[i] = d_1 - d_2 / T(2) + d_3 / T(3);
    }
  }
};

template <class T>
using Quadratic = Polynomial<T, 2>;
template <class T>
using Cubic = Polynomial<T, 3>;

/// The greatest ratio of w among the vertices of a triangle; nothing where one has w <= 0. Those
/// that are not finite are not drawn.
std::optional<double> greatest_ratio(const Mesh& mesh) {
  double greatest = 1;
  for (const glm::uvec3& corners : mesh.triangles) {
    const std::array<double, 3> w{mesh.positions[corners.x].w, mesh.positions[corners.y].w,
                                  mesh.positions[corners.z].w};
    if (!std::isfinite(w[0] + w[1] + w[2])) continue;
    const auto [least, most] = std::minmax_element(w.begin(), w.end());
    if (!(*least > 0)) return std::nullopt;
    greatest = std::max(greatest, *most / *least);
  }
  return greatest;
}

/// The share of the range, of `degree`: with p = 1/q = ρ − 1, which may be 0.
double range_share(std::size_t degree, double ratio) {
  const double p = ratio - 1;
  constexpr double kRootOf3 = 1.7320508075688773;
  if (degree == 2) {
    const double second = 0.5 * p / (1 + 0.5 * p);
    return std::min(kRootOf3 / 36 * p * p / (1 + 0.5 * p), second);
  }
  const double divisor = (1 + p / 3) * (1 + 2 * p / 3);
  return std::min(p * p * p / 81 / divisor, 2 * p * p / 9 / divisor);
}

template <std::size_t kDegree>
Promise promise(const State& /*state*/, const Mesh& mesh, const TargetSize& /*size*/) {
  // What the share itself is rounded by.
  constexpr double kRounded = 1 + 0x1p-20;
  const std::optional<double> ratio = greatest_ratio(mesh);
  MethodBound bound = kScannedPerspectiveBound;
  bound.constant += 0x1p-18;
  bound.range_share = ratio ? std::min(kRounded * range_share(kDegree, *ratio), 1.0) : 1.0;
  return scanned_promise(Claim::perspective, bound);
}

const MethodRegistration kQuadratic(
    {.name = "polynomial-quadratic",
     .source = "seed 002 §2.1 (Wolberg, 1990)",
     .fails = "near the pole: between nodes where w changes much along a row",
     .draw = &scan_triangles_by<Quadratic>,
     .promise = &promise<2>,
     .operations = &count_scan<Quadratic>,
     .draw_polygon = &scan_polygon_by<Quadratic>});

const MethodRegistration kCubic(
    {.name = "polynomial-cubic",
     .source = "seed 002 §2.1 (Wolberg, 1990)",
     .fails = "near the pole: between nodes where w changes much along a row",
     .draw = &scan_triangles_by<Cubic>,
     .promise = &promise<3>,
     .operations = &count_scan<Cubic>,
     .draw_polygon = &scan_polygon_by<Cubic>});

}  // namespace
}  // namespace rastercheck::rasterizer
