// Screen derivatives of attributes (RULES §4). With r = N/D, N and D affine in (u, v):
//
//   ∂r/∂u = (N_u D − N D_u)/D² = (N_u − r D_u)/D

#include <algorithm>
#include <limits>

#include "oracle/internal/rational_number.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/values.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {
namespace {

struct FieldDerivatives {
  Field du;
  Field dv;
};

bool is_flat(const TriangleSetup& setup, std::size_t attribute) {
  return setup.scene->source().attributes[attribute].interpolation == cases::Interpolation::flat;
}

std::optional<FieldDerivatives> derivatives_at(const TriangleSetup& setup,
                                               const TriangleValues& values, std::size_t attribute,
                                               const Point& p) {
  if (is_flat(setup, attribute)) return FieldDerivatives{Field(0), Field(0)};
  if (!values.is_defined_at(attribute, p)) return std::nullopt;
  const ProjectiveMap* map = values.single_map();
  const Quantity quantity = values.quantity(attribute);
  const std::optional<Field> r = quantity.at(*map, p);
  if (!r) return std::nullopt;
  const Line numerator = map->combine(quantity.numerators);
  const Line denominator =
      quantity.is_perspective ? map->inverse_w() : Line{Ring(0), Ring(0), map->determinant()};
  const Field d(denominator.at(p));
  return FieldDerivatives{(Field(numerator.a) - *r * Field(denominator.a)) / d,
                          (Field(numerator.b) - *r * Field(denominator.b)) / d};
}

Derivatives to_public(const FieldDerivatives& derivatives) {
  return {to_rational(derivatives.du), to_rational(derivatives.dv)};
}

}  // namespace

std::optional<Derivatives> TriangleTruth::derivatives(std::size_t attribute, int x, int y,
                                                      int sample) const {
  const auto found =
      derivatives_at(*setup_, values(), attribute, values().location(attribute, x, y, sample));
  if (!found) return std::nullopt;
  return to_public(*found);
}

std::optional<Derivatives> TriangleTruth::quad_differences(std::size_t attribute, int x, int y,
                                                           int sample) const {
  if (is_flat(*setup_, attribute)) return to_public({Field(0), Field(0)});
  const Quantity quantity = values().quantity(attribute);
  const auto value = [&](int px, int py) -> std::optional<Field> {
    const Point p = values().location(attribute, px, py, sample);
    if (!values().is_defined_at(attribute, p)) return std::nullopt;
    return quantity.at(*values().single_map(), p);
  };
  const int left = x - x % 2;
  const int low = y - y % 2;
  const std::optional<Field> at_left = value(left, y);
  const std::optional<Field> at_right = value(left + 1, y);
  const std::optional<Field> at_low = value(x, low);
  const std::optional<Field> at_high = value(x, low + 1);
  if (!at_left || !at_right || !at_low || !at_high) return std::nullopt;
  return to_public({*at_right - *at_left, *at_high - *at_low});
}

std::optional<records::Enclosure> TriangleTruth::level_of_detail(std::size_t s, std::size_t t,
                                                                 int width, int height, int x,
                                                                 int y, int sample) const {
  const auto ds = derivatives_at(*setup_, values(), s, values().location(s, x, y, sample));
  const auto dt = derivatives_at(*setup_, values(), t, values().location(t, x, y, sample));
  if (!ds || !dt) return std::nullopt;
  const auto square_length = [width, height](const Field& s_slope, const Field& t_slope) {
    const Field s_texels = s_slope * Field(width);
    const Field t_texels = t_slope * Field(height);
    return Field(s_texels * s_texels + t_texels * t_texels);
  };
  const Field square = std::max(square_length(ds->du, dt->du), square_length(ds->dv, dt->dv));
  if (sign_of(square) == 0) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return records::Enclosure{-kInfinity, -kInfinity};
  }
  // log2(ρ) = log2(ρ²)/2; halving a double in this range is exact.
  const records::Enclosure twice = enclose_log2(square);
  return records::Enclosure{twice.lo / 2, twice.hi / 2};
}

}  // namespace rastercheck::oracle
