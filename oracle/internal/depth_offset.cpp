#include "oracle/internal/depth_offset.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/internal/depth_filter.h"
#include "oracle/internal/float_ulp.h"
#include "oracle/internal/next_double.h"
#include "oracle/internal/triangle_setup.h"

namespace rastercheck::oracle {
namespace {

using records::Enclosure;

/// How far a greatest depth may be from the exact one, as a share of it, where a backend looks for
/// the exponent: more than a float32 loses on the way.
constexpr double kDepthError = 0x1p-20;

bool has_finite_ends(const Enclosure& e) { return std::isfinite(e.lo) && std::isfinite(e.hi); }

Enclosure magnitudes(const Enclosure& e) {
  const double least = e.lo <= 0 && e.hi >= 0 ? 0 : std::min(std::abs(e.lo), std::abs(e.hi));
  return {least, std::max(std::abs(e.lo), std::abs(e.hi))};
}

/// The product of an enclosure and a number, in doubles.
Enclosure times(const Enclosure& e, double factor) {
  const auto [lo, hi] = std::minmax({e.lo * factor, e.hi * factor});
  return {next_below(lo), next_above(hi)};
}

Fraction limited(const Fraction& offset, float clamp) {
  if (clamp > 0) return least(offset, {exact_ring(clamp)});
  if (clamp < 0) return greatest(offset, {exact_ring(clamp)});
  return offset;
}

/// The depths of a triangle as a plane over the window.
class DepthPlane {
 public:
  DepthPlane(const TriangleSetup& triangle, const ProjectiveMap& map)
      : line_(map.combine({triangle.scene->depth_numerator(triangle.indices[0]),
                           triangle.scene->depth_numerator(triangle.indices[1]),
                           triangle.scene->depth_numerator(triangle.indices[2])})),
        determinant_(map.determinant()),
        units_(triangle.scene->units_per_pixel()) {}

  const Ring& determinant() const { return determinant_; }
  /// z_x and z_y, per pixel.
  Fraction along_x() const { return {line_.a * units_, determinant_}; }
  Fraction along_y() const { return {line_.b * units_, determinant_}; }
  /// max(|z_x|, |z_y|) |det M|.
  Ring steepest() const { return std::max(magnitude(line_.a), magnitude(line_.b)) * units_; }

 private:
  Line line_;
  Ring determinant_;
  Ring units_;
};

/// A vertex's depth; empty if it lies behind the eye.
std::optional<Fraction> vertex_depth(const TriangleSetup& triangle, std::size_t corner) {
  const Ring& w = triangle.columns[corner][2];
  if (sign_of(w) <= 0) return std::nullopt;
  return Fraction{triangle.scene->depth_numerator(triangle.indices[corner]), w};
}

/// The greatest depth that cases::BiasExponent::vertices names.
Fraction greatest_of_vertices(const TriangleSetup& triangle) {
  const Fraction lowest{triangle.scene->least_depth()};
  const Fraction highest{triangle.scene->greatest_depth()};
  Fraction most = lowest;
  for (std::size_t i = 0; i < 3; ++i) {
    most = greatest(most, least(vertex_depth(triangle, i).value_or(highest), highest));
  }
  return most;
}

/// 2^(e − 23) for a depth with exponent e; 0 for 0 and below.
double float_unit(const Field& depth) {
  if (sign_of(depth) <= 0) return 0;
  return std::ldexp(1.0, static_cast<int>(floor_log2(depth)) - kFractionBits);
}

bool is_beyond_view(const TriangleSetup& triangle) {
  if (triangle.has_clipped_vertex || triangle.has_nonpositive_w || !triangle.is_whole) return true;
  return std::any_of(triangle.indices.begin(), triangle.indices.end(), [&](std::uint32_t vertex) {
    const RingVector4 p = triangle.scene->clip_position(vertex);
    return magnitude(p[0]) > p[3] || magnitude(p[1]) > p[3];
  });
}

/// The least depth of what is drawn of a triangle.
Fraction least_drawn(const TriangleSetup& triangle) {
  const Scene& scene = *triangle.scene;
  const ConvexRegion drawn =
      triangle.clipped_to_triangle({scene.viewport_lo(), scene.viewport_hi()});
  const Line numerator = triangle.ideal.combine({scene.depth_numerator(triangle.indices[0]),
                                                 scene.depth_numerator(triangle.indices[1]),
                                                 scene.depth_numerator(triangle.indices[2])});
  Fraction most_near = greatest_of_vertices(triangle);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const HomogeneousPoint& corner = drawn.vertex(i);
    most_near = least(most_near, {numerator.at(corner), triangle.ideal.determinant() * corner.t});
  }
  return most_near;
}

/// The units that cases::BiasExponent::open allows. Parts of a clipped triangle may have exponents
/// of their own, none of them below that of the least depth.
Enclosure open_float_units(const TriangleSetup& triangle) {
  Fraction most = greatest_of_vertices(triangle);
  Field farthest = most.value();
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto depth = vertex_depth(triangle, i)) {
      farthest = std::max(farthest, magnitude(depth->value()));
    }
  }
  // The rules leave r open where all depths are 0.
  if (sign_of(farthest) == 0) return {0, std::ldexp(1.0, -kFractionBits)};
  const Field nearest = is_beyond_view(triangle) ? least_drawn(triangle).value() : farthest;
  return {float_unit(nearest * Field(1 - kDepthError)),
          float_unit(farthest * Field(1 + kDepthError))};
}

