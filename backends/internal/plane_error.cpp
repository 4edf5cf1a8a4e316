// Let x_i, y_i be the window positions that an implementation has for the vertices, however it
// computed them. Its values are compared with those of the triangle at these positions. Coverage
// and basis (cases::Contract) account for the difference between these positions and the exact
// ones. Values are off because each operation is off by δ of its result.
//
// Positions are relative to a point P. Let D be twice the area of the triangle. Then the weight of
// vertex i, times D, is e_i = a_i u + b_i v + c_i with a_i = y_j − y_k, b_i = x_k − x_j,
// c_i = x_j y_k − x_k y_j. If everything is computed from relative positions, the magnitudes of the
// terms of e_i sum to
//
//   s_i = (|y_j| + |y_k|) |u| + (|x_j| + |x_k|) |v| + |x_j| |y_k| + |x_k| |y_j|.
//
// S is the greatest Σ s_i for any P in the triangle's bounding box and any (u, v) in the same box
// enlarged by the distance beyond the triangle at which values are evaluated. Σ s_i is convex in
// each coordinate of P and of (u, v), so it is greatest at corners of the boxes. If P may lie
// outside the box, implementations still compute the gradient (a_i, b_i) from differences of
// positions, and the value at P from the gradient. They then multiply the gradient by two distances
// from P: that of the point (u, v) where the value is evaluated, and that of a vertex. So S is then
// the S of the box plus
//
//   2 Σ (|a_i| d_u + |b_i| d_v),
//
// where d is how far away P may be. The quotient k = S/D >= 1 tells how many digits a weight may
// lose.
//
// Each term takes 9 operations: 1 for relative positions, 1 for a product, 1 for a difference, 1
// for u relative to P, 1 for a product with that, 2 for two sums, and 2 for the quotient by D,
// which may be a reciprocal and a product. D itself takes 5 operations on terms that sum to at most
// S: 1 for relative positions, 1 for a product, 1 for a difference and 2 for two sums.
//
// A value linear in window space, r = Σ r_i e_i / D, takes 4 more: a product with r_i or with a
// difference of two values, that difference, and two sums. Values may be evaluated from differences
// to one vertex, r_0 + β_1 (r_1 − r_0) + β_2 (r_2 − r_0) with the weights β_i = e_i/D, or by a
// gradient made of such differences. A difference is at most 2 max|r|, so these terms sum to at
// most 2 S max|r|. Altogether
//
//   |Δr| <= (2 · 13 + 5) δ k / (1 − 5 δ k) max|r|.
//
// A value linear in clip space is N/M with N = Σ β_i r_i/w_i and M = Σ β_i/w_i. Here 1/w_i is one
// operation and its product with r_i another. By the same count, with q the greatest 1/w_i,
//
//   |ΔN| <= (2 · 15 + 5 λ) δ k q max|r| / (1 − 5 δ k),  |ΔM| <= (2 · 14 + 5) δ k q / (1 − 5 δ k),
//
// where λ is such that |N| <= λ q max|r|. The quotient takes two more operations. Where M = q/g and
// |r| <= μ max|r|,
//
//   |Δr| <= (30 + 5 λ + 33 μ) δ k g / (1 − 5 δ k − 33 δ k g) max|r| + 2 δ μ max|r|.
//
// Inside the triangle λ = μ = 1, and g is at most q over the least 1/w_i. If vertices were moved,
// 1/w at the same place differs by at most reach |∇(1/w)|, which g allows for.
//
// Outside the triangle, by up to h along each axis, a weight may be as low as −ν_i with
// ν_i = h (|a_i| + |b_i|)/D. So a value linear in window space is at most λ max|r| with λ = 1 + Σ
// ν_i; N is at most λ q max|r|, so μ = λ g; and 1/w may be below the least 1/w_i by h |∇(1/w)|,
// which bounds g.
//
// Slopes. r_x = N/D with N = (r_1 − r_0) (y_2 − y_0) − (r_2 − r_0) (y_1 − y_0), or another vertex
// in place of vertex 0. Let each r_i be off by e, let ρ be the range of the r_i and h the height of
// the bounding box. Differences of values are off by 2e + δρ. Differences of positions are at most
// h and off by 3δh: 2 relative positions and the difference. Each product adds δρh, and the
// difference of both 2δρh, so
//
//   |ΔN| <= h (2 (2e + δρ) + 2 · 3 δρ + 2 δρ + 2 δρ) = h (4e + 12 δρ),
//   |Δr_x| <= (|ΔN|/D + (5 δ k + 2 δ) |r_x|) / (1 − 5 δ k),  |r_x| <= Σ (r_i − min r) |a_i| / D,
//
// and r_y likewise with the box's width. The larger of |r_x| and |r_y| is no farther off than the
// root of both squared errors. The root of their squares takes 3 operations more: a square, a sum
// and the root itself.
//
// D, S and the gradients are those of the moved triangle, whose relative positions differ from the
// exact ones by at most twice the reach.

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
constexpr double kNumerator = 2 * 15;  // plus kArea for N itself
constexpr double kDenominator = 2 * 14 + kArea;
constexpr double kDivision = 2;
constexpr double kSlopeValue = 4;
constexpr double kSlopeRange = 12;
constexpr double kRoot = 3;

