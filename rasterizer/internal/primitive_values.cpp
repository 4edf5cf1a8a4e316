#include "rasterizer/internal/primitive_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rasterizer/internal/depth_store.h"

namespace rastercheck::rasterizer {
namespace {

double held(const DepthRange& range, double depth) {
  return std::clamp(depth, range.least, range.greatest);
}

/// The range of depths. Pixels beyond the ends of Bresenham's lines may leave that of the line.
DepthRange range_of(const State& state) {
  DepthRange range = depth_range(state);
  const bool may_leave =
      state.primitive == Primitive::lines && state.line_mode == LineMode::bresenham;
  const bool is_clamped =
      state.depth_clamp || state.convention == Convention::d3d || range.steps != 0;
  if (may_leave && !is_clamped) {
    range.least = -std::numeric_limits<double>::infinity();
    range.greatest = std::numeric_limits<double>::infinity();
  }
  return range;
}

}  // namespace

void PrimitiveValues::set_line(const State& state, const InputTriangle& line,
                               const LineWeights& weights, bool is_snapped) {
  is_point_ = false;
  const double w_a = line.positions[0].w;
  const double w_b = line.positions[1].w;
  e_ = weights.e;
  // A column with w = 1 is the vertex's divided by w_k, which multiplies the other's weight.
  if (is_snapped) {
    e_ = {combine({weights.e[0], ExactPlane()}, {w_b, 0}),
          combine({weights.e[1], ExactPlane()}, {w_a, 0})};
  }
  sum_ = combine(e_, {1, 1});
  // The parts that grow along the window cancel.
  constant_ = combine(e_, {w_a, w_b}).coefficients()[2];
  near_constant_ = ExactSum(constant_).nearest();
  set_depth(state, line);
  attributes_.assign(state.attributes.size(), {});
  for (std::size_t a = 0; a < attributes_.size(); ++a) set_attribute(state, line, a);
}

void PrimitiveValues::set_point(const State& state, const InputTriangle& point) {
  is_point_ = true;
  const glm::vec4& p = point.positions[0];
  range_ = range_of(state);
  depth_ = {};
  level_depth_ = range_.low + range_.span * (double{p.z} / double{p.w});
  reciprocal_w_ = 1 / double{p.w};
  attributes_.assign(state.attributes.size(), {});
  for (std::size_t a = 0; a < attributes_.size(); ++a) {
    attributes_[a].copy = point.attributes[0][a];
  }
}

void PrimitiveValues::set_depth(const State& state, const InputTriangle& line) {
  range_ = range_of(state);
  depth_ = {};
  const glm::vec4& a = line.positions[0];
  const glm::vec4& b = line.positions[1];
  if (double{a.z} * double{b.w} == double{b.z} * double{a.w}) {
    const glm::vec4& at = std::abs(a.w) < std::abs(b.w) ? b : a;
    level_depth_ = range_.low + range_.span * (double{at.z} / double{at.w});
    return;
  }
  depth_.kind = PrimitiveValue::Kind::affine;
  depth_.numerator = combine(e_, {a.z, b.z});
  // Depths have the unit of the window's, so z must be known to 2^-32 of 1.
  depth_.greatest = 1;
}

void PrimitiveValues::set_attribute(const State& state, const InputTriangle& line,
                                    std::size_t index) {
  PrimitiveValue& value = attributes_[index];
  const Interpolation interpolation = state.attributes[index].interpolation;
  const float r_a = line.attributes[0][index];
  const float r_b = line.attributes[1][index];
  value.copy = line.attributes[provoking_vertex(state)][index];
  if (interpolation == Interpolation::flat) return;
  const bool is_same_zero = r_a == 0 && r_b == 0 && std::signbit(r_a) == std::signbit(r_b);
  if (is_same_zero) return;
  const double together = double{r_a} + double{r_b};
  if (!std::isfinite(together)) {
    value.copy = static_cast<float>(together);
    return;
  }
  const double w_a = line.positions[0].w;
  const double w_b = line.positions[1].w;
  value.greatest = std::max(std::abs(r_a), std::abs(r_b));
  if (interpolation == Interpolation::smooth) {
    value.kind = PrimitiveValue::Kind::smooth;
    value.numerator = combine(e_, {r_a, r_b});
  } else {
    value.kind = PrimitiveValue::Kind::affine;
    value.numerator = combine(e_, {r_a * w_a, r_b * w_b});
  }
}

/// True if double says that both weights are positive, and so that the sample is between the ends
/// and at neither.
bool PrimitiveValues::is_between_ends(const HalfPixels& p) const {
  return std::all_of(e_.begin(), e_.end(), [&p](const ExactPlane& plane) {
    const NearValue weight = plane.near(p);
    return weight.value > weight.error;
  });
}

ExactSum PrimitiveValues::denominator(const PrimitiveValue& value, const HalfPixels& p) const {
  return value.kind == PrimitiveValue::Kind::smooth ? sum_.exact(p) : constant_;
}

double PrimitiveValues::quotient(const PrimitiveValue& value, const HalfPixels& p) const {
  constexpr double kMargin = 0x1p32;
  if (is_between_ends(p)) {
    const NearValue by = value.kind == PrimitiveValue::Kind::smooth
                             ? sum_.near(p)
                             : NearValue{near_constant_, 0x1p-52 * near_constant_};
    const NearValue above = value.numerator.near(p);
    if (by.value >= kMargin * by.error && kMargin * above.error <= value.greatest * by.value) {
      return above.value / by.value;
    }
  }
  ExactSum by = denominator(value, p);
  if (by.sign() <= 0) return value.copy;
  ExactSum above = value.numerator.exact(p);
  return above.nearest() / by.nearest();
}

float PrimitiveValues::depth(const HalfPixels& p) const {
  const bool is_level = depth_.kind == PrimitiveValue::Kind::copied;
  // Beyond the ends z may be infinite, which 0 must not be multiplied by.
  const double depth = is_level           ? level_depth_
                       : range_.span == 0 ? range_.low
                                          : range_.low + range_.span * quotient(depth_, p);
  return stored(held(range_, depth), range_.steps);
}

double PrimitiveValues::attribute(std::size_t index, const HalfPixels& p) const {
  const PrimitiveValue& value = attributes_[index];
  return value.kind == PrimitiveValue::Kind::copied ? value.copy : quotient(value, p);
}

WideSlopes PrimitiveValues::slopes(std::size_t index, const HalfPixels& p) const {
  const PrimitiveValue& value = attributes_[index];
  if (value.kind == PrimitiveValue::Kind::copied) return {};
  const bool is_smooth = value.kind == PrimitiveValue::Kind::smooth;
  const double r = quotient(value, p);
  const double by = denominator(value, p).nearest();
  WideSlopes slopes{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double below = is_smooth ? sum_.near_coefficients()[axis] : 0;
    // (N' − r D') / D, and twice that, since a plane's coefficients are of half pixels.
    slopes[axis] = 2 * ((value.numerator.near_coefficients()[axis] - r * below) / by);
  }
  return slopes;
}

double PrimitiveValues::floor(std::size_t index, const HalfPixels& p, double scale,
                              double period) const {
  const PrimitiveValue& value = attributes_[index];
  const auto of_copy = [&] { return std::fmod(std::floor(value.copy * scale), period); };
  if (value.kind == PrimitiveValue::Kind::copied) return of_copy();
  const ExactSum by = denominator(value, p);
  if (by.sign() <= 0) return of_copy();
  return exact_floor(value.numerator.exact(p), by, scale, period);
}

double PrimitiveValues::reciprocal_w(const HalfPixels& p) const {
  return is_point_ ? reciprocal_w_ : sum_.exact(p).nearest() / near_constant_;
}

}  // namespace rastercheck::rasterizer