/// The contract's r.
Enclosure units_of_bias(const TriangleSetup& triangle) {
  const cases::Contract& contract = triangle.scene->contract();
  const int bits = cases::unorm_bits(triangle.scene->source().depth_format);
  if (bits == 0) {
    if (contract.depth_bias.exponent == cases::BiasExponent::open) {
      return open_float_units(triangle);
    }
    const double unit = float_unit(greatest_of_vertices(triangle).value());
    return {unit, unit};
  }
  const double power = std::ldexp(1.0, -bits);
  const double least_value = double{static_cast<float>(1 / (std::ldexp(1.0, bits) - 1))};
  switch (contract.depth_bias.unit) {
    case cases::BiasUnit::power:
      return {power, power};
    case cases::BiasUnit::double_power:
      return {2 * power, 2 * power};
    case cases::BiasUnit::either_power:
      return {power, 2 * power};
    case cases::BiasUnit::least_value:
      return {least_value, least_value};
    case cases::BiasUnit::open:
      break;
  }
  return {0, 2 * power};
}

struct Slopes {
  Enclosure x;
  Enclosure y;
};

Slopes slopes_of(const DepthPlane& plane) {
  return {enclose(plane.along_x()), enclose(plane.along_y())};
}

Enclosure either_of(const Enclosure& a, const Enclosure& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// The slopes of all placements of a placed triangle; empty if some turn it round.
std::optional<Slopes> slopes_of_corners(const TriangleSetup& triangle) {
  std::optional<Slopes> all;
  const int orientation = triangle.corner(0).orientation();
  if (orientation == 0) return std::nullopt;
  for (std::size_t k = 0; k < triangle.corner_count(); ++k) {
    const ProjectiveMap& map = triangle.corner(k);
    if (map.orientation() != orientation) return std::nullopt;
    const Slopes one = slopes_of(DepthPlane(triangle, map));
    all = all ? Slopes{either_of(all->x, one.x), either_of(all->y, one.y)} : one;
  }
  return all;
}

/// The slopes that the contract allows, z_x and z_y per pixel; empty if nothing bounds them.
std::optional<Slopes> open_slopes(const TriangleSetup& triangle) {
  if (const ProjectiveMap* map = triangle.value_map()) {
    if (map->orientation() == 0) return std::nullopt;
    return slopes_of(DepthPlane(triangle, *map));
  }
  if (triangle.ideal.orientation() == 0 || triangle.has_nonpositive_w) return std::nullopt;
  // The parts of a cut triangle may have planes of their own, and a thin part any slope.
  if (triangle.shape == Shape::cut && (!triangle.is_whole || triangle.has_clipped_vertex)) {
    return std::nullopt;
  }
  const Slopes exact = slopes_of(DepthPlane(triangle, triangle.ideal));
  const std::optional<double> turned = placement_turn(triangle);
  if (!turned) {
    if (triangle.shape != Shape::placed) return std::nullopt;
    std::optional<Slopes> all = slopes_of_corners(triangle);
    if (all) *all = {either_of(all->x, exact.x), either_of(all->y, exact.y)};
    return all;
  }
  const double steepness = magnitudes(exact.x).hi + magnitudes(exact.y).hi;
  const double change = *turned / (1 - *turned) * steepness * (1 + 0x1p-40);
  return Slopes{{exact.x.lo - change, exact.x.hi + change},
                {exact.y.lo - change, exact.y.hi + change}};
}

/// The contract's m.
Enclosure steepness_of(const Slopes& slopes, cases::BiasSlope formula) {
  const Enclosure x = magnitudes(slopes.x);
  const Enclosure y = magnitudes(slopes.y);
  const Enclosure steepest{std::max(x.lo, y.lo), std::max(x.hi, y.hi)};
  if (formula == cases::BiasSlope::greatest) return steepest;
  // std::hypot is within one unit in the last place of the root.
  const Enclosure root{next_below(next_below(std::hypot(x.lo, y.lo))),
                       next_above(next_above(std::hypot(x.hi, y.hi)))};
  return formula == cases::BiasSlope::root ? root : Enclosure{steepest.lo, root.hi};
}

/// The offset of a contract that leaves neither formula, unit nor positions open.
DepthOffset single_offset(const TriangleSetup& triangle, const ProjectiveMap& map, double unit) {
  const cases::DepthBias& bias = triangle.scene->source().depth_bias;
  const DepthPlane plane(triangle, map);
  const Ring sum = exact_ring(bias.slope) * plane.steepest() +
                   exact_ring(bias.constant) * Ring(unit) * plane.determinant();
  const Fraction offset = limited({sum, plane.determinant()}, bias.clamp);
  return {{offset, offset}, enclose(offset), true};
}

}  // namespace