double extent(const std::array<double, 3>& at) {
  const auto [least, greatest] = std::minmax({at[0], at[1], at[2]});
  return greatest - least;
}

/// Bounds on quantities of a triangle whose vertices may have been moved.
struct Moved {
  double area = 0;              ///< D, lower bound
  double sizes = 0;             ///< S, upper bound, for P in the bounding box
  std::array<double, 3> a{};    ///< |a_i|, upper bounds
  std::array<double, 3> b{};    ///< |b_i|, upper bounds
  double most_inverse_w = 0;    ///< q
  double least_inverse_w = 0;   ///< at the vertices
  double inverse_w_change = 0;  ///< |∂(1/w)/∂u| + |∂(1/w)/∂v|, upper bound

  /// Σ (|a_i| + |b_i|)/D.
  double weight_change() const { return (a[0] + a[1] + a[2] + b[0] + b[1] + b[2]) / area; }
};

/// Returns Σ s_i about P for |u| and |v| up to `u` and `v`, with each coordinate relative to P
/// larger by `more`.
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
  // The area is made of two relative positions, each off by `more` along each axis.
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
    // As Σ a_i = 0, any constant may be subtracted from all 1/w_i. Subtracting the least keeps the
    // products small.
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
  const double outside = 1 + evaluation.beyond * m.weight_change();  // λ
  PlaneError error;
  error.affine = kAffine * lost * outside / (1 - kArea * lost);
  const double least =
      m.least_inverse_w - (evaluation.beyond + evaluation.reach) * m.inverse_w_change;
  const double horizon = least > 0 ? m.most_inverse_w / least : kWithoutEnd;  // g, upper bound
  const double left = 1 - kArea * lost - kDenominator * lost * horizon;
  if (!(left > 0)) {
    error.constant = error.per_horizon = kWithoutEnd;
    return error;
  }
  error.constant = kDivision * evaluation.operation * outside;
  const double numerator = kNumerator + kArea * outside;
  error.per_horizon = (numerator + kDenominator * outside) * lost / left;
  if (evaluation.beyond > 0) {
    // Outside, μ = λ g, so the error is not proportional to g; the constant covers the greatest g.
    error.constant = kDivision * evaluation.operation * outside * horizon +
                     (numerator + kDenominator * outside * horizon) * lost * horizon / left;
    error.per_horizon = 0;
  } else {
    // If vertices are moved, 1/w at a place is at least 1/w − reach |∇(1/w)|.
    error.per_horizon *=
        m.least_inverse_w / (m.least_inverse_w - evaluation.reach * m.inverse_w_change);
  }
  return error;
}

SlopeError slope_error(const WindowTriangle& triangle, const std::array<double, 3>& values,
                       double value_error, const Evaluation& evaluation) {
  constexpr SlopeError kNothing{kWithoutEnd, kWithoutEnd};
  const Moved m = moved(triangle, evaluation.reach, 0);
  if (!(m.area > 0)) return kNothing;
  const double operation = evaluation.operation;
  const double lost = operation * m.sizes / m.area;  // δ k
  if (!(kArea * lost < 1)) return kNothing;
  const double least = std::min({values[0], values[1], values[2]});
  const auto along = [&](const std::array<double, 3>& weights) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += (values[i] - least) * weights[i];
    return sum / m.area;
  };
  const double product = kSlopeValue * value_error + kSlopeRange * operation * extent(values);
  const auto error = [&](const std::array<double, 3>& other_axis, double derivative) {
    const double size = extent(other_axis) + 2 * evaluation.reach;
    return (product * size / m.area + (kArea * lost + kDivision * operation) * derivative) /
           (1 - kArea * lost);
  };
  const double by_x = along(m.a);
  const double by_y = along(m.b);
  SlopeError slope;
  slope.most = std::hypot(by_x, by_y);
  slope.error = std::hypot(error(triangle.y, by_x), error(triangle.x, by_y));
  slope.error += kRoot * operation * (slope.most + slope.error);
  return slope;
}

double weight_change(const WindowTriangle& triangle, double reach, double distance) {
  const Moved m = moved(triangle, reach, distance);
  if (!(m.area > 0)) return kWithoutEnd;
  const double least = m.least_inverse_w - (distance + reach) * m.inverse_w_change;
  if (!(least > 0)) return kWithoutEnd;
  // The clip-space weights are ω_i = β_i/(w_i M). |∂ω_i| <= |∂β_i|/(w_i M) + |ω_i| |∂M|/M, and
  // |ω_i| <= (1 + ν_i) q/M. Each factor is replaced by its greatest value.
  const double outside = 3 + distance * m.weight_change();  // Σ (1 + ν_i)
  const double horizon = m.most_inverse_w / least;
  return distance * horizon * (m.weight_change() + outside * m.inverse_w_change / least);
}

}  // namespace rastercheck::backends
