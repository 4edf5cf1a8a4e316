#pragma once

// Shared part of the methods that evaluate smooth attributes at one place of the window at a time,
// in any order. draw_fragments computes coverage, depth and all other attributes. The code here
// finds the places at which attributes are evaluated (sample, centre or centroid). The method
// supplies a formula.
//
// A formula is a class template over the number type, so that it runs in double, in float, and with
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
// Errors, ε = 2^-53 (2^-24 for float). The window numerators (RULES §1)
//
//   X_i = x_i W/2 + w_i (x0 + W/2),     Y_i likewise,
//
// have two products, the sum x0 + W/2 and one more sum, so that |δX_i| <= 3 ε |X|_i with the sum of
// magnitudes |X|_i = |x_i W/2| + |w_i| (|x0| + |W/2|); w_i has no error. Each coefficient of the
// weight E_i,
//
//   A_i = Y_j w_k − Y_k w_j,   B_i = w_j X_k − w_k X_j,   C_i = X_j Y_k − X_k Y_j
//
// has an error of at most 8 ε times the sum of its terms' magnitudes, and E_i = A_i u + B_i v + C_i
// has an error of at most 11 ε |E|_i, where |E|_i(u, v) is the same formula with magnitudes in
// place of numbers and all signs positive. Let
//
//   K = Σ |E|_i / Σ E_i        (for values linear in the window  Σ |w_i| |E|_i / Σ w_i E_i).
//
// A quotient N/D of sums with |δN| <= n ε M Σ|E|_i and |δD| <= d ε Σ|E|_i, M = max(|r|, max|r_i|),
// has an error of
//
//   |δN − r δD| / (D + δD) + ε |r|  <=  2 (n + d) ε K M + ε M      if d ε K <= 1/2,
//
// that is, 2 (n + d) 2^24 ε K + 2^24 ε scale ULP, because ulp(M) >= 2^-24 M. The rounding to
// float32 comes on top. If d ε K is greater, the bound exceeds 2^24 and nothing is promised.
// point_bound() is this formula.

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
  std::uint32_t index = 0;  ///< in the mesh
};

/// Unit roundoffs.
inline constexpr double kDoubleRoundoff = 0x1p-53;
inline constexpr double kFloatRoundoff = 0x1p-24;

/// The bound of a quotient N/D as above, computed with the given unit roundoff.
constexpr MethodBound point_bound(int n, int d, double roundoff) {
  return {.constant = 0.5 + 0x1p24 * roundoff, .per_condition = 2 * (n + d) * 0x1p24 * roundoff};
}

/// The interface of a formula, whatever its number type.
class PointFormula {
 public:
  virtual ~PointFormula() = default;
  /// Sets `count` values of each vertex. The triangle's determinant must not be 0.
  virtual void set(const std::array<PointVertex, 3>& vertices, std::size_t count) = 0;
  virtual void at(double u, double v, std::span<double> values) const = 0;
};

/// Appends the fragments of every triangle. If a formula computes NaN, the first vertex's value is
/// stored instead; nothing is promised for such a value. `tap`, unless nullptr, records
/// draw_fragments' own trace, the vertices, and smooth values before rounding.
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

/// Implements DrawFragments for a formula.
template <template <class> class Formula, class T>
DrawCounts draw_by_formula(const State& state, const Mesh& mesh, const TargetSize& size,
                           Fragments& fragments, MethodTap* tap) {
  PointFormulaOf<Formula, T> formula;
  return draw_points(state, mesh, size, formula, fragments, tap);
}

/// Returns a triangle in perspective, w = 1, 2 and 4, with two attributes.
std::array<PointVertex, 3> counted_triangle();

/// Counts a formula's operations on a triangle with two attributes.
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

/// Implements Method::operations for a formula.
template <template <class> class Formula>
OperationCounts count_formula() {
  return count_formula_on<Formula>(counted_triangle());
}

}  // namespace rastercheck::rasterizer
