// edge-then-span and edge-then-span-plane: perspective-correct interpolation (MIT 6.837 2000,
// lecture 18, slides 7 to 13). The lecture writes w for 1/z. Here q = 1/w takes its place, where w
// is that of clip space.
//
// edge-then-span. Between two ends, let t be the fraction of the way in the window, and s the
// fraction of the way in space. Then (slide 11)
//
//   s = t q_2 / (q_1 + t (q_2 − q_1)),
//
// and any parameter is u = u_1 + s (u_2 − u_1) (slide 12); q itself is q_1 + t (q_2 − q_1). So the
// method first interpolates along the edges to the ends of a row's span, with their q, and then
// between these ends. The polygon may be the result of clipping (internal/polygon_drawing.h),
// because it lies in a plane.
//
// Error, first order, roundoff e = 2^-53, M = max|r_i|, Q = the greatest q of the polygon, D = q at
// a place, g = Q/D. t has three roundings, so D has an error of 5 e t |q_2 − q_1| + e D <= 6 e Q,
// and s has an error of s (5 e + 6 e Q/D) <= 11 e g. If the q of the ends have errors of ε, D gets
// ε more, and s gets at most
//
//   t (1 − t) (q_1 + q_2) ε / D²  <=  ε / D,      as t (1 − t) (q_1 + q_2) <= (1 − t) q_1 + t q_2.
//
// u_1 + s (u_2 − u_1) has an error of 2 M |δs| + 5 e M. Along an edge ε = e Q: D has an error of 7
// e Q, s of 12 e g, r of 29 e M g. Along a span ε = 7 e Q: s has an error of 18 e g, and r of 41 e
// M g; the errors of the ends' own values enter with the shares 1 − s = (1 − t) q_1/D and s = t
// q_2/D, and (1 − t) q_1/D · 29 e M Q/q_1 + t q_2/D · 29 e M Q/q_2 = 29 e M g. Together these are
// 70 e M g, less than 2^-22 g scale ULP. The bound is greater by at least 4/5 of 70 e M g, which
// covers the products of errors; these grow as g nears 1/e. From g = 2^47 on no such estimate is
// needed: s is clamped to [0, 1], so r never has an error above 2 M, which is then at most 2^-22 g
// scale ULP. At g = 2^47, D has a relative error of 13 e g < 1/4.
//
// edge-then-span-plane. Slide 13 writes the premultiplied parameters u q, and q itself, as plane
// equations over the window, and divides at each pixel. With window positions (u_i, v_i) and the
// rows
//
//   A_i = v_j − v_k,   B_i = u_k − u_j,   C_i = u_j v_k − u_k v_j,   det = C_0 + C_1 + C_2
//
// a plane through p_i is (Σ p_i A_i, Σ p_i B_i, Σ p_i C_i)/det. This needs no clipping. It also
// holds for w_i < 0, because u_i, v_i and p_i are quotients by the same w_i. It does not hold for
// w_i = 0: the vertex then has no window position, and the method promises nothing for a draw with
// such a triangle.
//
// Error (internal/point_drawing.h). Divided by w_0 w_1 w_2, E_i is q_i times the row above. u_i has
// an error of 4 e |X|_i/|w_i|, A_i and B_i of 5 e and C_i of 10 e times their terms' magnitudes;
// q_i has one rounding, r_i q_i two, the sum of products three, the division one, evaluation three.
// det is the same for all planes, so its error cancels in the quotient: n = 2 + 10 + 3 + 1 + 3 =
// 19, d = 18.
//
// The slides use the z of camera space. The code uses w, which is that z up to a factor; the factor
// cancels in every quotient. ("uPlane" and "vPlane" of the slides' last triangle stand for any two
// attributes.)
//
// Operations for two attributes, and the divisions among them:
//   edge-then-span: 14 (2) per pixel, 28 (4) per row, 1 (1) per vertex
//   edge-then-span-plane: 14 (2) per pixel, 5 (3) per vertex, 71 (9) per polygon

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/internal/polygon_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

/// The fraction of the way from one end to the other in space, computed from a place in the window;
/// also q at that place.
template <class T>
class Share {
 public:
  Share(const Place<T>& place, T q_1, T q_2) : q_(q_1), s_(T(0)) {
    const T length = place.x_b - place.x_a;
    if (length == T(0)) return;
    const T t = (place.x - place.x_a) / length;
    const T numerator = t * q_2;
    q_ = q_1 + t * (q_2 - q_1);
    s_ = numerator < q_ ? numerator / q_ : T(1);
  }

