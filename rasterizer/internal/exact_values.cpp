#include "rasterizer/internal/exact_values.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

constexpr double kUnit = 0x1p-53;

using Corners = std::array<glm::vec4, 3>;

/// |det (x, y, w)|: the six triple products without rounding, summed once.
double determinant(const Corners& p) {
  ExactSum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& q = p[(i + 1) % 3];
    const glm::vec4& r = p[(i + 2) % 3];
    sum.add_product(double{q.y} * double{r.w}, p[i].x);
    sum.add_product(-double{r.y} * double{q.w}, p[i].x);
  }
  return std::abs(sum.nearest());
}

bool has_equal_depth(const Corners& p) {
  const auto is_equal = [](const glm::vec4& a, const glm::vec4& b) {
    return double{a.z} * double{b.w} == double{b.z} * double{a.w};
  };
  return is_equal(p[0], p[1]) && is_equal(p[1], p[2]) && is_equal(p[2], p[0]);
}

/// The vertex with the largest |w|: z/w there is that of the whole plane.
double plane_depth(const Corners& p) {
  const glm::vec4& at = *std::max_element(p.begin(), p.end(), [](const auto& a, const auto& b) {
    return std::abs(a.w) < std::abs(b.w);
  });
  return double{at.z} / double{at.w};
}

float depth_of(const DepthLine& line, double z) {
  return static_cast<float>(std::clamp(line.low + line.span * z, line.least, line.greatest));
}

bool is_same_zero(float a, float b, float c) {
  return a == 0 && b == 0 && c == 0 && std::signbit(a) == std::signbit(b) &&
         std::signbit(b) == std::signbit(c);
}

void set_up_depth(const State& state, const Corners& p, const EdgeFunctions& edges,
                  TriangleValues& out) {
  const double near = state.viewport.min_depth;
  const double far = state.viewport.max_depth;
  const bool is_halved = state.convention == Convention::opengl;
  DepthLine& line = out.depth;
  line.span = is_halved ? (far - near) / 2 : far - near;
  line.low = is_halved ? (near + far) / 2 : near;
  line.least = std::min(near, far);
  line.greatest = std::max(near, far);
  line.scale = 1 / out.det_t;
  double error = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    line.k[i] = p[i].z;
    error += std::abs(double{p[i].z}) * (edges[i].band + 8 * kUnit * edges[i].greatest);
  }
  out.depth_is_certain = error * 0x1p31 <= out.det_t;
  out.has_constant_depth = has_equal_depth(p);
  if (out.has_constant_depth) out.constant_depth = depth_of(line, plane_depth(p));
}

struct ExactWeights {
  std::array<ExactSum, 3> e;
  ExactWeights(const EdgeFunctions& edges, const SampleFrame& frame, double u, double v)
      : e{exact_edge(edges[0], frame, u, v), exact_edge(edges[1], frame, u, v),
          exact_edge(edges[2], frame, u, v)} {}

  /// Σ k_i E_i.
  ExactSum combine(const std::array<double, 3>& k) const {
    ExactSum sum;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const double component : e[i].components()) sum.add_product(component, k[i]);
    }
    return sum;
  }
};

}  // namespace

void set_up_values(const State& state, const Corners& corners,
                   const std::array<std::span<const float>, 3>& values, const EdgeFunctions& edges,
                   const SampleFrame& frame, TriangleValues& out) {
  out.det_t = determinant(corners) * frame.t;
  out.band_sum = edges[0].band + edges[1].band + edges[2].band;
  out.least_sum = 0x1p32 * out.band_sum;
  double error = 0;
  bool all_in_front = true;
  for (std::size_t i = 0; i < 3; ++i) {
    out.affine_error[i] = std::abs(double{corners[i].w}) * edges[i].band;
    error += out.affine_error[i];
    all_in_front = all_in_front && corners[i].w > 0;
  }
  // Inside a triangle with all w > 0 the w_i E_i are shares of |det| T: their roundings are few.
  out.affine_is_certain = all_in_front && error * 0x1p33 <= out.det_t;
  set_up_depth(state, corners, edges, out);

  const std::size_t provoking = state.convention == Convention::opengl ? 2 : 0;
  out.attributes.resize(state.attributes.size());
  for (std::size_t a = 0; a < state.attributes.size(); ++a) {
    const std::array<float, 3> r{values[0][a], values[1][a], values[2][a]};
    ValueLine& line = out.attributes[a];
    line.copy = r[provoking];
    const Interpolation interpolation = state.attributes[a].interpolation;
    if (interpolation == Interpolation::flat || is_same_zero(r[0], r[1], r[2])) {
      line.kind = ValueLine::Kind::copied;
      continue;
    }
    const bool is_smooth = interpolation == Interpolation::smooth;
    line.kind = is_smooth ? ValueLine::Kind::smooth : ValueLine::Kind::affine;
    for (std::size_t i = 0; i < 3; ++i) {
      line.numerators[i] = is_smooth ? r[i] : double{r[i]} * double{corners[i].w};
    }
  }
}

float exact_value_at(const ValueLine& line, const TriangleValues& triangle,
                     const EdgeFunctions& edges, const SampleFrame& frame, double u, double v) {
  if (line.kind == ValueLine::Kind::copied) return line.copy;
  // Infinities and NaNs have no place in an exact sum; those of finite attributes are below 2^258.
  const double together = line.numerators[0] + line.numerators[1] + line.numerators[2];
  if (!std::isfinite(together)) return static_cast<float>(together);
  const ExactWeights weights(edges, frame, u, v);
  const double numerator = weights.combine(line.numerators).nearest();
  if (line.kind == ValueLine::Kind::affine) return static_cast<float>(numerator / triangle.det_t);
  const double sum = weights.combine({1, 1, 1}).nearest();
  return sum > 0 ? static_cast<float>(numerator / sum) : line.copy;
}

float value_at(const ValueLine& line, const TriangleValues& triangle, const EdgeFunctions& edges,
               const SampleFrame& frame, double u, double v) {
  if (line.kind == ValueLine::Kind::copied) return line.copy;
  double numerator = 0;
  double sum = 0;
  double size = 0;
  double affine_error = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double e = edges[i].at(frame, u, edges[i].row(frame, v));
    numerator += line.numerators[i] * e;
    sum += e;
    size += std::abs(e);
  }
  if (line.kind == ValueLine::Kind::smooth) {
    const bool is_certain = sum > 0x1p32 * (triangle.band_sum + 8 * kUnit * size);
    if (is_certain) return static_cast<float>(numerator / sum);
  } else {
    for (const double error : triangle.affine_error) affine_error += error;
    const bool is_certain =
        triangle.affine_is_certain && size == sum && affine_error * 0x1p32 <= triangle.det_t;
    if (is_certain) return static_cast<float>(numerator / triangle.det_t);
  }
  return exact_value_at(line, triangle, edges, frame, u, v);
}

float exact_depth_at(const TriangleValues& triangle, const EdgeFunctions& edges,
                     const SampleFrame& frame, double u, double v) {
  if (triangle.has_constant_depth) return triangle.constant_depth;
  const ExactWeights weights(edges, frame, u, v);
  return depth_of(triangle.depth, weights.combine(triangle.depth.k).nearest() / triangle.det_t);
}

}  // namespace rastercheck::rasterizer
