#include "rasterizer/internal/depth_bias.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "rasterizer/internal/depth_store.h"
#include "rasterizer/internal/exact_values.h"

namespace rastercheck::rasterizer {
namespace {

constexpr double kUnit = 0x1p-53;
/// Far beyond all depths of triangles with finite numbers, so that an offset that overflows is as
/// good as this one, and not infinite: an infinite depth minus it is no NaN.
constexpr double kMostOffset = 0x1p1000;

/// r of a unorm format; 0 for float32.
double unit_of(const State& state) {
  const double steps = depth_steps(state.depth_format);
  if (steps == 0) return 0;
  return state.convention == Convention::d3d ? double{static_cast<float>(1 / steps)}
                                             : 1 / (steps + 1);
}

/// 2^e <= number < 2^(e + 1); 0 for 0. The number must not be negative.
double power_below(double number) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(number) & kExponentBits);
}

/// 2^e of the greatest depth of the vertices, or 0 for 0; empty if double does not tell. The
/// kernels have the same operations.
std::optional<double> certain_power(const BiasTerms& bias, const ClipPositions& vertices) {
  double greatest = 0;
  for (const glm::vec4& p : vertices) {
    double depth = bias.greatest;
    if (p.w > 0) {
      depth = bias.low + bias.span * (double{p.z} / double{p.w});
      depth = std::min(std::max(depth, bias.least), bias.greatest);
    }
    greatest = std::max(greatest, depth);
  }
  const double below = power_below(std::max(greatest - bias.exponent_error, 0.0));
  const double above = power_below(greatest + bias.exponent_error);
  if (below != above) return std::nullopt;
  return below;
}

/// Adds (f − n) `factor` to the sum, in halves if the range is.
void add_span(const BiasTerms& bias, double factor, ExactSum& sum) {
  const double share = bias.is_halved ? 0.5 : 1;
  sum.add_product(bias.far * share, factor);
  sum.add_product(-bias.near * share, factor);
}

/// Adds the depth of z = 0 times `factor`.
void add_low(const BiasTerms& bias, double factor, ExactSum& sum) {
  const double share = bias.is_halved ? 0.5 : 1;
  sum.add_product(bias.near * share, factor);
  if (bias.is_halved) sum.add_product(bias.far * share, factor);
}

ExactSum times(const ExactSum& sum, double factor) {
  ExactSum product;
  for (const double component : sum.components()) product.add_product(component, factor);
  return product;
}

/// first + factor · second.
ExactSum combined(const ExactSum& first, double factor, const ExactSum& second) {
  ExactSum sum;
  for (const double component : first.components()) sum.add(component);
  for (const double component : second.components()) sum.add_product(component, factor);
  return sum;
}

/// 2^e of a vertex's depth, or 0 for 0, without rounding.
double exact_power(const BiasTerms& bias, const glm::vec4& p) {
  if (!(p.w > 0)) return power_below(bias.greatest);
  ExactSum scaled;  // the depth times w
  add_low(bias, p.w, scaled);
  add_span(bias, p.z, scaled);
  const auto sign_above = [&](double depth) {
    ExactSum rest;
    for (const double component : scaled.components()) rest.add(component);
    rest.add_product(-depth, p.w);
    return rest.sign();
  };
  if (sign_above(bias.greatest) >= 0) return power_below(bias.greatest);
  if (sign_above(bias.least) <= 0) return power_below(bias.least);
  // Two roundings leave the quotient next to the depth, or equal to it.
  const double power = power_below(scaled.nearest() / double{p.w});
  if (sign_above(power) < 0) return power / 2;
  return sign_above(2 * power) >= 0 ? 2 * power : power;
}

double exact_power(const BiasTerms& bias, const ClipPositions& vertices) {
  double power = 0;
  for (const glm::vec4& p : vertices) power = std::max(power, exact_power(bias, p));
  return power;
}

/// r · constant; empty if double does not tell.
std::optional<double> certain_level(const BiasTerms& bias, const ClipPositions& vertices) {
  if (bias.constant == 0) return 0;
  if (bias.unit != 0) return bias.unit * bias.constant;
  const std::optional<double> power = certain_power(bias, vertices);
  if (!power) return std::nullopt;
  return (*power * kFloatStep) * bias.constant;
}

double exact_level(const BiasTerms& bias, const ClipPositions& vertices) {
  const std::optional<double> level = certain_level(bias, vertices);
  return level ? *level : (exact_power(bias, vertices) * kFloatStep) * bias.constant;
}

/// m |det| T.
ExactSum exact_steepness(const BiasTerms& bias, const SlopedDepth& depth) {
  const ExactSum at = combine(depth.weights.exact_at(0, 0), depth.k);
  ExactSum along_u = combined(combine(depth.weights.exact_at(1, 0), depth.k), -1, at);
  ExactSum along_v = combined(combine(depth.weights.exact_at(0, 1), depth.k), -1, at);
  if (along_u.sign() < 0) along_u = times(along_u, -1);
  if (along_v.sign() < 0) along_v = times(along_v, -1);
  const ExactSum& steeper = combined(along_u, -1, along_v).sign() < 0 ? along_v : along_u;
  ExactSum scaled;
  for (const double component : steeper.components()) add_span(bias, component, scaled);
  return scaled.sign() < 0 ? times(scaled, -1) : scaled;
}

