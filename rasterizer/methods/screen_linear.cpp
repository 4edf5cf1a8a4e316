// screen-linear and screen-linear-barycentric: interpolation that is affine on the screen, called
// "rubber sheet" or inconsistent with the geometry (Appendix 5, A 6.3; Rasterization slides, pp.
// 3–5; Heckbert & Moreton 1991, §2).
//
// The mathematics. With window positions (u_i, v_i) = (X_i, Y_i)/w_i the coefficients of r = a u +
// b v + c solve
//
//   [u_0 v_0 1] [a]   [r_0]
//   [u_1 v_1 1] [b] = [r_1]                                         (Rasterization slides, p. 4)
//   [u_2 v_2 1] [c]   [r_2]
//
// by the inverse's rows
//
//   A_i = v_j − v_k,   B_i = u_k − u_j,   C_i = u_j v_k − u_k v_j,   det = C_0 + C_1 + C_2,
//
// (i, j, k) in cyclic order: (a, b, c) = Σ r_i (A_i, B_i, C_i) / det. The barycentric form
// (Rasterization slides, p. 5) evaluates λ_i = (A_i u + B_i v + C_i)/det at each place instead, and
// then r = Σ λ_i r_i. This takes longer, but the same weights serve any number of attributes.
//
// Approximation error. The method claims the exact affine function up to roundings; its distance
// from a perspective view is up to
//
//   (√ρ − 1)/(√ρ + 1) · (max r_i − min r_i),      ρ = max w_i / min w_i:
//
// the perspective weights are b_i = (λ_i/w_i)/Σ(λ_j/w_j), and Σ (b_i − λ_i) r_i is at most the
// range of the r_i times the sum of the positive b_i − λ_i. The vertices i with positive b_i − λ_i
// act as one point of weight λ whose 1/w is a mean of their 1/w_i, and the other vertices act as a
// second point. On a line between two such points, with w from 1 to ρ' <= ρ,
//
//   b − λ = λ (1 − λ)(ρ' − 1) / (λ ρ' + 1 − λ)      (for the end nearer the eye)
//
// is greatest at λ = 1/(√ρ' + 1), where it is (√ρ' − 1)/(√ρ' + 1). An edge with the two extreme w
// attains it.
//
// Roundings (internal/point_drawing.h), u = 2^-53. u_i has an error of 4 u |X|_i/|w_i|; A_i and B_i
// of 5 u and C_i of 10 u times their terms' magnitudes, det of 12 u Σ|C|_i <= 12 u Σ|E|_i. The sums
// over i add 3 u, the division 1 u, and the evaluation 3 u: n = 17, d = 12. The barycentric form
// has the same operations in another order: evaluation 3 u, division 1 u, sums 3 u.
//
// The result is not perspective. It is meaningless if some w_i <= 0, because such vertices have no
// window positions.
//
// Operations for two attributes, and the divisions among them:
//   screen-linear: 8 per pixel, 2 (2) per vertex, 53 (6) per polygon
//   screen-linear-barycentric: 25 (3) per pixel, 2 (2) per vertex, 17 per polygon

#include <array>
#include <cstddef>
#include <span>

#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

/// The window positions, and the inverse's rows times det.
template <class T>
class WindowTriangle {
 public:
  void set_vertex(std::size_t i, const PointVertex& vertex, std::size_t count) {
    u_[i] = T(vertex.x) / T(vertex.w);
    v_[i] = T(vertex.y) / T(vertex.w);
    for (std::size_t k = 0; k < count; ++k) values_[i][k] = T(vertex.values[k]);
  }

 protected:
  struct Row {
    T a;
    T b;
    T c;
  };

  void invert() {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      rows_[i] = {v_[j] - v_[k], u_[k] - u_[j], u_[j] * v_[k] - u_[k] * v_[j]};
    }
    determinant_ = rows_[0].c + rows_[1].c + rows_[2].c;
  }

  std::array<T, 3> u_;
  std::array<T, 3> v_;
  std::array<std::array<T, kMaxAttributes>, 3> values_;
  std::array<Row, 3> rows_;
  T determinant_;
};

template <class T>
class Plane : public WindowTriangle<T> {
 public:
  void set_up(std::size_t count) {
    this->invert();
    for (std::size_t k = 0; k < count; ++k) {
      const T r0 = this->values_[0][k];
      const T r1 = this->values_[1][k];
      const T r2 = this->values_[2][k];
      const auto& [p, q, s] = this->rows_;
      planes_[k] = {(r0 * p.a + r1 * q.a + r2 * s.a) / this->determinant_,
                    (r0 * p.b + r1 * q.b + r2 * s.b) / this->determinant_,
                    (r0 * p.c + r1 * q.c + r2 * s.c) / this->determinant_};
    }
  }

  void at(T u, T v, std::span<T> values) const {
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = planes_[k].a * u + planes_[k].b * v + planes_[k].c;
    }
  }

 private:
  std::array<typename WindowTriangle<T>::Row, kMaxAttributes> planes_;
};

template <class T>
class Barycentric : public WindowTriangle<T> {
 public:
  void set_up(std::size_t /*count*/) { this->invert(); }

  void at(T u, T v, std::span<T> values) const {
    std::array<T, 3> weights;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& row = this->rows_[i];
      weights[i] = (row.a * u + row.b * v + row.c) / this->determinant_;
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = weights[0] * this->values_[0][k] + weights[1] * this->values_[1][k] +
                  weights[2] * this->values_[2][k];
    }
  }
};

Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return {.claims = Claim::affine, .smooth = point_bound(17, 12, kDoubleRoundoff)};
}

const MethodRegistration kPlane(
    {.name = "screen-linear",
     .source = "Appendix 5, A 6.3; Rasterization slides, pp. 3–5; Heckbert & Moreton 1991, §2",
     .fails = "in perspective; has no meaning where some w <= 0",
     .draw = &draw_by_formula<Plane, double>,
     .promise = &promise,
     .operations = &count_formula<Plane>});

const MethodRegistration kBarycentric({.name = "screen-linear-barycentric",
                                       .source = "Rasterization slides, p. 5",
                                       .fails = "in perspective; has no meaning where some w <= 0",
                                       .draw = &draw_by_formula<Barycentric, double>,
                                       .promise = &promise,
                                       .operations = &count_formula<Barycentric>});

}  // namespace
}  // namespace rastercheck::rasterizer
