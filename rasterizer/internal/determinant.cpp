// The exact sign of a 3x3 determinant of float32 numbers.
//
//   det = x_a (y_b w_c − y_c w_b) + x_b (y_c w_a − y_a w_c) + x_c (y_a w_b − y_b w_a)
//
// The determinant is computed in double first, with an error bound. If the bound leaves the sign
// open, the six triple products are added up without rounding (exact_sum.h). A product of three
// floats is a multiple of 2^-447 below 2^384, so no double over- or underflows. Flush-to-zero must
// be off.

#include "rasterizer/internal/determinant.h"

#include <cmath>
#include <limits>

#include "rasterizer/internal/exact_sum.h"

namespace rastercheck::rasterizer {
namespace {

/// Unit roundoff of double, 2^-53.
constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;

int sign(double value) { return (value > 0) - (value < 0); }

/// Bounds the error of Σ x_i m_i in double; `magnitude` is the computed Σ |x_i m_i|. The two
/// products in a minor m_i are exact, as 24 + 24 <= 53 bits, so a minor has one rounding; then come
/// its product with x_i and two sums: four roundings, each within kUnit of a number below Σ |x_i
/// m_i|. The factor 8 rather than 4 takes in the second-order terms and the rounding of
/// `magnitude`, which itself is at least (1 − kUnit)^4 of the exact sum.
double determinant_error(double magnitude) { return 8 * kUnit * magnitude; }

/// Adds s x y w; `s` is 1 or −1.
void add_product(ExactSum& sum, float x, float y, float w, double s) {
  sum.add_product(s * double{x}, double{y} * double{w});
}

ExactSum exact_determinant(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c) {
  ExactSum sum;
  add_product(sum, a.x, b.y, c.w, 1);
  add_product(sum, a.x, c.y, b.w, -1);
  add_product(sum, b.x, c.y, a.w, 1);
  add_product(sum, b.x, a.y, c.w, -1);
  add_product(sum, c.x, a.y, b.w, 1);
  add_product(sum, c.x, b.y, a.w, -1);
  return sum;
}

/// y_p w_q − y_q w_p, with one rounding.
double minor_of(const glm::vec4& p, const glm::vec4& q) {
  return double{p.y} * double{q.w} - double{q.y} * double{p.w};
}

}  // namespace

int determinant_sign(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c) {
  const double from_a = double{a.x} * minor_of(b, c);
  const double from_b = double{b.x} * minor_of(c, a);
  const double from_c = double{c.x} * minor_of(a, b);
  const double determinant = from_a + from_b + from_c;
  const double magnitude = std::abs(from_a) + std::abs(from_b) + std::abs(from_c);
  if (std::abs(determinant) > determinant_error(magnitude)) return sign(determinant);
  return exact_determinant(a, b, c).sign();
}

double determinant(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c) {
  return exact_determinant(a, b, c).nearest();
}

}  // namespace rastercheck::rasterizer
