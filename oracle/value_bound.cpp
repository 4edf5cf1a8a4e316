// The largest excess that a contract allows (cases::ValueBound), at one fragment.

#include "oracle/internal/value_bound.h"

#include <algorithm>
#include <array>
#include <vector>

#include "oracle/internal/coverage.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/stored_depth.h"
#include "oracle/internal/ulp_error.h"
#include "oracle/internal/values.h"
#include "oracle/triangle_truth.h"
#include "oracle/ulp.h"

namespace rastercheck::oracle {
namespace {

/// A bound in ULP that is so large that no digit of a float32 need be right.
constexpr float kAllDigits = 0x1p24F;

/// Returns the points at which an attribute of a fragment may be evaluated. For a centroid, which
/// OpenGL and Vulkan allow anywhere in the pixel and the triangle, these are the centre and the
/// samples that may be covered.
std::vector<HomogeneousPoint> locations(const TriangleSetup& triangle,
                                        const cases::Attribute& attribute, int x, int y,
                                        int sample) {
  const Scene& scene = *triangle.scene;
  std::vector<HomogeneousPoint> points;
  const auto add = [&](const Point& p) {
    if (!scene.contract().has_open_viewport()) {
      points.emplace_back(p.u, p.v, Ring(1));
      return;
    }
    // A bound depends on the horizon ratio and the condition number. Both are a convex function
    // divided by a positive affine one, so they are greatest at a corner.
    const ConvexRegion shown = triangle.shown_at(p);
    for (std::size_t i = 0; i < shown.size(); ++i) points.push_back(shown.vertex(i));
  };
  const cases::Location location = scene.location_of(attribute);
  if (location == cases::Location::sample) {
    add(scene.sample_point(x, y, sample));
    return points;
  }
  add(scene.center_point(x, y));
  if (location == cases::Location::center) return points;
  for (int s = 0; s < scene.source().framebuffer.samples; ++s) {
    if (decide(triangle, x, y, s).verdict == records::Verdict::forbidden) continue;
    add(scene.sample_point(x, y, s));
  }
  return points;
}

}  // namespace

cases::ValueBound bound_of(const TriangleSetup& triangle, std::optional<std::size_t> attribute) {
  const cases::ValueBounds& bounds = triangle.promise.bounds;
  if (!attribute) return bounds.depth;
  switch (triangle.scene->source().attributes[*attribute].interpolation) {
    case cases::Interpolation::smooth:
      return bounds.smooth;
    case cases::Interpolation::noperspective:
      return bounds.noperspective;
    case cases::Interpolation::flat:
      break;
  }
  return {0, 0};
}

std::optional<records::NotJudged> why_free(const TriangleSetup& triangle,
                                           std::optional<std::size_t> attribute) {
  using records::NotJudged;
  if (!triangle.promise.is_made) return NotJudged::not_promised;
  const cases::ValueBound bound = bound_of(triangle, attribute);
  const bool is_one_sided =
      !attribute && triangle.scene->contract().depth_error != cases::DepthError::either_side;
  if (bound.constant >= kAllDigits && !is_one_sided) return NotJudged::without_bound;
  if (!attribute) {
    return triangle.has_unbounded_depths() ? std::optional(NotJudged::left_free) : std::nullopt;
  }
  if (bound.per_condition >= kAllDigits) return NotJudged::without_bound;  // because K >= 1
  const Scene& scene = *triangle.scene;
  if (!cases::promises_values_of(scene.contract(), scene.source(), triangle.index, *attribute)) {
    return NotJudged::not_promised;
  }
  const bool is_open = triangle.has_nonpositive_w && scene.is_affine(*attribute);
  return is_open ? std::optional(NotJudged::left_free) : std::nullopt;
}

std::optional<Field> horizon_ratio(const TriangleSetup& triangle, const HomogeneousPoint& p) {
  const ProjectiveMap& map = triangle.ideal;
  const Ring here = map.inverse_w().at(p);
  if (map.orientation() == 0 || sign_of(here) <= 0) return std::nullopt;
  if (!triangle.has_nonpositive_w) {
    const Ring least_w =
        std::min({triangle.columns[0][2], triangle.columns[1][2], triangle.columns[2][2]});
    return quotient(map.determinant() * p.t, least_w * here);
  }
  if (!triangle.is_triangle()) return std::nullopt;
  const ConvexRegion drawn = triangle.clipped_to_triangle(guard_band_of(*triangle.scene));
  Fraction most = {here, p.t};
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const HomogeneousPoint& corner = drawn.vertex(i);
    most = greatest(most, {map.inverse_w().at(corner), corner.t});
  }
  return quotient(most.numerator * p.t, most.denominator * here);
}