/// The offset from sums without rounding, of a plane that is not of constant depth.
DepthOffset exact_offset(const BiasTerms& bias, const ClipPositions& vertices,
                         const SlopedDepth& depth) {
  DepthOffset offset{0, exact_level(bias, vertices), bias.slope};
  ExactSum det = combine(depth.weights.exact_at(0, 0), depth.w);
  ExactSum scaled = combined(times(exact_steepness(bias, depth), bias.slope), offset.level, det);
  const int beyond = bias.clamp == 0 ? 0 : combined(scaled, -bias.clamp, det).sign();
  if ((bias.clamp > 0 && beyond > 0) || (bias.clamp < 0 && beyond < 0)) {
    offset.level = bias.clamp;
    offset.slope = 0;
  }
  if (offset.slope == 0) {
    offset.value = bias.clamped(offset.level);
    return offset;
  }
  offset.value = std::clamp(scaled.nearest() / det.nearest(), -kMostOffset, kMostOffset);
  return offset;
}

}  // namespace

BiasTerms bias_terms(const State& state) {
  BiasTerms bias;
  bias.is_any = !state.depth_bias.is_none();
  if (!bias.is_any) return bias;
  bias.constant = state.depth_bias.constant;
  bias.slope = state.depth_bias.slope;
  bias.clamp = state.depth_bias.clamp;
  bias.unit = unit_of(state);
  bias.near = state.viewport.min_depth;
  bias.far = state.viewport.max_depth;
  bias.is_halved = state.convention == Convention::opengl;
  bias.low = bias.is_halved ? (bias.near + bias.far) / 2 : bias.near;
  bias.span = bias.is_halved ? (bias.far - bias.near) / 2 : bias.far - bias.near;
  bias.least = std::min(bias.near, bias.far);
  bias.greatest = std::max(bias.near, bias.far);
  const bool is_quotient = bias.low == 0 && bias.span == 1;
  bias.exponent_error = is_quotient ? 0 : 8 * kUnit * bias.greatest;
  bias.may_leave =
      state.depth_clamp || state.snapping.has_value() || state.conservative == Conservative::outer;
  return bias;
}

DepthOffset level_offset(const BiasTerms& bias, const ClipPositions& vertices) {
  DepthOffset offset;
  offset.value = offset.level = bias.clamped(exact_level(bias, vertices));
  offset.is_deep = bias.is_deep(offset.value);
  return offset;
}

DepthOffset sloped_offset(const BiasTerms& bias, const ClipPositions& vertices,
                          const SlopedDepth& depth, const Plane& plane, double scale) {
  // The kernels have the same operations (group_bias-inl.h).
  const std::optional<double> level = certain_level(bias, vertices);
  const double u_step = std::abs(2 * depth.weights.frame->u.scale);
  const double v_step = std::abs(2 * depth.weights.frame->v.scale);
  const auto& [e, f, g] = depth.weights.edges;
  const auto& k = depth.k;
  const auto size = [&](double first, double second, double third) {
    return ((std::abs(k[0] * first) + std::abs(k[1] * second)) + std::abs(k[2] * third)) *
           std::abs(scale);
  };
  const double u_size = size(e.a.value, f.a.value, g.a.value) * u_step;
  const double v_size = size(e.b.value, f.b.value, g.b.value) * v_step;
  const double rise = bias.slope * std::max(std::abs(plane.a) * u_step, std::abs(plane.b) * v_step);
  if (level) {
    const double terms = std::abs(bias.slope) * std::max(u_size, v_size) + std::abs(*level);
    const double offset = bias.clamped(rise + *level);
    if (bias.is_certain(std::abs(rise), terms) && !bias.is_deep(offset)) return {offset};
  }
  DepthOffset offset = exact_offset(bias, vertices, depth);
  offset.is_deep = bias.is_deep(offset.value);
  return offset;
}

double deep_level_depth(const BiasTerms& bias, const DepthOffset& offset, double z, double w) {
  // Two doubles hold z/w to 2^-105 of it. They depend on the quotient only, so equal quotients give
  // equal depths.
  const double quotient = z / w;
  const double rest = std::fma(-quotient, w, z) / w;
  ExactSum sum;
  add_low(bias, 1, sum);
  add_span(bias, quotient, sum);
  add_span(bias, rest, sum);
  sum.add(offset.value);
  return sum.nearest();
}

double deep_depth_at(const BiasTerms& bias, const DepthOffset& offset, const SlopedDepth& depth,
                     double u, double v) {
  const std::array<ExactSum, 3> e = depth.weights.exact_at(u, v);
  ExactSum det = combine(e, depth.w);
  const ExactSum z = combine(e, depth.k);
  ExactSum sum;
  for (const double component : z.components()) add_span(bias, component, sum);
  for (const double component : det.components()) add_low(bias, component, sum);
  for (const double component : det.components()) sum.add_product(component, offset.level);
  if (offset.slope != 0) sum = combined(sum, offset.slope, exact_steepness(bias, depth));
  return sum.nearest() / det.nearest();
}

}  // namespace rastercheck::rasterizer
