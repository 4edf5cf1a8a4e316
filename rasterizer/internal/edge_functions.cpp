#include "rasterizer/internal/edge_functions.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

int sign(double value) { return (value > 0) - (value < 0); }

/// s (p q − r t), s = ±1; products of two floats are exact.
Coefficient minor_of(int s, float p, float q, float r, float t) {
  const TwoSum difference(s * double{p} * double{q}, -s * double{r} * double{t});
  return {difference.sum, difference.error};
}

/// True if evaluating the edge in double is exact everywhere in the draw.
bool is_exact(const EdgeFunction& edge, const SampleFrame& frame) {
  if (!frame.u.is_exact || !frame.v.is_exact) return false;
  if (edge.a.tail != 0 || edge.b.tail != 0 || edge.c.tail != 0) return false;
  const int grain =
      std::min({lowest_bit(edge.a.value) + frame.u.grain, lowest_bit(edge.b.value) + frame.v.grain,
                lowest_bit(edge.c.value) + lowest_bit(frame.t)});
  // The factor 4 covers the rounding of S and the terms up to 3 S of helper lanes, which lie up to
  // a pixel beyond the draw (certificates.h).
  return 4 * edge.greatest < std::ldexp(1.0, std::min(grain + 53, 1000));
}

void add_products(ExactSum& sum, const Coefficient& coefficient, const ExactCoordinate& at) {
  for (std::size_t i = 0; i < at.size; ++i) {
    // scale · part is exactly high + low.
    const double high = at.scale * at.parts[i];
    const double low = std::fma(at.scale, at.parts[i], -high);
    for (const double factor : {high, low}) {
      if (factor == 0) continue;
      sum.add_product(coefficient.value, factor);
      if (coefficient.tail != 0) sum.add_product(coefficient.tail, factor);
    }
  }
}

}  // namespace

bool owns_zero(int a, int b, const SampleFrame& frame, int tie_sign) {
  const int along_u = a * frame.u.direction;
  const int along_v = b * frame.v.direction;
  return along_u > 0 || (along_u == 0 && tie_sign * along_v > 0);
}

EdgeFunctions edge_functions(const std::array<glm::vec4, 3>& corners, int orientation,
                             const SampleFrame& frame, int tie_sign) {
  EdgeFunctions edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& p = corners[(i + 1) % 3];
    const glm::vec4& q = corners[(i + 2) % 3];
    EdgeFunction& edge = edges[i];
    edge.a = minor_of(orientation, p.y, q.w, p.w, q.y);
    edge.b = minor_of(orientation, p.w, q.x, p.x, q.w);
    edge.c = minor_of(orientation, p.x, q.y, p.y, q.x);
    edge.greatest = std::abs(edge.a.value) * frame.u.greatest +
                    std::abs(edge.b.value) * frame.v.greatest + std::abs(edge.c.value) * frame.t;
    constexpr double kUnit = 0x1p-53;
    edge.plane_band = 8 * kUnit * edge.greatest + std::abs(edge.a.value) * frame.u.error +
                      std::abs(edge.b.value) * frame.v.error;
    if (!is_exact(edge, frame)) edge.band = edge.plane_band;
    edge.owns_zero = owns_zero(sign(edge.a.value), sign(edge.b.value), frame, tie_sign);
  }
  return edges;
}

ExactSum exact_edge(const EdgeFunction& edge, const SampleFrame& frame, double u, double v) {
  ExactSum sum;
  add_products(sum, edge.a, exact_at(frame.u, u));
  add_products(sum, edge.b, exact_at(frame.v, v));
  sum.add_product(edge.c.value, frame.t);
  if (edge.c.tail != 0) sum.add_product(edge.c.tail, frame.t);
  return sum;
}

}  // namespace rastercheck::rasterizer