namespace {

/// |X|, |Y| and |w| of a vertex (cases::ValueBound).
using VertexSize = std::array<Ring, 3>;

std::array<VertexSize, 3> vertex_sizes(const TriangleSetup& triangle) {
  const cases::Viewport& viewport = triangle.scene->source().viewport;
  const std::array<float, 2> origin{viewport.x, viewport.y};
  const std::array<float, 2> extent{viewport.width, viewport.height};
  std::array<VertexSize, 3> size;
  for (std::size_t i = 0; i < 3; ++i) {
    const RingVector4 clip = triangle.scene->clip_position(triangle.indices[i]);
    size[i][2] = magnitude(clip[3]);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const Ring half = magnitude(exact_ring(extent[axis])) * exact_ring(0.5F);
      const Ring in_pixels = magnitude(clip[static_cast<Eigen::Index>(axis)]) * half +
                             size[i][2] * (magnitude(exact_ring(origin[axis])) + half);
      size[i][axis] = in_pixels * triangle.scene->units_per_pixel();
    }
  }
  return size;
}

/// |E|_0 to |E|_2 of a triangle.
std::array<Ring, 3> weight_sizes(const std::array<VertexSize, 3>& size, const HomogeneousPoint& p) {
  std::array<Ring, 3> all;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [x_j, y_j, w_j] = size[(i + 1) % 3];
    const auto& [x_k, y_k, w_k] = size[(i + 2) % 3];
    all[i] = (y_j * w_k + y_k * w_j) * magnitude(p.u) + (x_j * w_k + x_k * w_j) * magnitude(p.v) +
             (x_j * y_k + x_k * y_j) * p.t;
  }
  return all;
}

/// |E|_0 to |E|_2 of a line, whose weights are the functionals n·(p w − (X, Y)) of its other end.
std::array<Ring, 3> weight_sizes_of_line(const TriangleSetup& line,
                                         const std::array<VertexSize, 3>& size,
                                         const HomogeneousPoint& p) {
  const VertexSize& a = size[0];
  const VertexSize& b = size[1];
  std::array<Ring, 2> n{a[2] * b[0] + b[2] * a[0], a[2] * b[1] + b[2] * a[1]};
  if (line.scene->source().line_mode == cases::LineMode::parallelogram) {
    n[1 - major_axis(direction_of(line.columns[0], line.columns[1]))] = Ring(0);
  }
  const auto size_of_functional = [&](const VertexSize& end) {
    return n[0] * (magnitude(p.u) * end[2] + end[0] * p.t) +
           n[1] * (magnitude(p.v) * end[2] + end[1] * p.t);
  };
  return {size_of_functional(b), size_of_functional(a), Ring(0)};
}

}  // namespace

std::optional<Field> condition(const TriangleSetup& triangle, bool is_affine,
                               const HomogeneousPoint& p) {
  const ProjectiveMap& map = triangle.ideal;
  if (map.orientation() == 0) return std::nullopt;
  const cases::Primitive primitive = triangle.scene->source().primitive;
  if (primitive == cases::Primitive::points) return Field(1);
  const std::array<VertexSize, 3> size = vertex_sizes(triangle);
  const std::array<Ring, 3> of_weights = primitive == cases::Primitive::lines
                                             ? weight_sizes_of_line(triangle, size, p)
                                             : weight_sizes(size, p);
  Ring sizes(0);
  Ring weights(0);
  for (std::size_t i = 0; i < 3; ++i) {
    sizes += is_affine ? size[i][2] * of_weights[i] : of_weights[i];
    weights += is_affine ? triangle.columns[i][2] * map.edge(i).at(p) : map.edge(i).at(p);
  }
  if (sign_of(weights) <= 0) return std::nullopt;
  return quotient(sizes, weights);
}

