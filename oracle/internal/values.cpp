#include "oracle/internal/values.h"

#include <algorithm>

#include "oracle/internal/coverage.h"

namespace rastercheck::oracle {
namespace {

using records::Verdict;

FractionRange single(const Fraction& value) { return {value, value}; }

std::optional<FractionRange> single(const std::optional<Fraction>& value) {
  if (!value) return std::nullopt;
  return single(*value);
}

/// The range of a quantity on a region. The quantity is a ratio of affine functionals whose
/// denominator keeps its sign there, so its extremes are at corners.
std::optional<FractionRange> range_over(const Quantity& quantity,
                                        const TriangleValues::Region& region) {
  if (region.map->orientation() == 0) return std::nullopt;
  const Reading reading = quantity.on(*region.map);
  std::optional<FractionRange> range;
  for (std::size_t i = 0; i < region.points.size(); ++i) {
    const Fraction value = reading.at(region.points.vertex(i));
    if (sign_of(value.denominator) > 0) range = hull(range, single(value));
  }
  return range;
}

FractionRange intersection(const FractionRange& a, const FractionRange& b) {
  return {greatest(a.lo, b.lo), least(a.hi, b.hi)};
}

bool has_positive_inverse_w(const ProjectiveMap& map, const Point& p) {
  return sign_of(map.inverse_w().at(p)) > 0;
}

/// The value on a map at a point; empty if undefined (Quantity::at).
std::optional<Fraction> evaluate(const Quantity& quantity, const ProjectiveMap& map,
                                 const Point& p) {
  if (map.orientation() == 0) return std::nullopt;
  Fraction value = quantity.on(map).at(p);
  if (sign_of(value.denominator) <= 0) return std::nullopt;
  return value;
}

}  // namespace

Reading Quantity::on(const ProjectiveMap& map) const {
  return {map.combine(numerators),
          is_perspective ? map.inverse_w() : Line{Ring(0), Ring(0), map.determinant()}};
}

std::optional<Field> Quantity::at(const ProjectiveMap& map, const Point& p) const {
  const std::optional<Fraction> value = evaluate(*this, map, p);
  if (!value) return std::nullopt;
  return value->value();
}

TriangleValues::TriangleValues(const TriangleSetup& triangle) : triangle_(&triangle) {
  for (std::size_t i = 0; i < 3; ++i) {
    depth_.numerators[i] = triangle.scene->depth_numerator(triangle.indices[i]);
    if (triangle.shape != Shape::placed) continue;
    const Fraction at_vertex{depth_.numerators[i], triangle.columns[i][2]};
    depth_ends_ = i == 0 ? single(at_vertex) : hull(depth_ends_, single(at_vertex)).value();
  }
}

std::array<Ring, 3> TriangleValues::vertex_values(std::size_t attribute) const {
  const cases::Case& source = triangle_->scene->source();
  std::array<Ring, 3> values;
  for (std::size_t i = 0; i < 3; ++i) {
    values[i] = exact_ring(source.attributes_of(triangle_->indices[i])[attribute]);
  }
  return values;
}

Ring TriangleValues::vertex_magnitude(std::size_t attribute) const {
  const std::array<Ring, 3> values = vertex_values(attribute);
  return std::max({magnitude(values[0]), magnitude(values[1]), magnitude(values[2])});
}

FractionRange TriangleValues::ends(std::size_t attribute) const {
  const std::array<Ring, 3> values = vertex_values(attribute);
  return {{std::min({values[0], values[1], values[2]})},
          {std::max({values[0], values[1], values[2]})}};
}

Quantity TriangleValues::perspective_quantity(std::size_t attribute) const {
  return {vertex_values(attribute), true};
}

Quantity TriangleValues::quantity(std::size_t attribute) const {
  Quantity quantity = perspective_quantity(attribute);
  if (triangle_->scene->is_affine(attribute)) {
    quantity.is_perspective = false;
    for (std::size_t i = 0; i < 3; ++i) {
      quantity.numerators[i] = quantity.numerators[i] * triangle_->columns[i][2];
    }
  }
  return quantity;
}

const ProjectiveMap* TriangleValues::single_map() const { return triangle_->value_map(); }

bool TriangleValues::is_defined_at(std::size_t attribute, const Point& p) const {
  const ProjectiveMap* map = single_map();
  const Scene& scene = *triangle_->scene;
  const bool at_center =
      scene.location_of(scene.source().attributes[attribute]) == cases::Location::center;
  const bool may_lie_outside = at_center || scene.covers_outside();
  return map != nullptr && map->orientation() != 0 &&
         (!may_lie_outside || has_positive_inverse_w(*map, p));
}

Point TriangleValues::location(std::size_t attribute, int x, int y, int sample) const {
  const Scene& scene = *triangle_->scene;
  return scene.location_of(scene.source().attributes[attribute]) == cases::Location::center
             ? scene.center_point(x, y)
             : scene.sample_point(x, y, sample);
}

std::optional<FractionRange> TriangleValues::value_at(const Quantity& quantity,
                                                      const FractionRange& ends, const Point& p,
                                                      Place place) const {
  // A sample of a covered pixel may lie outside the triangle, as centres may.
  const bool may_lie_outside = triangle_->scene->covers_outside();
  if (may_lie_outside) place = Place::center;
  if (const ProjectiveMap* map = single_map()) {
    // If the centre lies behind the eye's horizon, no value is defined there, not even an affine
    // one (RULES §4).
    if (place == Place::center && !has_positive_inverse_w(*map, p)) return std::nullopt;
    return single(evaluate(quantity, *map, p));
  }
  // The only sample is at the centre and is covered, so its value is a mean of the vertices'
  // values.
  const bool is_only = triangle_->scene->source().framebuffer.samples == 1;
  if (is_only && !may_lie_outside) place = Place::sample;
  return triangle_->shape == Shape::cut ? cut_value(quantity, p, place)
                                        : placed_value(quantity, ends, p, place);
}

/// Every vertex coordinate enters a value as a linear fraction, so the value is monotone in each
/// coordinate (RULES §3). Its range over the boxes of the placements is attained at their corners,
/// unless a pole lies between.
std::optional<FractionRange> TriangleValues::placed_value(const Quantity& quantity,
                                                          const FractionRange& ends, const Point& p,
                                                          Place place) const {
  const std::size_t corners = triangle_->corner_count();
  const int orientation = triangle_->corner(0).orientation();
  bool has_pole = orientation == 0;
  for (std::size_t k = 0; !has_pole && k < corners; ++k) {
    const ProjectiveMap& map = triangle_->corner(k);
    has_pole = map.orientation() != orientation || !has_positive_inverse_w(map, p);
  }
  std::optional<FractionRange> range;
  if (has_pole) {
    if (place == Place::center) return std::nullopt;
    range = ends;
  } else {
    for (std::size_t k = 0; k < corners; ++k) {
      range = hull(range, single(evaluate(quantity, triangle_->corner(k), p)));
    }
    // Inside a triangle a value is a mean of its vertices' values.
    if (place == Place::sample) range = intersection(*range, ends);
  }
  if (triangle_->scene->contract().basis == cases::Basis::unspecified) {
    const ProjectiveMap& ideal = triangle_->ideal;
    if (place == Place::sample || has_positive_inverse_w(ideal, p)) {
      range = hull(range, single(evaluate(quantity, ideal, p)));
    }
  }
  return range;
}

/// Corners of the clipped polygon move by at most `reach` per axis. A point p of the moved polygon
/// is a mean of moved corners; the same mean of the original corners is a point q of the polygon
/// within `reach` of p. Values affine in window space (n/w and 1/w) move with the corners, so the
/// moved polygon has at p the value that the exact one has at q. The argument needs a mean, so a
/// centre that may lie outside the moved polygon has no value.
std::optional<FractionRange> TriangleValues::cut_value(const Quantity& quantity, const Point& p,
                                                       Place place) const {
  const cases::Contract& contract = triangle_->scene->contract();
  if (contract.conservative) return std::nullopt;
  if (place == Place::center && decide_point(*triangle_, p).verdict != Verdict::required) {
    return std::nullopt;
  }
  std::optional<FractionRange> range = range_over(quantity, cut_region(p));
  if (contract.basis == cases::Basis::snapped) return range;
  if (contract.has_open_viewport()) {
    const Region beside = shown_region(p);
    if (quantity.is_perspective && beside.has_pole()) return std::nullopt;
    return hull(range, range_over(quantity, beside));
  }
  if (place == Place::sample || has_positive_inverse_w(triangle_->ideal, p)) {
    range = hull(range, single(evaluate(quantity, triangle_->ideal, p)));
  }
  return range;
}

const TriangleValues::Region& TriangleValues::cut_region(const Point& p) const {
  if (!last_cut_ || last_cut_->p.u != p.u || last_cut_->p.v != p.v) {
    last_cut_ = {
        p, {&triangle_->ideal, triangle_->clipped_to_triangle(box_around(p, triangle_->reach))}};
  }
  return last_cut_->region;
}

TriangleValues::Region TriangleValues::shown_region(const Point& p) const {
  return {&triangle_->ideal, triangle_->shown_at(p)};
}

bool TriangleValues::Region::has_pole() const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sign_of(map->inverse_w().at(points.vertex(i))) <= 0) return true;
  }
  return false;
}

