// Let x_i, y_i be the window positions that an implementation has of the vertices. However it came
// by them, they are numbers, and what it computes is held against the triangle of these: that they
// are not the exact positions is a matter of coverage and basis (cases::Contract). What it computes
// is off because of its operations, by δ of their results each.
//
// Positions are taken relative to a point P. Then the weight of vertex i, times D, twice the area,
// is e_i = a_i u + b_i v + c_i with a_i = y_j − y_k, b_i = x_k − x_j, c_i = x_j y_k − x_k y_j, and
// the sizes of the terms that it is the sum of are, where all is made of relative positions,
//
//   s_i = (|y_j| + |y_k|) |u| + (|x_j| + |x_k|) |v| + |x_j| |y_k| + |x_k| |y_j|.
//
// S is the most that Σ s_i can be, of any P in the bounding box and any (u, v) in it, or beyond it
// by as much as values are evaluated beyond the triangle. Σ s_i is convex in each coordinate of P
// and of (u, v), so corners of the boxes have it. Where P may lie away from the box, the gradient
// a_i, b_i is still made of differences, and the value at P of these: two products with a distance,
// of the place and of a vertex from P. So there S is that of the box and
//
//   2 Σ (|a_i| d_u + |b_i| d_v)
//
// more, d how far away P may be. k = S/D says how many digits a weight may lose; k >= 1.
//
// Operations on each term. Relative positions 1, a product 1, a difference 1, u − P 1, a product
// with that 1, two sums 2, the quotient by D, be it a reciprocal and a product, 2: 9. D itself:
// relative positions 1, product 1, difference 1, two sums 2: 5 on terms that sum to S at most.
//
// A value that is linear in window space, r = Σ r_i e_i / D, sees a product with r_i or with a
// difference of two values, that difference, and two sums: 4 more. Values may be evaluated from
// differences to one vertex, r_0 + b_1 (r_1 − r_0) + b_2 (r_2 − r_0), or by a gradient made of
// such; a difference is at most 2 max|r|, so the sizes of such terms sum to 2 S max|r| at most.
// Altogether
//
//   |Δr| <= (2 · 13 + 5) δ k / (1 − 5 δ k) max|r|.
//
// A value that is linear in clip space is N/M with N = Σ b_i r_i/w_i, M = Σ b_i/w_i, of which 1/w_i
// is an operation, its product with r_i another. By the same count, with q the greatest 1/w_i,
//
//   |ΔN| <= (2 · 15 + 5 x) δ k q max|r| / (1 − 5 δ k),  |ΔM| <= (2 · 14 + 5) δ k q / (1 − 5 δ k),
//
// with |N| <= x q max|r|, and the quotient is two operations more. Where M = q/g, and |r| <= y
// max|r|,
//
//   |Δr| <= (30 + 5 x + 33 y) δ k g / (1 − 5 δ k − 33 δ k g) max|r| + 2 δ y max|r|.
//
// Inside the triangle x = y = 1, and g is at most q over the least 1/w_i. Moved vertices have
// another 1/w at the same place, off by reach |∇(1/w)| at most, which is made up for in g.
//
// Outside it, by h along each axis, a weight may be less than 0 by ν_i = h (|a_i| + |b_i|)/D, so
// what is linear in window space is at most x max|r|, x = 1 + Σ ν_i; N is at most x q max|r|, so
// that y = x g; and 1/w may be less than the least 1/w_i by h |∇(1/w)|, which bounds g.
//
// D, S and the gradients are of the moved triangle: its relative positions differ by at most twice
// the reach from the exact ones.

#include "backends/internal/plane_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace rastercheck::backends {
namespace {

constexpr double kWithoutEnd = std::numeric_limits<double>::infinity();

constexpr double kArea = 5;
constexpr double kAffine = 2 * 13 + kArea;
constexpr double kNumerator = 2 * 15;  // and kArea of N itself
constexpr double kDenominator = 2 * 14 + kArea;
constexpr double kDivision = 2;

double extent(const std::array<double, 3>& at) {
  const auto [least, greatest] = std::minmax({at[0], at[1], at[2]});
  return greatest - least;
}

/// Bounds the numbers of a triangle whose vertices may have been moved.
struct Moved {
  double area = 0;              ///< D, at least
  double sizes = 0;             ///< S, at most, of P in the bounding box
  std::array<double, 3> a{};    ///< |a_i|, at most
  std::array<double, 3> b{};    ///< |b_i|, at most
  double most_inverse_w = 0;    ///< q
  double least_inverse_w = 0;   ///< of the vertices
  double inverse_w_change = 0;  ///< |∂(1/w)/∂u| + |∂(1/w)/∂v|, at most

