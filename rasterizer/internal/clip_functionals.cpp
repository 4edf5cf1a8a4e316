#include "rasterizer/internal/clip_functionals.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

Coefficient sum_of(float a, float b) {
  const TwoSum sum(a, b);
  return {sum.sum, sum.error};
}

/// Adds factor · (g.value + g.tail) to the sum. `factor` is an expansion.
void add_product(ExactSum& sum, const ExactSum& factor, const Coefficient& g) {
  for (const double component : factor.components()) {
    sum.add_product(component, g.value);
    if (g.tail != 0) sum.add_product(component, g.tail);
  }
}

/// The sign of g_0 c_0 + g_1 c_1 + g_2 c_2, where c_i is the given coefficient of each edge.
int exact_sign(const ClipFunctional& functional, const EdgeFunctions& edges,
               Coefficient EdgeFunction::*coefficient) {
  ExactSum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    ExactSum factor;
    factor.add((edges[i].*coefficient).tail);
    factor.add((edges[i].*coefficient).value);
    add_product(sum, factor, functional.g[i]);
  }
  return sum.sign();
}

bool keeps_zero(const ClipFunctional& functional, const EdgeFunctions& edges,
                const SampleFrame& frame, int tie_sign) {
  if (functional.is_closed) return true;
  return owns_zero(exact_sign(functional, edges, &EdgeFunction::a),
                   exact_sign(functional, edges, &EdgeFunction::b), frame, tie_sign);
}

}  // namespace

void clip_functionals(const State& state, const std::array<glm::vec4, 3>& corners,
                      const std::array<std::span<const float>, 3>& distances,
                      ClipFunctionals& out) {
  out.all.clear();
  out.hides_all = false;
  const auto add = [&out](const std::array<Coefficient, 3>& g, bool is_closed) {
    const auto all = [&g](auto holds) {
      return std::all_of(g.begin(), g.end(),
                         [holds](const Coefficient& c) { return holds(c.value); });
    };
    // At a covered sample no E_i is negative and at least one is positive, so the signs of the g_i
    // alone decide most planes. If all g_i are 0, the plane keeps everything.
    if (all([](double d) { return d > 0; }) || all([](double d) { return d == 0; })) return;
    if (is_closed && all([](double d) { return d >= 0; })) return;
    out.hides_all = out.hides_all || all([](double d) { return d < 0; });
    out.all.push_back({g, is_closed});
  };
  if (!state.depth_clamp) {
    std::array<Coefficient, 3> near;
    std::array<Coefficient, 3> far;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec4& p = corners[i];
      near[i] = sum_of(p.z, state.convention == Convention::opengl ? p.w : 0.0F);
      far[i] = sum_of(p.w, -p.z);
    }
    add(near, true);
    add(far, true);
  }
  for (std::size_t d = 0; d < state.clip_distance_count; ++d) {
    std::array<Coefficient, 3> g;
    for (std::size_t i = 0; i < 3; ++i) g[i].value = distances[i][d];
    add(g, state.convention == Convention::d3d);
  }
}

bool is_kept(const ClipFunctional& functional, const EdgeFunctions& edges,
             const std::array<double, 3>& e, const SampleFrame& frame, double u, double v,
             int tie_sign) {
  // A term g_i E_i has the error of E_i, which is within the band, and four roundings: of g_i, of
  // the product and of two sums. They are 4 u |g_i E_i| to first order; 8 u covers everything.
  double value = 0;
  double error = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double g = functional.g[i].value;
    value += g * e[i];
    error += std::abs(g) * (edges[i].band + 8 * 0x1p-53 * std::abs(e[i]));
  }
  error *= 1 + 0x1p-50;  // it was rounded itself
  if (value > error) return true;
  if (value < -error) return false;

  ExactSum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    add_product(sum, exact_edge(edges[i], frame, u, v), functional.g[i]);
  }
  const int sign = sum.sign();
  return sign > 0 || (sign == 0 && keeps_zero(functional, edges, frame, tie_sign));
}

}  // namespace rastercheck::rasterizer
