// The maps of quads (quad.h). Errors, u = 2^-53, to first order.
//
// w_r. a_i and d_i are exact sums rounded once, to 2 u (internal/exact_sum.h), whatever is lost in
// them by cancellation: their quotient is off by 5 u of itself. What scales them is a power of two.
//
// Matrices. With |M| for a matrix's formula of magnitudes: a product σ p has 3 u, so that S is off
// by 4 u |S|, T alike. A number of adj is a difference of two products of two such: 10 u |adj|. A
// number of T adj S is the sum of three products: 4 + 10 + 1 + 2 = 17 u |T||adj S|. kMatrixError
// has one more for what is of second order and for the roundings of the sizes themselves.
//
// So u at a place p, u = (H p)_u / D, D = (H p)_q, is off by at most ((δH |p|)_u + |u| (δH |p|)_q)
// / (D − (δH |p|)_q), where δH = 18 u |H| and three roundings more for H p; v alike.
//
// Range. σ_i, the greatest in [1/2, 1), is more than 2^-66 and has 53 bits, so that numbers of S
// and T are multiples of 2^-268 below 2^129. On the way to those of the products, below 2^390, no
// number but 0 is smaller than 2^-900.

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

using Corners = std::array<glm::vec4, 4>;  // z has no say

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

/// a_i of the header, for i = 0…3.
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

/// Whether all have one sign; none is 0.
bool is_convex(const std::array<double, 4>& a) {
  return std::all_of(a.begin(), a.end(), [&](double number) { return (number > 0) == (a[0] > 0); });
}

/// Positive numbers times a power of two: the greatest is in [1/2, 1).
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

/// a × b with a plus for the minus.
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
      return "a position or parameter of the quad is infinite or no number";
    case QuadError::corners_in_line:
      return "three corners of the quad lie on a line on the screen";
    case QuadError::not_convex:
      return "the quad is not convex on the screen, or its corners are not in order";
    case QuadError::parameters_in_line:
      return "the parameters of three corners lie on a line";
    case QuadError::parameters_not_convex:
      return "the parameters of the corners are no convex quad: the map has a pole inside";
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

  // The turns of both sides.
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

  // The factors of the corners.
  const std::array<double, 4> sigma = sigma_of(a);
  const std::array<double, 4> tau = sigma_of(d);
  if (!is_in_range(sigma) || !is_in_range(tau)) return {QuadError::factors_out_of_range, {}};
  QuadMap map;
  for (std::size_t i = 0; i < 4; ++i) map.w_r[i] = tau[i] / sigma[i];
  map.w_r = scaled(map.w_r);

  // The square to both sides, and from one to the other.
  const SizedMatrix to_positions = square_to_quad(columns(quad.positions), sigma);
  const SizedMatrix to_parameters = square_to_quad(columns(parameters), tau);
  map.to_parameters = product(to_parameters, adjoint(to_positions));
  map.to_clip = product(to_positions, adjoint(to_parameters));
  return {std::nullopt, map};
}

}  // namespace rastercheck::rasterizer