  /// Σ (|a_i| + |b_i|)/D.
  double weight_change() const { return (a[0] + a[1] + a[2] + b[0] + b[1] + b[2]) / area; }
};

/// Σ s_i about P, with (u, v) at most so far from P, each size `more` larger.
double sizes_about(const WindowTriangle& t, double p_x, double p_y, double u, double v,
                   double more) {
  std::array<double, 3> x{};
  std::array<double, 3> y{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = std::fabs(t.x[i] - p_x) + more;
    y[i] = std::fabs(t.y[i] - p_y) + more;
  }
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    sum += (y[j] + y[k]) * u + (x[j] + x[k]) * v + x[j] * y[k] + x[k] * y[j];
  }
  return sum;
}

Moved moved(const WindowTriangle& t, double reach, double beyond) {
  const double more = 2 * reach;
  const double width = extent(t.x);
  const double height = extent(t.y);
  Moved m;
  const double area = (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.x[2] - t.x[0]) * (t.y[1] - t.y[0]);
  // Two relative positions, each off by `more` along each axis.
  m.area = std::fabs(area) - 2 * more * (width + height) - 2 * more * more;
  for (const double p_x :
       {*std::min_element(t.x.begin(), t.x.end()), *std::max_element(t.x.begin(), t.x.end())}) {
    for (const double p_y :
         {*std::min_element(t.y.begin(), t.y.end()), *std::max_element(t.y.begin(), t.y.end())}) {
      m.sizes = std::max(
          m.sizes, sizes_about(t, p_x, p_y, width + more + beyond, height + more + beyond, more));
    }
  }
  const std::array<double, 3> inverse_w{1 / t.w[0], 1 / t.w[1], 1 / t.w[2]};
  std::tie(m.least_inverse_w, m.most_inverse_w) =
      std::minmax({inverse_w[0], inverse_w[1], inverse_w[2]});
  double change_x = 0;
  double change_y = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    m.a[i] = std::fabs(t.y[j] - t.y[k]) + more;
    m.b[i] = std::fabs(t.x[k] - t.x[j]) + more;
    // As Σ a_i = 0, differences to any number will do.
    change_x += (t.y[j] - t.y[k]) * (inverse_w[i] - m.least_inverse_w);
    change_y += (t.x[k] - t.x[j]) * (inverse_w[i] - m.least_inverse_w);
  }
  const double range = m.most_inverse_w - m.least_inverse_w;
  m.inverse_w_change = (std::fabs(change_x) + std::fabs(change_y) + 2 * 3 * more * range) / m.area;
  return m;
}

}  // namespace

PlaneError plane_error(const WindowTriangle& triangle, const Evaluation& evaluation) {
  constexpr PlaneError kNothing{kWithoutEnd, kWithoutEnd, kWithoutEnd};
  const Moved m = moved(triangle, evaluation.reach, evaluation.beyond);
  if (!(m.area > 0)) return kNothing;
  double sizes = m.sizes;
  for (std::size_t i = 0; i < 3; ++i) {
    sizes += 2 * (m.a[i] * evaluation.away[0] + m.b[i] * evaluation.away[1]);
  }
  const double lost = evaluation.operation * sizes / m.area;  // δ k
  if (!(kArea * lost < 1)) return kNothing;
  const double outside = 1 + evaluation.beyond * m.weight_change();  // x
  PlaneError error;
  error.affine = kAffine * lost * outside / (1 - kArea * lost);
  const double least =
      m.least_inverse_w - (evaluation.beyond + evaluation.reach) * m.inverse_w_change;
  const double horizon = least > 0 ? m.most_inverse_w / least : kWithoutEnd;  // g, at most
  const double left = 1 - kArea * lost - kDenominator * lost * horizon;
  if (!(left > 0)) {
    error.constant = error.per_horizon = kWithoutEnd;
    return error;
  }
  error.constant = kDivision * evaluation.operation * outside;
  const double numerator = kNumerator + kArea * outside;
  error.per_horizon = (numerator + kDenominator * outside) * lost / left;
  if (evaluation.beyond > 0) {  // The greatest g there may be less than it is where vertices are.
    error.constant = kDivision * evaluation.operation * outside * horizon +
                     (numerator + kDenominator * outside * horizon) * lost * horizon / left;
    error.per_horizon = 0;
  } else {
    // Of moved vertices 1/w at a place is at least 1/w − reach |∇(1/w)|.
    error.per_horizon *=
        m.least_inverse_w / (m.least_inverse_w - evaluation.reach * m.inverse_w_change);
  }
  return error;
}

double weight_change(const WindowTriangle& triangle, double reach, double distance) {
  const Moved m = moved(triangle, reach, distance);
  if (!(m.area > 0)) return kWithoutEnd;
  const double least = m.least_inverse_w - (distance + reach) * m.inverse_w_change;
  if (!(least > 0)) return kWithoutEnd;
  // λ_i = b_i q_i / M: |∂λ_i| <= |∂b_i| q_i / M + |λ_i| |∂M| / M, and |λ_i| <= (1 + ν_i) q / M.
  // Each is taken where it is greatest.
  const double outside = 3 + distance * m.weight_change();
  const double horizon = m.most_inverse_w / least;
  return distance * horizon * (m.weight_change() + outside * m.inverse_w_change / least);
}

}  // namespace rastercheck::backends
