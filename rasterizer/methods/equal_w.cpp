// equal-w: does not divide per place if a triangle's three w are equal (Appendix 5; Heckbert &
// Moreton 1991, §3.3). Otherwise it uses the general form.
//
// The mathematics. With the planes of methods/clipless_homogeneous.cpp
//
//   r = (a u + b v + c) / (a_1 u + b_1 v + c_1),
//
//   a_1 = Σ (Y_j w_k − Y_k w_j),   b_1 = Σ (w_j X_k − w_k X_j),   c_1 = Σ (X_j Y_k − X_k Y_j).
//
// If w_1 = w_2 = w_3 the sums a_1 and b_1 are 0 and the divisor is c_1 everywhere: w² times twice
// the triangle's area. The set-up then divides a, b and c once, and r is affine in the window:
//
//   r = a/c_1 u + b/c_1 v + c/c_1.
//
// For n parameters this costs 3 n divisions per triangle, and saves n divisions, two products and
// two sums per place.
//
// Error (internal/point_drawing.h), u = 2^-53. In the general form n = 13 and d = 12, as in
// methods/clipless_homogeneous.cpp. With equal w the three quotients add 1 u to the 12 u of the
// numerator. c_1 is the sum of three terms C_i with errors of 8 u, so with two additions it has an
// error of 10 u Σ|C|_i <= 10 u Σ|E|_i. One more each for second order gives n = 14, d = 11. Both
// forms have the same exact value and the same K. The result of each is within 50 u K + u of the
// exact value, in units of M = max(|r|, max|r_i|), so the two results differ by at most
//
//   (100 u K + 2 u) M,    that is (25 · 2^-27 K + 2^-28) scale ULP,
//
// before rounding to float32, which may add one ULP.
//
// Range. Let W be the viewport's width, at least 2^-149. Because |X|_i >= |w_i| |W|/2, the terms of
// a_i, and those of b_i, are at most 2^150 times the terms of c_1. So a quotient overflows only if
// K is far beyond any promise, and an underflow is negligible compared with M.
//
// Nearly equal w are not treated as equal, because that would cause an error proportional to the
// range of the r_i (screen_linear.cpp).
//
// Operations for two attributes, and the divisions among them:
//   equal-w: 8 per pixel, 65 (6) per polygon

#include <array>
#include <cstddef>
#include <span>

#include "rasterizer/methods/internal/homogeneous_planes.h"
#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

template <class T>
class EitherPlanes {
 public:
  void set_vertex(std::size_t i, const PointVertex& vertex, std::size_t count) {
    w_[i] = vertex.w;
    undivided_.set_vertex(i, vertex, count);
    general_.set_vertex(i, vertex, count);
  }

  void set_up(std::size_t count) {
    is_equal_ = w_[0] == w_[1] && w_[1] == w_[2];
    if (is_equal_) {
      undivided_.set_up(count);
    } else {
      general_.set_up(count);
    }
  }

  void at(T u, T v, std::span<T> values) const {
    if (is_equal_) {
      undivided_.at(u, v, values);
    } else {
      general_.at(u, v, values);
    }
  }

 private:
  std::array<double, 3> w_{};
  bool is_equal_ = false;
  UndividedPlanes<T> undivided_;
  HomogeneousPlanes<T> general_;
};

Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  static_assert(13 + 12 == 14 + 11);
  return {.smooth = point_bound(14, 11, kDoubleRoundoff)};
}

/// Counts the operations for a triangle whose three w are equal.
OperationCounts operations() {
  std::array<PointVertex, 3> vertices = counted_triangle();
  for (PointVertex& vertex : vertices) vertex.w = 1;
  return count_formula_on<EitherPlanes>(vertices);
}

const MethodRegistration kRegistration(
    {.name = "equal-w",
     .source = "Appendix 5; Heckbert & Moreton 1991, §3.3",
     .fails = "where the weights cancel, as the general form does",
     .draw = &draw_by_formula<EitherPlanes, double>,
     .promise = &promise,
     .operations = &operations});

}  // namespace
}  // namespace rastercheck::rasterizer
