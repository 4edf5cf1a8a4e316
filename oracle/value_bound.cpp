// How far values may be beyond what a contract leaves open (cases::ValueBound), at one fragment.

#include "oracle/internal/value_bound.h"

#include <algorithm>
#include <vector>

#include "oracle/internal/coverage.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/ulp_error.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {
namespace {

/// The points an attribute of a fragment may be evaluated at; of a centroid, which OpenGL and
/// Vulkan let be anywhere in pixel and triangle, the centre and the samples that may be covered.
std::vector<Point> locations(const TriangleSetup& triangle, const cases::Attribute& attribute,
                             int x, int y, int sample) {
  const Scene& scene = *triangle.scene;
  if (attribute.location == cases::Location::sample) return {scene.sample_point(x, y, sample)};
  std::vector<Point> points{Scene::center_point(x, y)};
  if (attribute.location == cases::Location::center) return points;
  for (int s = 0; s < scene.source().framebuffer.samples; ++s) {
    if (decide(triangle, x, y, s).verdict == records::Verdict::forbidden) continue;
    points.push_back(scene.sample_point(x, y, s));
  }
  return points;
}

}  // namespace

cases::ValueBound bound_of(const cases::Contract& contract, const cases::Case& source,
                           std::optional<std::size_t> attribute) {
  if (!attribute) return contract.bounds.depth;
  switch (source.attributes[*attribute].interpolation) {
    case cases::Interpolation::smooth:
      return contract.bounds.smooth;
    case cases::Interpolation::noperspective:
      return contract.bounds.noperspective;
    case cases::Interpolation::flat:
      break;
  }
  return {0, 0};
}

std::optional<Field> horizon_ratio(const TriangleSetup& triangle, const Point& p) {
  const ProjectiveMap& map = triangle.ideal;
  const Ring here = map.inverse_w().at(p);
  if (map.orientation() == 0 || sign_of(here) <= 0) return std::nullopt;
  if (!triangle.has_nonpositive_w) {
    const Ring least_w =
        std::min({triangle.columns[0][2], triangle.columns[1][2], triangle.columns[2][2]});
    return quotient(map.determinant(), least_w * here);
  }
  const ConvexRegion drawn = triangle.clipped_to_triangle(guard_band_of(*triangle.scene));
  Fraction most = {here};
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const HomogeneousPoint& corner = drawn.vertex(i);
    most = greatest(most, {map.inverse_w().at(corner), corner.t});
  }
  return quotient(most.numerator, most.denominator * here);
}

std::optional<Rational> TriangleTruth::value_bound(std::optional<std::size_t> attribute, int x,
                                                   int y, int sample) const {
  const cases::Case& source = setup_->scene->source();
  const cases::ValueBound bound = bound_of(setup_->scene->contract(), source, attribute);
  const Field constant = exact_field(bound.constant);
  // Of a triangle that has no area until its vertices are snapped there is no ratio to speak of.
  const bool has_horizon =
      attribute && source.attributes[*attribute].interpolation == cases::Interpolation::smooth &&
      bound.per_horizon > 0 && setup_->ideal.orientation() != 0;
  if (!has_horizon) return to_rational(constant);
  Field greatest(1);
  for (const Point& p : locations(*setup_, source.attributes[*attribute], x, y, sample)) {
    const std::optional<Field> ratio = horizon_ratio(*setup_, p);
    if (!ratio) return std::nullopt;
    greatest = std::max(greatest, *ratio);
  }
  return to_rational(constant + exact_field(bound.per_horizon) * greatest);
}

}  // namespace rastercheck::oracle
