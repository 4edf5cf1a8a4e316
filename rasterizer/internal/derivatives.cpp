#include "rasterizer/internal/derivatives.h"

#include <cmath>

#include "rasterizer/internal/determinant.h"

namespace rastercheck::rasterizer {
namespace {

enum class Axis { u, v };

/// A number m 2^e, for products and quotients that exceed the range of double.
class Scaled {
 public:
  explicit Scaled(double value) { *this *= value; }
  Scaled& operator*=(double factor) {
    int exponent = 0;
    mantissa_ *= std::frexp(factor, &exponent);
    exponent_ += exponent;
    return *this;
  }
  /// The divisor must not be 0.
  Scaled& operator/=(double divisor) {
    int exponent = 0;
    mantissa_ /= std::frexp(divisor, &exponent);
    exponent_ -= exponent;
    return *this;
  }
  double value() const { return std::ldexp(mantissa_, exponent_); }

 private:
  double mantissa_ = 1;
  int exponent_ = 0;
};

bool is_placed(const ValueSource& source) { return source.corners[0] != nullptr; }

/// dU/du or dV/dv.
double step_of(const SampleFrame& frame, Axis axis) {
  return 2 * (axis == Axis::u ? frame.u.scale : frame.v.scale);
}

const Coefficient& coefficient(const EdgeFunction& edge, Axis axis) {
  return axis == Axis::u ? edge.a : edge.b;
}

/// Coefficient a or b of the line opposite corner i, for placed weights (weights.h). It is a whole
/// number below 2^33.
double line_coefficient(const ValueSource& source, int turn, std::size_t i, Axis axis) {
  const GridPoint& from = source.corners[(i + 1) % 3]->at;
  const GridPoint& to = source.corners[(i + 2) % 3]->at;
  const GridLine line = grid_line(from, to, turn);
  return static_cast<double>(axis == Axis::u ? line.a : line.b);
}

void add_products(ExactSum& sum, const std::array<double, 2>& parts, double factor) {
  for (const double part : parts) {
    if (part != 0) sum.add_product(part, factor);
  }
}

/// high + low = a b, exactly.
std::array<double, 2> product(double a, double b) {
  const double high = a * b;
  return {high, std::fma(a, b, -high)};
}

/// Σ n_i a_i, with a relative error of at most 2^-52. The a_i are the coefficients of the weights
/// that Weights::exact_at() returns, which may be a multiple of the E_i.
double exact_slope(const TriangleDerivatives& triangle, const Weights& weights,
                   const std::array<double, 3>& n, Axis axis) {
  ExactSum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!is_placed(triangle.source)) {
      const Coefficient& a = coefficient(weights.edges[i], axis);
      add_products(sum, {a.value, a.tail}, n[i]);
      continue;
    }
    // n_i L w_j w_k
    const double line = line_coefficient(triangle.source, triangle.turn, i, axis);
    const auto& corners = triangle.source.corners;
    for (const double ww : product(corners[(i + 1) % 3]->w, corners[(i + 2) % 3]->w)) {
      add_products(sum, product(ww, line), n[i]);
    }
  }
  return sum.nearest();
}

/// Adds factor · coordinate.
void add_coordinate(ExactSum& sum, double factor, const ExactCoordinate& at) {
  for (std::size_t i = 0; i < at.size; ++i) {
    add_products(sum, product(at.scale, at.parts[i]), factor);
  }
}

/// Σ (r_i − r_j) (w_k V − y_k T) or, along v, Σ (r_i − r_j) (x_k T − w_k U), with a relative error
/// of at most 2^-52. For placed weights the corners are (x_k, y_k, 1) w_k.
double exact_minors(const ValueSource& source, const SampleFrame& frame,
                    const std::array<double, 3>& r, Axis axis, const DerivativeSite& site) {
  ExactSum sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const TwoSum difference(r[(k + 1) % 3], -r[(k + 2) % 3]);
    const std::array<double, 2> parts{difference.sum, difference.error};
    if (is_placed(source)) {
      const GridCorner& corner = *source.corners[k];
      const double distance = axis == Axis::u
                                  ? frame.v.at(site.v) - static_cast<double>(corner.at.y)
                                  : static_cast<double>(corner.at.x) - frame.u.at(site.u);
      for (const double part : product(corner.w, distance)) add_products(sum, parts, part);
      continue;
    }
    const glm::vec4& p = source.positions[k];
    ExactSum minor;
    if (axis == Axis::u) {
      add_coordinate(minor, p.w, exact_at(frame.v, site.v));
      minor.add_product(-double{p.y}, frame.t);
    } else {
      add_coordinate(minor, -double{p.w}, exact_at(frame.u, site.u));
      minor.add_product(p.x, frame.t);
    }
    for (const double component : minor.components()) add_products(sum, parts, component);
  }
  return sum.nearest();
}

