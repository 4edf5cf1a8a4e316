// The maps of quads (quad.h). Errors, u = 2^-53, to first order.
//
// w_r. a_i and d_i are exact sums rounded once, with a relative error of 2 u (internal/exact_sum.h)
// even if terms cancel. So their quotient has a relative error of 5 u. Their scale factors are
// powers of two.
//
// Matrices. Let |M| be a matrix's formula with magnitudes in place of numbers. A product σ p has an
// error of 3 u, so S has an error of 4 u |S|, and T likewise. An element of adj S is a difference
// of two products of elements of S: its error is 10 u |adj S|. An element of T adj S is the sum of
// three products: its error is 4 + 10 + 1 + 2 = 17 u |T||adj S|. kMatrixError has one more u for
// second order and for the roundings of the sizes themselves.
//
// So u at a place p, u = (H p)_u / D, D = (H p)_q, has an error of at most ((δH |p|)_u +
// |u| (δH |p|)_q) / (D − (δH |p|)_q), where δH = 18 u |H| and three more roundings for H p; v
// likewise.
//
// Range. The σ_i, of which the greatest is in [1/2, 1), are more than 2^-66 and have 53 bits, so
// elements of S and T are multiples of 2^-268 below 2^129. On the way to the products, which are
// below 2^390, no nonzero number is smaller than 2^-900.

#include "rasterizer/methods/quad.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "rasterizer/internal/determinant.h"

namespace rastercheck::rasterizer {
namespace {

constexpr double kMostFactor = 0x1p64;

using Corners = std::array<glm::vec4, 4>;  // z is ignored

bool is_finite(const Quad& quad) {
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::vec4& p = quad.positions[i];
    const glm::vec2& r = quad.parameters[i];
    for (const float number : {p.x, p.y, p.w, r.x, r.y}) {
      if (!std::isfinite(number)) return false;
    }
  }
  return true;
}

/// Returns a_i of quad.h, for i = 0…3.
std::array<double, 4> turns(const Corners& p) {
  std::array<double, 4> a;
  for (std::size_t i = 0; i < 4; ++i) {
    a[i] = determinant(p[(i + 1) % 4], p[(i + 2) % 4], p[(i + 3) % 4]);
  }
  return a;
}

bool has_zero(const std::array<double, 4>& a) {
  return std::any_of(a.begin(), a.end(), [](double number) { return number == 0; });
}

/// True if all numbers have the same sign; none may be 0.
bool is_convex(const std::array<double, 4>& a) {
  return std::all_of(a.begin(), a.end(), [&](double number) { return (number > 0) == (a[0] > 0); });
}

/// Scales positive numbers by a power of two, so that the greatest is in [1/2, 1).
std::array<double, 4> scaled(std::array<double, 4> numbers) {
  int exponent = 0;
  std::frexp(*std::max_element(numbers.begin(), numbers.end()), &exponent);
  for (double& number : numbers) number = std::ldexp(number, -exponent);
  return numbers;
}

bool is_in_range(const std::array<double, 4>& sigma) {
  const auto [least, greatest] = std::minmax_element(sigma.begin(), sigma.end());
  return *greatest <= kMostFactor * *least;
}

std::array<double, 4> sigma_of(const std::array<double, 4>& a) {
  std::array<double, 4> sigma;
  for (std::size_t i = 0; i < 4; ++i) sigma[i] = std::abs(a[i]);
  return scaled(sigma);
}

std::array<glm::dvec3, 4> columns(const Corners& p) {
  std::array<glm::dvec3, 4> all;
  for (std::size_t i = 0; i < 4; ++i) all[i] = glm::dvec3(p[i].x, p[i].y, p[i].w);
  return all;
}

/// Computes the formula of a × b with a plus in place of each minus.
glm::dvec3 cross_of_sizes(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
}

SizedMatrix adjoint(const SizedMatrix& of) {
  const auto& [m, s] = of;
  return {glm::transpose(
              glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]))),
          glm::transpose(glm::dmat3(cross_of_sizes(s[1], s[2]), cross_of_sizes(s[2], s[0]),
                                    cross_of_sizes(s[0], s[1])))};
}

SizedMatrix product(const SizedMatrix& a, const SizedMatrix& b) {
  return {a.matrix * b.matrix, a.sizes * b.sizes};
}

}  // namespace

std::string_view to_string(QuadError error) {
  switch (error) {
    case QuadError::not_finite:
      return "a position or parameter of the quad is infinite or NaN";
    case QuadError::corners_in_line:
      return "three corners of the quad lie on a line on the screen";
    case QuadError::not_convex:
      return "the quad is not convex on the screen, or its corners are not in order";
    case QuadError::parameters_in_line:
      return "the parameters of three corners lie on a line";
    case QuadError::parameters_not_convex:
      return "the parameters of the corners are not a convex quad: the map has a pole inside";
    case QuadError::factors_out_of_range:
      return "the quad is so nearly degenerate that its map's numbers are out of range";
  }
  return "";
}

SizedMatrix square_to_quad(const std::array<glm::dvec3, 4>& corners,
                           const std::array<double, 4>& sigma) {
  std::array<glm::dvec3, 4> p;
  std::array<glm::dvec3, 4> sizes;
  for (std::size_t i = 0; i < 4; ++i) {
    p[i] = sigma[i] * corners[i];
    sizes[i] = glm::abs(p[i]);
  }
  return {glm::dmat3(p[1] - p[0], p[3] - p[0], p[0]),
          glm::dmat3(sizes[1] + sizes[0], sizes[3] + sizes[0], sizes[0])};
}

QuadResult infer(const Quad& quad) {
  if (!is_finite(quad)) return {QuadError::not_finite, {}};

  // The determinants a_i of the positions and d_i of the parameters.
  const std::array<double, 4> a = turns(quad.positions);
  if (has_zero(a)) return {QuadError::corners_in_line, {}};
  if (!is_convex(a)) return {QuadError::not_convex, {}};
  Corners parameters;
  for (std::size_t i = 0; i < 4; ++i) {
    parameters[i] = {quad.parameters[i].x, quad.parameters[i].y, 0, 1};
  }
  const std::array<double, 4> d = turns(parameters);
  if (has_zero(d)) return {QuadError::parameters_in_line, {}};
  if (!is_convex(d)) return {QuadError::parameters_not_convex, {}};

  // The factors σ_i, τ_i and w_r,i of the corners.
  const std::array<double, 4> sigma = sigma_of(a);
  const std::array<double, 4> tau = sigma_of(d);
  if (!is_in_range(sigma) || !is_in_range(tau)) return {QuadError::factors_out_of_range, {}};
  QuadMap map;
  for (std::size_t i = 0; i < 4; ++i) map.w_r[i] = tau[i] / sigma[i];
  map.w_r = scaled(map.w_r);

  // The maps from the square to positions and to parameters, then between positions and parameters.
  const SizedMatrix to_positions = square_to_quad(columns(quad.positions), sigma);
  const SizedMatrix to_parameters = square_to_quad(columns(parameters), tau);
  map.to_parameters = product(to_parameters, adjoint(to_positions));
  map.to_clip = product(to_positions, adjoint(to_parameters));
  return {std::nullopt, map};
}

}  // namespace rastercheck::rasterizer