/// For D > 0, computed = N/D iff computed D − N is zero.
bool TriangleValues::Region::attains(const Reading& reading, const Ring& computed) const {
  const auto& [n, d] = reading;
  return map->orientation() != 0 &&
         points.meets({computed * d.a - n.a, computed * d.b - n.b, computed * d.c - n.c});
}

std::optional<OpenValue> TriangleValues::depth(int x, int y, int sample) const {
  const Scene& scene = *triangle_->scene;
  std::optional<FractionRange> range =
      value_at(depth_, depth_ends_, scene.sample_point(x, y, sample), Place::sample);
  if (!range) return std::nullopt;
  bool is_open = scene.contract().is_unspecified() || single_map() == nullptr;
  if (scene.has_depth_bias()) {
    const std::optional<DepthOffset>& offset = triangle_->depth_offset();
    if (!offset) return OpenValue{{{scene.clamp_least()}, {scene.clamp_greatest()}}, true};
    range->lo = sum(range->lo, offset->exact.lo);
    range->hi = sum(range->hi, offset->exact.hi);
    is_open = is_open || !offset->is_single;
  }
  if (scene.clamps_depth()) {
    const Fraction nearest{scene.clamp_least()};
    const Fraction farthest{scene.clamp_greatest()};
    range->lo = least(greatest(range->lo, nearest), farthest);
    range->hi = least(greatest(range->hi, nearest), farthest);
  }
  return OpenValue{*range, is_open};
}

