#include "rasterizer/internal/exact_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rasterizer/internal/depth_store.h"
#include "rasterizer/internal/float_kernels.h"

namespace rastercheck::rasterizer {
namespace {

using Positions = std::array<glm::vec4, 3>;

bool has_equal_depth(const Positions& p) {
  const auto is_equal = [](const glm::vec4& a, const glm::vec4& b) {
    return double{a.z} * double{b.w} == double{b.z} * double{a.w};
  };
  return is_equal(p[0], p[1]) && is_equal(p[1], p[2]) && is_equal(p[2], p[0]);
}

/// The vertex that gives a plane of constant depth its z/w: the one with the largest |w|.
const glm::vec4& plane_vertex(const Positions& p) {
  return *std::max_element(p.begin(), p.end(), [](const auto& a, const auto& b) {
    return std::abs(a.w) < std::abs(b.w);
  });
}

double held_depth(const DepthLine& line, double depth) {
  return std::clamp(depth, line.least, line.greatest);
}

bool is_same_zero(float a, float b, float c) {
  return a == 0 && b == 0 && c == 0 && std::signbit(a) == std::signbit(b) &&
         std::signbit(b) == std::signbit(c);
}

/// Returns the value, at a corner that clipping may have made, of a quantity that is affine over
/// the triangle.
double at_corner(const std::array<double, 3>& of_vertices, const GridCorner& corner) {
  double value = 0;
  for (std::size_t v = 0; v < 3; ++v) {
    // The value of a vertex without a share may be NaN or infinite.
    if (corner.share[v] != 0) value += corner.share[v] * of_vertices[v];
  }
  return value;
}

bool has_new_corner(const ValueSource& source) {
  return std::any_of(source.corners.begin(), source.corners.end(),
                     [](const GridCorner* corner) { return corner != nullptr && corner->is_new; });
}

/// A power of two `scale` for which scale · E_i < 1 at all samples.
double float_scale(const Weights& weights) {
  double greatest = 0;
  for (const EdgeFunction& edge : weights.edges) greatest = std::max(greatest, edge.greatest);
  return greatest > 0 ? std::ldexp(1.0, -std::ilogb(greatest) - 2) : 1;
}

}  // namespace

ExactSum combine(const std::array<ExactSum, 3>& e, const std::array<double, 3>& k) {
  ExactSum sum;
  for (std::size_t i = 0; i < 3; ++i) sum.add_product(e[i], k[i]);
  return sum;
}

DepthRange depth_range(const State& state) {
  // Turns −0 into 0, because the greater of two zeros may or may not be −0.
  const double near = state.viewport.min_depth + 0.0;
  const double far = state.viewport.max_depth + 0.0;
  const bool is_halved = state.convention == Convention::opengl;
  DepthRange range;
  range.span = is_halved ? (far - near) / 2 : far - near;
  range.low = is_halved ? (near + far) / 2 : near;
  range.least = std::min(near, far);
  range.greatest = std::max(near, far);
  // Clipping keeps depths within the range. But depths come from the plane of the clip positions'
  // triangle. A snapped triangle can reach beyond that triangle, and samples of a conservatively
  // covered pixel can lie outside it; their depths can then leave the range.
  const bool is_clamped = state.depth_clamp || state.convention == Convention::d3d;
  const bool may_leave = state.snapping || state.conservative == Conservative::outer;
  if (may_leave && !is_clamped) {
    range.least = -std::numeric_limits<double>::infinity();
    range.greatest = std::numeric_limits<double>::infinity();
  }
  range.steps = depth_steps(state.depth_format);
  if ((range.steps != 0 || !state.depth_bias.is_none()) && !is_clamped) {
    range.least = 0;
    range.greatest = 1;
  }
  return range;
}

std::size_t provoking_vertex(const State& state) {
  return state.convention == Convention::opengl ? 2 : 0;
}

namespace {

/// Makes the plane of depth that of constant depth z/w, with the bias.
void set_level_depth(const State& state, const Positions& p, double z, double w,
                     TriangleValues& out) {
  DepthLine& depth = out.depth;
  out.has_constant_depth = true;
  depth.plane = {0, 0, depth.low + depth.span * (z / w)};
  if (state.depth_bias.is_none()) return;
  out.bias = bias_terms(state);
  depth.offset = level_offset(out.bias, p);
  depth.plane.c = depth.offset.is_deep ? deep_level_depth(out.bias, depth.offset, z, w)
                                       : depth.plane.c + depth.offset.value;
}

/// Makes the plane of depth that of the weights, with the bias.
void set_sloped_depth(const State& state, const Positions& p, const Weights& weights,
                      TriangleValues& out) {
  DepthLine& depth = out.depth;
  const double scale = depth.span * (1 / weights.det_t);
  depth.plane = plane_of(weights.edges, depth.k, *weights.frame, scale, depth.low);
  if (state.depth_bias.is_none()) return;
  out.bias = bias_terms(state);
  depth.offset = sloped_offset(out.bias, p, {weights, out.w, depth.k}, depth.plane, scale);
  depth.plane.c += depth.offset.value;
  if (depth.offset.is_deep) out.certificates.depth_is_certain = false;
}

}  // namespace

void set_up_values(const State& state, const ValueSource& source, const Weights& weights,
                   TriangleValues& out) {
  const Positions& p = source.positions;
  const std::array<double, 3> vertex_w{p[0].w, p[1].w, p[2].w};
  out.w = vertex_w;
  const bool has_one_w = p[0].w == p[1].w && p[1].w == p[2].w && p[0].w > 0;
  out.depth = {depth_range(state), {p[0].z, p[1].z, p[2].z}, {}};
  const bool is_placed = source.corners[0] != nullptr;
  if (is_placed) {
    for (std::size_t i = 0; i < 3; ++i) {
      out.w[i] = source.corners[i]->w;
      out.depth.k[i] = source.corners[i]->z;
    }
  }
  out.certificates = certify(weights, out.w, out.depth.k);
  out.has_constant_depth = has_equal_depth(p);
  if (out.has_constant_depth) {
    const glm::vec4& at = plane_vertex(p);
    set_level_depth(state, p, at.z, at.w, out);
  } else {
    set_sloped_depth(state, p, weights, out);
  }
  out.sum = plane_of(weights.edges, {1, 1, 1}, *weights.frame);

  const std::size_t provoking = provoking_vertex(state);
  out.attributes.resize(state.attributes.size());
  out.has_smooth = false;
  out.has_smooth_float = false;
  out.has_affine_float = false;
  out.float_scale = float_scale(weights);
  const bool has_new = has_new_corner(source);
  const bool is_float = state.precision == Precision::float32 && !has_new;
  for (std::size_t a = 0; a < state.attributes.size(); ++a) {
    const std::array<float, 3> r{source.attributes[0][a], source.attributes[1][a],
                                 source.attributes[2][a]};
    ValueLine& line = out.attributes[a];
    line.copy = r[provoking];
    const Interpolation interpolation = state.attributes[a].interpolation;
    line.is_float = false;
    if (interpolation == Interpolation::flat || is_same_zero(r[0], r[1], r[2])) {
      line.kind = ValueLine::Kind::copied;
      continue;
    }
    // A value that all vertices share is copied. New corners are rounded and would change the value
    // slightly, which could select the wrong texel, because a texel may end at the shared value.
    if (has_new && r[0] == r[1] && r[1] == r[2] && r[0] != 0) {
      line.kind = ValueLine::Kind::copied;
      continue;
    }
    // Infinities and NaNs must not enter sums. The sum of three finite attributes is below 2^130.
    const double together = double{r[0]} + double{r[1]} + double{r[2]};
    if (!std::isfinite(together)) {
      line.kind = ValueLine::Kind::copied;
      line.copy = static_cast<float>(together);
      continue;
    }
    const bool is_divided = interpolation == Interpolation::smooth && !has_one_w;
    line.kind = is_divided ? ValueLine::Kind::smooth : ValueLine::Kind::affine;
    line.r = r;
    line.is_float = is_float && fits_float_precision(r);
    out.has_smooth = out.has_smooth || is_divided;
    out.has_smooth_float = out.has_smooth_float || (line.is_float && is_divided);
    out.has_affine_float = out.has_affine_float || (line.is_float && !is_divided);
    for (std::size_t i = 0; i < 3; ++i) {
      line.numerators[i] = is_divided ? r[i] : double{r[i]} * vertex_w[i];
    }
    if (is_placed) {
      const std::array<double, 3> of_vertices = line.numerators;
      for (std::size_t i = 0; i < 3; ++i) {
        line.numerators[i] = at_corner(of_vertices, *source.corners[i]);
      }
    }
    const double scale = is_divided ? 1 : 1 / weights.det_t;
    line.plane = plane_of(weights.edges, line.numerators, *weights.frame, scale);
  }
}

void set_up_flat_values(const State& state, const ValueSource& source, TriangleValues& out) {
  const std::size_t provoking = provoking_vertex(state);
  const glm::vec4& p = source.positions[provoking];
  out = TriangleValues();
  out.depth = {depth_range(state), {}, {}};
  if (has_equal_depth(source.positions)) {
    const glm::vec4& at = plane_vertex(source.positions);
    set_level_depth(state, source.positions, at.z, at.w, out);
  } else {
    const bool is_in_front = p.w > 0;
    set_level_depth(state, source.positions, is_in_front ? p.z : 0, is_in_front ? p.w : 1, out);
  }
  out.attributes.resize(state.attributes.size());
  for (std::size_t a = 0; a < state.attributes.size(); ++a) {
    out.attributes[a].copy = source.attributes[provoking][a];
  }
}

double exact_value_at(const ValueLine& line, const Weights& weights, double u, double v) {
  if (line.kind == ValueLine::Kind::copied) return line.copy;
  const std::array<ExactSum, 3> e = weights.exact_at(u, v);
  const double numerator = combine(e, line.numerators).nearest();
  if (line.kind == ValueLine::Kind::affine) return numerator / weights.exact_det_t();
  const double sum = combine(e, {1, 1, 1}).nearest();
  return sum > 0 ? numerator / sum : line.copy;
}

double exact_floor(const ExactSum& numerator, ExactSum denominator, double scale, double period) {
  ExactSum rest;
  rest.add_product(numerator, scale);
  // Long division: each step adds an estimate of ⌊rest / denominator⌋ to `floor` and subtracts this
  // multiple of the denominator from the rest, until the estimate is 0.
  double floor = 0;
  for (;;) {
    const double quotient = std::floor(rest.nearest() / denominator.nearest());
    ExactSum left;
    for (const double component : rest.components()) left.add(component);
    left.add_product(denominator, -quotient);
    if (left.sign() < 0 && std::abs(quotient) <= 1) return floor + quotient - 1;
    floor = std::fmod(floor + std::fmod(quotient, period), period);
    if (quotient == 0) {
      // nearest() may round equal sums differently, so a whole denominator may still be left.
      for (const double component : denominator.components()) left.add(-component);
      return left.sign() < 0 ? floor : floor + 1;
    }
    rest = left;
  }
}

double exact_floor_at(const ValueLine& line, const TriangleValues& triangle, const Weights& weights,
                      double u, double v, double scale, double period) {
  const auto of_copy = [&] { return std::fmod(std::floor(line.copy * scale), period); };
  if (line.kind == ValueLine::Kind::copied) return of_copy();
  const std::array<ExactSum, 3> e = weights.exact_at(u, v);
  // The denominator is Σ E_i or, for an affine value, Σ w_i E_i, which is constant.
  const bool is_affine = line.kind == ValueLine::Kind::affine;
  ExactSum denominator = combine(e, is_affine ? triangle.w : std::array<double, 3>{1, 1, 1});
  if (denominator.sign() <= 0) return of_copy();
  return exact_floor(combine(e, line.numerators), denominator, scale, period);
}

bool is_certain(const ValueLine& line, const TriangleValues& triangle, double det_t,
                const std::array<double, 3>& e) {
  return line.kind == ValueLine::Kind::smooth ? triangle.certificates.is_smooth_certain(e)
                                              : triangle.certificates.is_affine_certain(e, det_t);
}

double value_at(const ValueLine& line, const TriangleValues& triangle, const Weights& weights,
                double u, double v) {
  if (line.kind == ValueLine::Kind::copied) return line.copy;
  const std::array<double, 3> e = weights.at(u, v);
  const double numerator =
      line.numerators[0] * e[0] + line.numerators[1] * e[1] + line.numerators[2] * e[2];
  if (line.kind == ValueLine::Kind::smooth) {
    if (triangle.certificates.is_smooth_certain(e)) return numerator / (e[0] + e[1] + e[2]);
  } else if (triangle.certificates.is_affine_certain(e, weights.det_t)) {
    return numerator / weights.det_t;
  }
  return exact_value_at(line, weights, u, v);
}

double exact_reciprocal_w_at(const Weights& weights, double u, double v) {
  return combine(weights.exact_at(u, v), {1, 1, 1}).nearest() / weights.exact_det_t();
}

double exact_depth_at(const TriangleValues& triangle, const Weights& weights, double u, double v) {
  const DepthLine& line = triangle.depth;
  if (triangle.has_constant_depth) return held_depth(line, line.plane.c);
  if (line.offset.is_deep) {
    return held_depth(
        line, deep_depth_at(triangle.bias, line.offset, {weights, triangle.w, line.k}, u, v));
  }
  // Outside the triangle z may be infinite, which 0 must not be multiplied by.
  if (line.span == 0) return held_depth(line, line.low + line.offset.value);
  const std::array<ExactSum, 3> e = weights.exact_at(u, v);
  const double z = combine(e, line.k).nearest() / weights.exact_det_t();
  return held_depth(line, (line.low + line.span * z) + line.offset.value);
}

}  // namespace rastercheck::rasterizer