double exact_sum_of_weights(const Weights& weights, const DerivativeSite& site) {
  ExactSum sum;
  for (const ExactSum& e : weights.exact_at(site.u, site.v)) {
    for (const double component : e.components()) sum.add(component);
  }
  return sum.nearest();
}

WideSlopes exact_smooth_at(const TriangleDerivatives& triangle, const Weights& weights,
                           const std::array<double, 3>& r, const DerivativeSite& site) {
  const double d = exact_sum_of_weights(weights, site);
  if (d <= 0) return {};
  WideSlopes slopes{};
  for (const Axis axis : {Axis::u, Axis::v}) {
    const SampleFrame& frame = *weights.frame;
    Scaled slope(exact_minors(triangle.source, frame, r, axis, site));
    slope *= weights.exact_det_t();
    slope *= triangle.turn * step_of(frame, axis);
    slope /= frame.t;
    slope /= d;
    slope /= d;
    slopes[axis == Axis::u ? 0 : 1] = slope.value();
  }
  return slopes;
}

WideSlopes affine_slopes(const TriangleDerivatives& triangle, const Weights& weights,
                         const std::array<double, 3>& n) {
  WideSlopes slopes{};
  for (const Axis axis : {Axis::u, Axis::v}) {
    Scaled slope(exact_slope(triangle, weights, n, axis));
    slope *= step_of(*weights.frame, axis);
    slope /= weights.exact_det_t();
    slopes[axis == Axis::u ? 0 : 1] = slope.value();
  }
  return slopes;
}

int turn_of(const ValueSource& source) {
  if (!is_placed(source)) {
    const auto& p = source.positions;
    return determinant_sign(p[0], p[1], p[2]);
  }
  const auto& corners = source.corners;
  return sign(grid_line(corners[1]->at, corners[2]->at, 1).at(corners[0]->at));
}

}  // namespace

void set_up_derivatives(const State& state, const ValueSource& source, const Weights& weights,
                        const TriangleValues& values, TriangleDerivatives& out) {
  out.source = source;
  out.turn = turn_of(source);
  for (std::size_t i = 0; i < 3; ++i) {
    out.along_u[i] = weights.edges[i].a.value * step_of(*weights.frame, Axis::u);
    out.along_v[i] = weights.edges[i].b.value * step_of(*weights.frame, Axis::v);
  }
  out.attributes.assign(state.attributes.size(), {});
  for (std::size_t a = 0; a < out.attributes.size(); ++a) {
    const ValueLine& value = values.attributes[a];
    TriangleDerivatives::Line& line = out.attributes[a];
    const auto& r = source.attributes;
    const bool is_one_value = r[0][a] == r[1][a] && r[1][a] == r[2][a];
    if (value.kind == ValueLine::Kind::copied || is_one_value) continue;
    if (value.kind == ValueLine::Kind::affine) {
      line.constant = affine_slopes(out, weights, value.numerators);
    } else {
      line.is_constant = false;
      line.r = value.numerators;
    }
  }
}

DerivativeSite derivative_site(const TriangleValues& values, const Weights& weights, double u,
                               double v) {
  DerivativeSite site{u, v, {}, 0, false};
  if (!values.has_smooth) return site;
  site.e = weights.at(u, v);
  site.sum = site.e[0] + site.e[1] + site.e[2];
  const double size = std::abs(site.e[0]) + std::abs(site.e[1]) + std::abs(site.e[2]);
  site.is_certain = site.sum > 0x1p33 * values.certificates.band_sum && size <= 2 * site.sum;
  return site;
}

WideSlopes derivatives_at(const TriangleDerivatives& triangle, const Weights& weights,
                          std::size_t attribute, const DerivativeSite& site) {
  const TriangleDerivatives::Line& line = triangle.attributes[attribute];
  if (line.is_constant) return line.constant;
  if (!site.is_certain) return exact_smooth_at(triangle, weights, line.r, site);
  const auto& r = line.r;
  const double value = (r[0] * site.e[0] + r[1] * site.e[1] + r[2] * site.e[2]) / site.sum;
  const std::array<double, 3> differences{r[0] - value, r[1] - value, r[2] - value};
  const auto slope = [&](const std::array<double, 3>& along) {
    const double sum =
        along[0] * differences[0] + along[1] * differences[1] + along[2] * differences[2];
    return sum / site.sum;
  };
  return {slope(triangle.along_u), slope(triangle.along_v)};
}

}  // namespace rastercheck::rasterizer