std::optional<OpenValue> TriangleValues::attribute(std::size_t index, int x, int y,
                                                   int sample) const {
  const Scene& scene = *triangle_->scene;
  const cases::Attribute& declared = scene.source().attributes[index];
  const bool always_open = scene.contract().is_unspecified();
  if (declared.interpolation == cases::Interpolation::flat) {
    const Fraction value{vertex_values(index)[scene.conventions().provoking_vertex]};
    return OpenValue{single(value), always_open};
  }

  const Quantity q = quantity(index);
  const FractionRange ends = this->ends(index);
  const cases::Location where = scene.location_of(declared);
  if (where == cases::Location::centroid) {
    if (scene.conventions().centroid_is_a_sample) {
      std::optional<OpenValue> value = centroid_sample(q, ends, x, y);
      if (value) value->is_open = value->is_open || always_open;
      return value;
    }
    const std::optional<FractionRange> range = centroid_range(q, x, y);
    if (!range) return std::nullopt;
    return OpenValue{*range, true};
  }
  const Place place = where == cases::Location::center ? Place::center : Place::sample;
  const std::optional<FractionRange> range =
      value_at(q, ends, location(index, x, y, sample), place);
  if (!range) return std::nullopt;
  return OpenValue{*range, always_open || single_map() == nullptr};
}

TriangleValues::CentroidSamples TriangleValues::centroid_samples(int x, int y) const {
  const int count = triangle_->scene->source().framebuffer.samples;
  CentroidSamples found{{}, true};
  if (triangle_->scene->covers_outside()) return found;  // all samples are covered together
  bool all_sure = true;
  bool first_found = false;
  for (int s = 0; s < count; ++s) {
    const Verdict verdict = decide(*triangle_, x, y, s).verdict;
    found.has_center = found.has_center && verdict != Verdict::forbidden;
    all_sure = all_sure && verdict == Verdict::required;
    if (!first_found && verdict != Verdict::forbidden) found.firsts.push_back(s);
    first_found = first_found || verdict == Verdict::required;
  }
  if (all_sure) found.firsts.clear();
  return found;
}

