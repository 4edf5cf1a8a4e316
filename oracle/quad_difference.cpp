// Differences across quads of pixels, and their largest allowed errors
// (cases::Contract::quad_share). With r = N/D at the fragment, r' = N'/D' at its neighbour, and M
// the greater of max|r_i| and |r|:
//
//   allowed = share (M + g M'),   g = max(1, D / D') for a smooth value, else 1

#include <algorithm>

#include "oracle/internal/rational_number.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/values.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {
namespace {

bool has_open_place(const cases::Case& c, std::size_t attribute) {
  return c.framebuffer.samples > 1 && c.attributes[attribute].location == cases::Location::centroid;
}

/// The parts of a value at a point.
struct PointValue {
  Field r;
  Field inverse_w{1};  ///< up to a factor common to all points; 1 for affine values
};

std::optional<PointValue> value_of(const TriangleValues& values, const Quantity& quantity,
                                   std::size_t attribute, const Point& p) {
  if (!values.is_defined_at(attribute, p)) return std::nullopt;
  const ProjectiveMap& map = *values.single_map();
  const std::optional<Field> r = quantity.at(map, p);
  if (!r) return std::nullopt;
  if (!quantity.is_perspective) return PointValue{*r};
  return PointValue{*r, Field(map.inverse_w().at(p))};
}

}  // namespace

std::optional<QuadDifference> TriangleTruth::quad_difference(std::size_t attribute, WindowAxis axis,
                                                             int x, int y, int sample,
                                                             float quad_share) const {
  const cases::Case& c = setup_->scene->source();
  if (c.attributes[attribute].interpolation == cases::Interpolation::flat) {
    return QuadDifference{Rational(0), Rational(0), false};
  }
  if (has_open_place(c, attribute)) return std::nullopt;
  const bool is_along_x = axis == WindowAxis::x;
  const Quantity quantity = values().quantity(attribute);
  const auto at = [&](int px, int py) {
    return value_of(values(), quantity, attribute, values().location(attribute, px, py, sample));
  };
  const std::optional<PointValue> here = at(x, y);
  const std::optional<PointValue> there = is_along_x ? at(x ^ 1, y) : at(x, y ^ 1);
  if (!here || !there) return std::nullopt;
  const Field most = to_field(attribute_magnitude(attribute));
  const Field g = std::max(Field(1), Field(here->inverse_w / there->inverse_w));
  const Field size = std::max(most, magnitude(here->r)) + g * std::max(most, magnitude(there->r));
  const bool is_odd = ((is_along_x ? x : y) & 1) != 0;
  const Field outwards = there->r - here->r;
  QuadDifference difference;
  difference.exact = to_rational(is_odd ? Field(-outwards) : outwards);
  difference.allowed = to_rational(exact_field(quad_share) * size);
  difference.is_next_to_horizon = g > exact_field(cases::kMostQuadHorizon);
  return difference;
}

}  // namespace rastercheck::oracle
