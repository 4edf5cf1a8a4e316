#include "oracle/internal/stage_triangles.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "cases/exact_contract.h"
#include "oracle/internal/coverage.h"
#include "oracle/internal/rational_number.h"
#include "oracle/ulp.h"

namespace rastercheck::oracle {
namespace {

bool is_same(const Point& a, const Point& b) { return a.u == b.u && a.v == b.v; }

}  // namespace

std::optional<Field> TriangleUnder::value_at(std::optional<std::uint32_t> attribute,
                                             const Point& p) const {
  const ProjectiveMap* map = values.single_map();
  if (map == nullptr) return std::nullopt;
  if (!attribute) return values.depth_quantity().at(*map, p);
  if (!values.is_defined_at(*attribute, p)) return std::nullopt;
  const bool is_smooth =
      scene.source().attributes[*attribute].interpolation == cases::Interpolation::smooth;
  return (is_smooth ? values.perspective_quantity(*attribute) : values.quantity(*attribute))
      .at(*map, p);
}

StageSplit::Triangles::Triangles(const cases::Case& given_alone, const cases::Case& drawn_alone,
                                 const cases::Contract& contract)
    : given(given_alone, cases::exact_contract(contract)),
      drawn(drawn_alone, cases::exact_contract(contract)),
      open(drawn_alone, contract) {}

std::optional<Field> StageSplit::Triangles::copy_of(std::optional<std::uint32_t> attribute) const {
  const cases::Case& source = given.scene.source();
  if (!attribute || source.attributes[*attribute].interpolation != cases::Interpolation::flat) {
    return std::nullopt;
  }
  const std::size_t vertex = given.scene.scene().conventions().provoking_vertex;
  return Field(given.values.vertex_values(*attribute)[vertex]);
}

Field StageSplit::Triangles::clamped(std::optional<std::uint32_t> attribute, Field value) const {
  const Scene& scene = given.scene.scene();
  if (attribute || !scene.clamps_depth()) return value;
  return std::clamp(value, Field(scene.clamp_least()), Field(scene.clamp_greatest()));
}

Field StageSplit::Triangles::offset_of(const TriangleUnder& triangle,
                                       std::optional<std::uint32_t> attribute) {
  const std::optional<DepthOffset>& offset = triangle.setup().depth_offset();
  return attribute || !offset ? Field(0) : offset->exact.lo.value();
}

Rational StageSplit::Triangles::unit(std::optional<std::uint32_t> attribute,
                                     const Field& exact) const {
  const Scene& scene = given.scene.scene();
  const Ring scale =
      attribute ? given.values.vertex_magnitude(*attribute)
                : std::max(magnitude(scene.least_depth()), magnitude(scene.greatest_depth()));
  return ulp(to_rational(std::max(magnitude(exact), Field(scale))));
}

/// True if OpenGL and Vulkan allow a centroid at p: p must lie in the pixel and in the clipped
/// triangle or, for a snapped triangle, where a sample would be covered.
bool StageSplit::Triangles::may_be_centroid(int x, int y, const Point& p) const {
  if (p.u < Ring(x) || p.u > Ring(x + 1) || p.v < Ring(y) || p.v > Ring(y + 1)) return false;
  if (drawn.scene.scene().viewport_side(p) == ViewportSide::outside) return false;
  if (decide_point(open.setup(), p).verdict != records::Verdict::forbidden) return true;
  return drawn.setup().ideal.orientation() != 0 &&
         !drawn.setup().clipped_to_triangle({p, p}).is_empty();
}

std::optional<Point> StageSplit::Triangles::centroid(int x, int y,
                                                     const std::optional<Point>& taken) const {
  const Scene& scene = open.scene.scene();
  const TriangleValues::CentroidSamples samples = open.values.centroid_samples(x, y);
  std::vector<Point> places;
  if (samples.has_center) places.push_back(scene.center_point(x, y));
  for (const int s : samples.firsts) places.push_back(scene.sample_point(x, y, s));
  if (taken) {
    const bool is_right = scene.conventions().centroid_is_a_sample
                              ? std::any_of(places.begin(), places.end(),
                                            [&](const Point& p) { return is_same(p, *taken); })
                              : may_be_centroid(x, y, *taken);
    if (is_right) return taken;
  }
  if (places.empty()) return std::nullopt;
  return places.front();
}

std::optional<StageSplit::Triangles::Start> StageSplit::Triangles::start(
    std::optional<std::uint32_t> attribute, int x, int y, int sample,
    const std::optional<Point>& taken) const {
  const Point at_sample = given.scene.scene().sample_point(x, y, sample);
  if (const std::optional<Field> copy = copy_of(attribute)) return Start{*copy, at_sample};
  std::optional<Point> place = at_sample;
  if (attribute) {
    const bool is_centroid =
        given.scene.source().attributes[*attribute].location == cases::Location::centroid;
    place = is_centroid ? centroid(x, y, taken) : given.values.location(*attribute, x, y, sample);
  }
  if (!place) return std::nullopt;
  std::optional<Field> value = given.value_at(attribute, *place);
  if (value) *value += offset_of(given, attribute);
  // Points covered only by snapping may lie where the exact triangle has no value.
  if (!value) {
    value = open.value_at(attribute, *place);
    if (value) *value += offset_of(drawn, attribute);
  }
  if (!value) return std::nullopt;
  return Start{clamped(attribute, *std::move(value)), *place};
}

}  // namespace rastercheck::oracle