/// D3D: the centre if all samples are covered, else the first covered sample. Samples that are only
/// permitted may leave several candidates.
std::optional<OpenValue> TriangleValues::centroid_sample(const Quantity& quantity,
                                                         const FractionRange& ends, int x,
                                                         int y) const {
  const Scene& scene = *triangle_->scene;
  const CentroidSamples places = centroid_samples(x, y);
  std::optional<FractionRange> range;
  for (const int s : places.firsts) {
    const auto value = value_at(quantity, ends, scene.sample_point(x, y, s), Place::sample);
    if (!value) return std::nullopt;
    range = hull(range, value);
  }
  if (places.has_center) {
    // If all samples of a standard pattern are covered, so is their hull, which contains the
    // centre.
    const Place place = single_map() == nullptr ? Place::sample : Place::center;
    const auto value = value_at(quantity, ends, scene.center_point(x, y), place);
    if (!value) return std::nullopt;
    range = hull(range, value);
  }
  if (!range) return std::nullopt;
  const std::size_t locations = places.firsts.size() + (places.has_center ? 1 : 0);
  return OpenValue{*range, locations > 1 || single_map() == nullptr};
}

/// OpenGL and Vulkan: any point of the pixel that lies in the clipped triangle.
const TriangleValues::Region& TriangleValues::centroid_region(int x, int y) const {
  if (last_centroid_ && last_centroid_->x == x && last_centroid_->y == y) {
    return last_centroid_->region;
  }
  const Scene& scene = *triangle_->scene;
  const ProjectiveMap* map = single_map();
  const Ring spread = map == nullptr ? triangle_->reach : Ring(0);
  const Ring& units = scene.units_per_pixel();
  ConvexRegion points(Point{Ring(x) * units - spread, Ring(y) * units - spread},
                      Point{Ring(x + 1) * units + spread, Ring(y + 1) * units + spread});
  if (scene.covers_outside()) {
    // Any point of the pixel: all of it counts as covered.
  } else if (map == nullptr || map == &triangle_->ideal) {
    points = triangle_->clipped_to_triangle(std::move(points));
  } else {
    for (std::size_t i = 0; i < 3; ++i) points.clip(map->edge(i));
  }
  if (map != nullptr && triangle_->is_triangle() && !scene.covers_outside()) {
    points.clip({Ring(1), Ring(0), -scene.viewport_lo().u});
    points.clip({Ring(-1), Ring(0), scene.viewport_hi().u});
    points.clip({Ring(0), Ring(1), -scene.viewport_lo().v});
    points.clip({Ring(0), Ring(-1), scene.viewport_hi().v});
  }
  last_centroid_ = {x, y, {map == nullptr ? &triangle_->ideal : map, std::move(points)}};
  return last_centroid_->region;
}

std::optional<FractionRange> TriangleValues::centroid_range(const Quantity& quantity, int x,
                                                            int y) const {
  const Scene& scene = *triangle_->scene;
  const ProjectiveMap* map = single_map();
  if (scene.covers_outside() && (map == nullptr || centroid_region(x, y).has_pole())) {
    return std::nullopt;
  }
  std::optional<FractionRange> range = range_over(quantity, centroid_region(x, y));
  if (scene.covers_outside()) return range;
  if (triangle_->shape == Shape::exact) return range;

  // The drawn part need not lie in the exact triangle, so an implementation may evaluate at a
  // covered sample outside it.
  const bool ideal_may_be_taken = map != nullptr || scene.contract().basis != cases::Basis::snapped;
  if (!ideal_may_be_taken) return range;
  const ProjectiveMap& drawn = map == nullptr ? triangle_->ideal : *map;
  for (int s = 0; s < scene.source().framebuffer.samples; ++s) {
    if (decide(*triangle_, x, y, s).verdict == Verdict::forbidden) continue;
    const Point p = scene.sample_point(x, y, s);
    if (scene.contract().has_open_viewport()) {
      const Region beside = shown_region(p);
      if (quantity.is_perspective && beside.has_pole()) return std::nullopt;
      range = hull(range, range_over(quantity, beside));
      continue;
    }
    const std::optional<FractionRange> there = single(evaluate(quantity, drawn, p));
    // A sample covered only by snapping may lie behind the eye's horizon; its value is then
    // undefined, as under `sample`.
    if (!there && map != nullptr) return std::nullopt;
    range = hull(range, there);
  }
  return range;
}

}  // namespace rastercheck::oracle
