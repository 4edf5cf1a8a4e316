#pragma once

// What methods share that evaluate smooth attributes at one place of the window at a time, whatever
// the order: coverage, depth and all other attributes come from draw_fragments; locations are found
// here; the method has a formula.
//
// A formula is a class template of the number type, so that it runs in double, in float, and with
// numbers that count operations (counted.h):
//
//   template <class T>
//   class Formula {
//    public:
//     void set_vertex(std::size_t i, const PointVertex& vertex, std::size_t count);  // i = 0, 1, 2
//     void set_up(std::size_t count);                                  // once for each triangle
//     void at(T u, T v, std::span<T> values) const;                    // once for each place
//   };
//
// Errors, u = 2^-53 (2^-24 of float). The window numerators (RULES §1)
//
//   X_i = x_i W/2 + w_i (x0 + W/2),     Y_i alike,
//
// have two products, the sum x0 + W/2 and one more, so that |δX_i| <= 3 u |X|_i with the sum of
// magnitudes |X|_i = |x_i W/2| + |w_i| (|x0| + |W/2|); w_i has none. Of the weight's coefficients
//
//   A_i = Y_j w_k − Y_k w_j,   B_i = w_j X_k − w_k X_j,   C_i = X_j Y_k − X_k Y_j
//
// each is off by at most 8 u of the sum of its terms' magnitudes, and E_i = A_i u + B_i v + C_i by
// 11 u |E|_i, with |E|_i(u, v) the same formula of magnitudes with all signs positive. Let
//
//   K = Σ |E|_i / Σ E_i        (of what is linear in the window  Σ |w_i| |E|_i / Σ w_i E_i).
//
// A quotient N/D of sums with |δN| <= n u M Σ|E|_i and |δD| <= d u Σ|E|_i, M = max(|r|, max|r_i|),
// is off by
//
//   |δN − r δD| / (D + δD) + u |r|  <=  2 (n + d) u K M + u M      where d u K <= 1/2,
//
// in scale ULP, ulp(M) >= 2^-24 M: 2 (n + d) 2^24 u K + 2^24 u, on top of the rounding to float32.
// Where d u K is greater the bound is more than 2^24, and nothing is promised. point_bound() is
// this formula.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/methods/internal/counted.h"
#include "rasterizer/methods/method.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A vertex in homogeneous window coordinates, (u w, v w, w), and its smooth attributes.
struct PointVertex {
  double x = 0;
  double y = 0;
  double w = 0;
  std::array<double, kMaxAttributes> values{};
  std::uint32_t index = 0;  ///< of the mesh
};

/// Unit roundoffs.
inline constexpr double kDoubleRoundoff = 0x1p-53;
inline constexpr double kFloatRoundoff = 0x1p-24;

/// The bound of a quotient N/D as above, computed with this unit roundoff.
constexpr MethodBound point_bound(int n, int d, double roundoff) {
  return {.constant = 0.5 + 0x1p24 * roundoff, .per_condition = 2 * (n + d) * 0x1p24 * roundoff};
}

/// A formula, of any number type.
class PointFormula {
 public:
  virtual ~PointFormula() = default;
  /// `count` values of each vertex are set. The triangle's determinant is not 0.
  virtual void set(const std::array<PointVertex, 3>& vertices, std::size_t count) = 0;
  virtual void at(double u, double v, std::span<double> values) const = 0;
};

/// Appends the fragments of every triangle. A value that comes out as NaN is given as that of the
/// first vertex: it is one of which nothing is promised. `tap`, unless nullptr, is shown
/// draw_fragments' own trace, the vertices, and smooth values before they are rounded.
DrawCounts draw_points(const State& state, const Mesh& mesh, const TargetSize& size,
                       PointFormula& formula, Fragments& fragments, MethodTap* tap);

template <template <class> class Formula, class T>
class PointFormulaOf : public PointFormula {
 public:
  void set(const std::array<PointVertex, 3>& vertices, std::size_t count) override {
    for (std::size_t i = 0; i < 3; ++i) formula_.set_vertex(i, vertices[i], count);
    formula_.set_up(count);
  }
  void at(double u, double v, std::span<double> values) const override {
    std::array<T, kMaxAttributes> computed;
    formula_.at(static_cast<T>(u), static_cast<T>(v), std::span(computed.data(), values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(computed[i]);
  }

 private:
  Formula<T> formula_;
};

/// DrawFragments of a formula.
template <template <class> class Formula, class T>
DrawCounts draw_by_formula(const State& state, const Mesh& mesh, const TargetSize& size,
                           Fragments& fragments, MethodTap* tap) {
  PointFormulaOf<Formula, T> formula;
  return draw_points(state, mesh, size, formula, fragments, tap);
}

/// A triangle in perspective, w = 1, 2 and 4, with two attributes.
std::array<PointVertex, 3> counted_triangle();

/// What a formula takes on a triangle with two attributes.
template <template <class> class Formula>
OperationCounts count_formula_on(const std::array<PointVertex, 3>& vertices) {
  constexpr std::size_t kCount = 2;
  Formula<Counted> formula;
  OperationCounts counts;
  for (std::size_t i = 0; i < 3; ++i) {
    counts.per_vertex = count_operations([&] { formula.set_vertex(i, vertices[i], kCount); });
  }
  counts.per_polygon = count_operations([&] { formula.set_up(kCount); });
  std::array<Counted, kCount> values;
  counts.per_pixel = count_operations([&] { formula.at(Counted(2.5), Counted(1.5), values); });
  return counts;
}

/// Method::operations of a formula.
template <template <class> class Formula>
OperationCounts count_formula() {
  return count_formula_on<Formula>(counted_triangle());
}

}  // namespace rastercheck::rasterizer