std::optional<DepthOffset> depth_offset(const TriangleSetup& triangle) {
  const cases::Case& source = triangle.scene->source();
  const cases::DepthBias& bias = source.depth_bias;
  const cases::BiasPromise& promise = triangle.scene->contract().depth_bias;
  const Enclosure unit = units_of_bias(triangle);
  const ProjectiveMap* map = triangle.value_map();
  const bool is_rooted = bias.slope != 0 && promise.slope != cases::BiasSlope::greatest;
  if (map != nullptr && map->orientation() != 0 && unit.lo == unit.hi && !is_rooted) {
    return single_offset(triangle, *map, unit.lo);
  }
  if (bias.slope == 0 && unit.lo == unit.hi) {
    const Fraction offset = limited({exact_ring(bias.constant) * Ring(unit.lo)}, bias.clamp);
    return DepthOffset{{offset, offset}, enclose(offset), true};
  }
  Enclosure sum = times(unit, exact_double(bias.constant));
  if (bias.slope != 0) {
    const std::optional<Slopes> slopes = open_slopes(triangle);
    if (!slopes) return std::nullopt;
    const Enclosure part = times(steepness_of(*slopes, promise.slope), exact_double(bias.slope));
    sum = {next_below(sum.lo + part.lo), next_above(sum.hi + part.hi)};
  }
  if (!has_finite_ends(sum)) return std::nullopt;
  const Fraction lo = limited({Ring(sum.lo)}, bias.clamp);
  const Fraction hi = limited({Ring(sum.hi)}, bias.clamp);
  return DepthOffset{{lo, hi}, {enclose(lo).lo, enclose(hi).hi}, false};
}

Field offset_of_slopes(const TriangleSetup& triangle, const Field& along_x, const Field& along_y) {
  const cases::DepthBias& bias = triangle.scene->source().depth_bias;
  Field sum = exact_field(bias.slope) * std::max(magnitude(along_x), magnitude(along_y)) +
              exact_field(bias.constant) * Field(units_of_bias(triangle).lo);
  if (bias.clamp > 0) return std::min(sum, exact_field(bias.clamp));
  if (bias.clamp < 0) return std::max(sum, exact_field(bias.clamp));
  return sum;
}

}  // namespace rastercheck::oracle
