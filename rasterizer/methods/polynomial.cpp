// polynomial-quadratic and polynomial-cubic: along each row a polynomial replaces the rational
// linear function, so that no pixel divides (Wolberg, 1990, as told by Heckbert & Moreton 1991,
// §2.1).
//
// The mathematics. Edges are rational linear: s_i = r_i / w and 1 / w are interpolated to both ends
// of a row's span (rational_linear.cpp). With t from 0 to 1 along the span, the values at the nodes
// t = k/n, k = 0 … n, are
//
//   f_k = ((n − k) s_left + k s_right) / ((n − k) 1/w_left + k 1/w_right),
//
// and the polynomial of degree n = 2 or 3 through them replaces r, in powers of n t:
//
//   n = 2   f_0 + (d_1 − d_2/2) (2t) + d_2/2 (2t)²
//   n = 3   f_0 + (d_1 − d_2/2 + d_3/3) (3t) + (d_2 − d_3)/2 (3t)² + d_3/6 (3t)³
//
// with the forward differences d_1 = f_1 − f_0, d_2 = f_2 − 2 f_1 + f_0, d_3 = f_3 − 3 f_2 + 3 f_1
// − f_0.
//
// Approximation error. Along the span 1/w is linear. Let it be least at t = 0, and ρ times as great
// at t = 1. Up to a factor it is then t + q with q = 1/(ρ − 1), and r = α + β/(t + q). r is
// monotone from end to end, with the range R = |β| / (q (1 + q)). The polynomial P through r at the
// nodes x_k has
//
//   r − P = β Π(t − x_k) / ((t + q) Π(−q − x_k)),
//
// because (t + q) times either side is a polynomial of degree n + 1, and the two polynomials agree
// at the nodes and at −q. So
//
//   n = 2   |r − P| = R |t (t − 1/2) (t − 1)| / ((t + q) (q + 1/2))
//                  <= R min(√3/36 / (q (q + 1/2)),  1/2 / (q + 1/2)),
//   n = 3   |r − P| = R |t (t − 1/3) (t − 2/3) (t − 1)| / ((t + q) (q + 1/3) (q + 2/3))
//                  <= R min(1/81 / (q (q + 1/3) (q + 2/3)),  2/9 / ((q + 1/3) (q + 2/3))).
//
// The first bound of each pair holds because t + q >= q and the product is at most √3/36, at (t −
// 1/2)² = 1/12, or 1/81, at (t − 1/2)² = 5/36. The second bound holds because t <= t + q and the
// rest of the product is greatest at t = 0. All bounds grow with ρ, and reach 1, the whole range,
// as ρ goes to infinity.
//
// R is at most the range of the vertices' values, and ρ is at most the ratio of w among the
// vertices, because a span lies within the triangle, also after clipping. For a triangle with some
// w <= 0 the ratio has no bound; the share is then 1.
//
// Roundings, first order, u = 2^-53, M = max|r_i|. Nodes are means of numbers of one sign (1/w),
// with errors below 30 u M. They are monotone with a range R <= 2 M, so for n = 3 coefficients are
// at most 3.7 M, 2 M and M/3, and terms at most 3.7 · 3, 2 · 9 and 1/3 · 27 M, together 39 M. Each
// term has at most 23 roundings, including those of t. That makes less than 900 u M. Adding 8 times
// a node's error makes less than 2^11 u M, which is 2^-18 scale ULP.
//
// Not done here, besides the limits of internal/polygon_drawing.h: splitting spans with large ρ
// ("should be adaptive", Heckbert & Moreton 1991; not recommended there either).
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

/// Interpolates s_i along edges, and 1/w as the last parameter.
template <class T, std::size_t kDegree>
class Polynomial : public LinearFormula<T> {
 public:
  void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const override {
    for (std::size_t i = 0; i < this->count_; ++i) s[i] = vertex.r[i] / vertex.w;
    s[this->count_] = T(1) / vertex.w;
  }
  /// Stores coefficients in `left`, `right` and `more`, and the factor from pixels to n t in
  /// `right_u`.
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
  /// Returns n times the linear function's value at k/n.
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

/// Returns the greatest ratio of w among the vertices of any triangle; empty if some w <= 0. Skips
/// triangles that are not finite, because they are not drawn.
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

/// Returns the bound for a degree as a share of the range, using p = 1/q = ρ − 1, which may be 0.
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
  // Covers the rounding of the share itself.
  constexpr double kRounded = 1 + 0x1p-20;
  const std::optional<double> ratio = greatest_ratio(mesh);
  MethodBound bound = kScannedPerspectiveBound;
  bound.constant += 0x1p-18;
  bound.range_share = ratio ? std::min(kRounded * range_share(kDegree, *ratio), 1.0) : 1.0;
  return scanned_promise(Claim::perspective, bound);
}

const MethodRegistration kQuadratic(
    {.name = "polynomial-quadratic",
     .source = "Heckbert & Moreton 1991, §2.1; Wolberg 1990",
     .fails = "near the pole: between nodes where w changes much along a row",
     .draw = &scan_triangles_by<Quadratic>,
     .promise = &promise<2>,
     .operations = &count_scan<Quadratic>,
     .draw_polygon = &scan_polygon_by<Quadratic>});

const MethodRegistration kCubic(
    {.name = "polynomial-cubic",
     .source = "Heckbert & Moreton 1991, §2.1; Wolberg 1990",
     .fails = "near the pole: between nodes where w changes much along a row",
     .draw = &scan_triangles_by<Cubic>,
     .promise = &promise<3>,
     .operations = &count_scan<Cubic>,
     .draw_polygon = &scan_polygon_by<Cubic>});

}  // namespace
}  // namespace rastercheck::rasterizer
