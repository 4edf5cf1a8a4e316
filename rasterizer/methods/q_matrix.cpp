// q-matrix and q-matrix-float: the parameters k and l of a place, by the q-matrix (Rasterization
// slides, pp. 6–7), in double and with the precision of float32.
//
// The mathematics is that of rasterizer/methods/q_matrix.h, in clip form: with the homogeneous
// window coordinates (X_i, Y_i, w_i) of the vertices
//
//   E_i = A_i u + B_i v + C_i,   (A_i, B_i, C_i) the rows of |det M| M^-1,   D = E_1 + E_2 + E_3
//   k = E_2/D,   l = E_3/D,   r = r_1 + (r_2 − r_1) k + (r_3 − r_1) l.
//
// D is evaluated by the sums of the rows' coefficients, as on p. 7. The method does not divide by
// w_i, so vertices with w <= 0 need no special case.
//
// Error. Notation of internal/point_drawing.h: u the unit roundoff, S = Σ|E|_i, K = S/D. In double
// X and Y already have errors of 3 u, and each further operation adds 1 u: A_i and B_i 5 u, C_i 8
// u, E_i 9 u; the sums of A_i 7 u and of C_i 10 u, D 11 u. In float X and Y come from double and
// are rounded once: A_i and B_i 3 u, C_i 4 u, E_i 6 u; the sums 5 u and 6 u, D 8 u. All of these
// factors multiply the terms' magnitudes, and so S. The result is
//
//   r' = r_1 + Σ (r_i − r_1)(1 + η_i) E'_i/D',      E' = E + δE, D' = D + δD, |η_i| <= 5 u,
//
// where η_i covers a difference, a quotient, a product and two sums; r_1 has two more roundings.
// Without these roundings
//
//   r' − r = (Σ (r_i − r_1) δE_i − (r − r_1) δD) / D'
//
// because Σ (r_i − r_1) E_i = (r − r_1) D. Here |r_i − r_1| <= 2 M and |r − r_1| <= 2 M. If E_i has
// an error of e u and D of d u, this is at most (2 e + 2 d) u M S/D', to which the roundings add 2
// M 5 u S/D' + 2 u M. So n + d of point_bound() is 2 e + 2 d + 12, and 1 more covers second order:
//
//   double   e = 9, d = 11:  n = 42         float   e = 6, d = 8:  n = 33
//
// In float, 111,928 random samples of a window of 8 by 8 pixels, w in [1/8, 8), had errors of 0.62
// scale ULP in the median and 2,923 at worst, where K was 10,142; none exceeded 1.4% of the bound.
//
// Range. In double no E_i overflows, because E_i is below 2^520, and none underflows, because E_i,
// like its terms, is a multiple of 2^-602. A quotient that underflows is negligible compared with
// M. In float32 products of clip coordinates do overflow and underflow. Scaling each vertex by a
// power of two, with the factor put back into the E_i, does not suffice. For example, the triangle
// with clip positions (−2^127, 0, w), (2^127, −2w, w) and (2^127, 2w, w), w = 2^-73, covers a
// window of 8 by 8 pixels and has K <= 3 1/4 in it. But with 2^127 scaled to 1, y and w are 0 in
// float32, and the three vertices coincide. So q-matrix-float has float32's precision with a wider
// exponent (internal/wide_float.h), which differs from float32 only if a product leaves float32's
// range.
//
// Constants and vertex values are not reproduced to the bit.
//
// Operations for two attributes, and the divisions among them:
//   q-matrix: 22 (2) per pixel, 42 per polygon
//   q-matrix-float: 22 (2) per pixel, 42 per polygon

#include "rasterizer/methods/q_matrix.h"

#include <array>
#include <cstddef>
#include <span>

#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/internal/wide_float.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

template <class T>
class InTrianglePlane {
 public:
  void set_vertex(std::size_t i, const PointVertex& vertex, std::size_t count) {
    columns_[i] = {T(vertex.x), T(vertex.y), T(vertex.w)};
    for (std::size_t k = 0; k < count; ++k) values_[i][k] = T(vertex.values[k]);
  }

  void set_up(std::size_t count) {
    q_ = q_matrix_of_columns(columns_);
    for (std::size_t k = 0; k < count; ++k) {
      along_k_[k] = values_[1][k] - values_[0][k];
      along_l_[k] = values_[2][k] - values_[0][k];
    }
  }

  void at(T u, T v, std::span<T> values) const {
    const T d = q_.denominator(u, v);
    const T k = plane_at(q_.rows[1], u, v) / d;
    const T l = plane_at(q_.rows[2], u, v) / d;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = values_[0][i] + along_k_[i] * k + along_l_[i] * l;
    }
  }

 private:
  std::array<Triple<T>, 3> columns_;
  std::array<std::array<T, kMaxAttributes>, 3> values_;
  std::array<T, kMaxAttributes> along_k_;
  std::array<T, kMaxAttributes> along_l_;
  QMatrix<T> q_;
};

Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return {.smooth = point_bound(42, 11, kDoubleRoundoff)};
}

Promise float_promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return {.smooth = point_bound(33, 8, kFloatRoundoff)};
}

const MethodRegistration kDouble(
    {.name = "q-matrix",
     .source = "Rasterization slides, pp. 6–7",
     .fails = "where the weights cancel; constants and vertex values are not kept to the bit",
     .draw = &draw_by_formula<InTrianglePlane, double>,
     .promise = &promise,
     .operations = &count_formula<InTrianglePlane>});

const MethodRegistration kFloat(
    {.name = "q-matrix-float",
     .source = "Rasterization slides, pp. 6–7, in float32",
     .fails = "by 2^29 times as much as in double where the weights cancel",
     .draw = &draw_by_formula<InTrianglePlane, WideFloat>,
     .promise = &float_promise,
     .operations = &count_formula<InTrianglePlane>});

}  // namespace
}  // namespace rastercheck::rasterizer