namespace {

/// A bound in units of the value itself, in ULP of the magnitude that bounds of depth, or of the
/// attribute's values at the vertices, refer to.
Field absolute_in_ulps(const TriangleSetup& triangle, std::optional<std::size_t> attribute,
                       float absolute) {
  const Scene& scene = *triangle.scene;
  const Ring greatest = attribute ? TriangleValues(triangle).vertex_magnitude(*attribute)
                                  : std::max(scene.least_depth(), scene.greatest_depth());
  return exact_field(absolute) / to_field(ulp(to_rational(Field(greatest))));
}

/// (max r_i − min r_i) / ulp(max |r_i|).
Field range_in_ulps(const TriangleSetup& triangle, std::size_t attribute) {
  const TriangleValues values(triangle);
  const FractionRange ends = values.ends(attribute);
  const Rational unit = ulp(to_rational(Field(values.vertex_magnitude(attribute))));
  return (ends.hi.value() - ends.lo.value()) / to_field(unit);
}

/// A bound of a depth in ULP, as one of what a unorm format stores: in steps, with the reach where
/// that is not open (stored_depth.h).
Field in_steps(const TriangleSetup& triangle, const Field& ulps) {
  const Scene& scene = *triangle.scene;
  const Field unit =
      to_field(ulp(to_rational(Field(std::max(scene.least_depth(), scene.greatest_depth())))));
  Field before = ulps * unit * Field(steps_of(scene.unorm_bits()));
  if (has_open_depths(triangle)) return before;
  return before + exact_reach(scene.contract().depth_store).value();
}

}  // namespace

double least_bound(const TriangleSetup& triangle, std::optional<std::size_t> attribute) {
  const cases::ValueBound bound = bound_of(triangle, attribute);
  // K >= 1, because |E_i| <= |E|_i.
  const double per_condition = triangle.ideal.orientation() != 0 ? bound.per_condition : 0;
  const double absolute =
      bound.absolute > 0 ? enclose(absolute_in_ulps(triangle, attribute, bound.absolute)).lo : 0;
  if (!attribute && triangle.scene->unorm_bits() != 0) {
    Field ulps = exact_field(bound.constant);
    if (absolute > 0) ulps += absolute_in_ulps(triangle, attribute, bound.absolute);
    return enclose(in_steps(triangle, ulps)).lo;
  }
  if (!attribute && absolute == 0) return bound.constant;
  if (!attribute) return (bound.constant + absolute) * (1 - 0x1p-48);
  if (per_condition == 0 && bound.range_share == 0 && absolute == 0) return bound.constant;
  const double range = bound.range_share > 0 ? enclose(range_in_ulps(triangle, *attribute)).lo : 0;
  // The factor rounds down by more than the five roundings in the sum can have added.
  return (bound.constant + per_condition + bound.range_share * range + absolute) * (1 - 0x1p-48);
}

std::optional<Rational> TriangleTruth::value_bound(std::optional<std::size_t> attribute, int x,
                                                   int y, int sample) const {
  const cases::Case& source = setup_->scene->source();
  const cases::ValueBound bound = bound_of(*setup_, attribute);
  if (bound.constant >= kAllDigits) return std::nullopt;
  Field fixed = exact_field(bound.constant);
  if (bound.absolute > 0) fixed += absolute_in_ulps(*setup_, attribute, bound.absolute);
  if (!attribute && setup_->scene->unorm_bits() != 0) {
    return to_rational(in_steps(*setup_, fixed));
  }
  if (!attribute) return to_rational(fixed);
  if (bound.range_share > 0) {
    fixed += exact_field(bound.range_share) * range_in_ulps(*setup_, *attribute);
  }
  // If the triangle has no area until its vertices are snapped, only the uniform part applies.
  if (bound.is_uniform() || setup_->ideal.orientation() == 0) return to_rational(fixed);

  const bool is_affine = setup_->scene->is_affine(*attribute);
  Field greatest(0);
  const std::vector<HomogeneousPoint> places =
      locations(*setup_, source.attributes[*attribute], x, y, sample);
  if (places.empty()) return std::nullopt;
  for (const HomogeneousPoint& p : places) {
    Field here(0);
    if (bound.per_horizon > 0) {
      const std::optional<Field> ratio = is_affine ? Field(1) : horizon_ratio(*setup_, p);
      if (!ratio) return std::nullopt;
      here += exact_field(bound.per_horizon) * *ratio;
    }
    if (bound.per_condition > 0) {
      const std::optional<Field> of_weights = condition(*setup_, is_affine, p);
      if (!of_weights) return std::nullopt;
      const Field lost = exact_field(bound.per_condition) * *of_weights;
      if (lost >= exact_field(kAllDigits)) return std::nullopt;
      here += lost;
    }
    greatest = std::max(greatest, here);
  }
  return to_rational(fixed + greatest);
}

}  // namespace rastercheck::oracle