  T q() const { return q_; }
  T between(T a, T b) const { return a + s_ * (b - a); }

 private:
  T q_;
  T s_;
};

/// Parameters: the attributes themselves, then q.
template <class T>
class EdgeThenSpan : public ScanFormula<T> {
 public:
  void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const override {
    std::copy_n(vertex.r.begin(), this->count_, s.begin());
    s[this->count_] = T(1) / vertex.w;
  }
  void along_edge(const Place<T>& place, const Parameters<T>& a, const Parameters<T>& b,
                  Parameters<T>& s) const override {
    const Share<T> share(place, a[this->count_], b[this->count_]);
    for (std::size_t i = 0; i < this->count_; ++i) s[i] = share.between(a[i], b[i]);
    s[this->count_] = share.q();
  }
  void along_span(SpanEnds<T>& ends, T u, Parameters<T>& s) const override {
    along_edge({u, ends.left_u, ends.right_u}, ends.left, ends.right, s);
  }
  void values(const Parameters<T>& s, std::span<T> r) const override {
    std::copy_n(s.begin(), this->count_, r.begin());
  }
};

/// The plane equations of slide 13.
template <class T>
class Planes {
 public:
  void set_vertex(std::size_t i, const PointVertex& vertex, std::size_t count) {
    const T q = T(1) / T(vertex.w);
    u_[i] = T(vertex.x) / T(vertex.w);
    v_[i] = T(vertex.y) / T(vertex.w);
    for (std::size_t k = 0; k < count; ++k) premultiplied_[i][k] = T(vertex.values[k]) * q;
    premultiplied_[i][count] = q;
  }

  void set_up(std::size_t count) {
    std::array<Plane, 3> rows;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      rows[i] = {v_[j] - v_[k], u_[k] - u_[j], u_[j] * v_[k] - u_[k] * v_[j]};
    }
    T determinant = rows[0].c + rows[1].c + rows[2].c;
    if (determinant == T(0)) determinant = T(1);  // rounded to 0
    for (std::size_t k = 0; k <= count; ++k) {
      const auto through = [&](T Plane::*part) {
        return (premultiplied_[0][k] * rows[0].*part + premultiplied_[1][k] * rows[1].*part +
                premultiplied_[2][k] * rows[2].*part) /
               determinant;
      };
      planes_[k] = {through(&Plane::a), through(&Plane::b), through(&Plane::c)};
    }
  }

  void at(T u, T v, std::span<T> values) const {
    const T q = planes_[values.size()].at(u, v);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = planes_[k].at(u, v) / q;
  }

 private:
  struct Plane {
    T a;
    T b;
    T c;
    T at(T u, T v) const { return a * u + b * v + c; }
  };

  std::array<T, 3> u_;
  std::array<T, 3> v_;
  std::array<std::array<T, kMaxAttributes + 1>, 3> premultiplied_;
  std::array<Plane, kMaxAttributes + 1> planes_;
};

Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return scanned_promise(Claim::perspective, {.constant = 0.5 + 0x1p-24, .per_horizon = 0x1p-22});
}

/// A `per_condition` with which nothing is promised, because K >= 1.
constexpr double kNothingPromised = 0x1p24;

Promise promise_planes(const State& /*state*/, const Mesh& mesh, const TargetSize& /*size*/) {
  const auto is_nowhere = [&mesh](std::uint32_t vertex) { return mesh.positions[vertex].w == 0; };
  Promise promise{.smooth = point_bound(19, 18, kDoubleRoundoff)};
  for (const glm::uvec3& corners : mesh.triangles) {
    if (is_nowhere(corners.x) || is_nowhere(corners.y) || is_nowhere(corners.z)) {
      promise.smooth.per_condition = kNothingPromised;
    }
  }
  return promise;
}

const MethodRegistration kShares(
    {.name = "edge-then-span",
     .source = "MIT 6.837 2000, lecture 18, slides 7–12",
     .fails = "towards the horizon, where 1/w is small; samples within roundings of an edge",
     .draw = &scan_triangles_by<EdgeThenSpan>,
     .promise = &promise,
     .operations = &count_scan<EdgeThenSpan>,
     .draw_polygon = &scan_polygon_by<EdgeThenSpan>});

const MethodRegistration kPlanes(
    {.name = "edge-then-span-plane",
     .source = "MIT 6.837 2000, lecture 18, slide 13",
     .fails = "where the weights cancel; w = 0 has no place in the window",
     .draw = &draw_by_formula<Planes, double>,
     .promise = &promise_planes,
     .operations = &count_formula<Planes>});

}  // namespace
}  // namespace rastercheck::rasterizer
