#include "oracle/internal/value_errors.h"

#include <algorithm>
#include <utility>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/stored_depth.h"

namespace rastercheck::oracle {
namespace {

/// The least and the greatest of some readings; doubles mostly suffice to compare them.
class Hull {
 public:
  void add(Fraction reading) {
    const records::Enclosure around = enclose(reading);
    if (!least_ || is_below(reading, around, *least_, least_around_)) {
      least_ = reading;
      least_around_ = around;
    }
    if (!greatest_ || is_below(*greatest_, greatest_around_, reading, around)) {
      greatest_ = std::move(reading);
      greatest_around_ = around;
    }
  }
  const Fraction& lo() const { return *least_; }
  const Fraction& hi() const { return *greatest_; }

 private:
  static bool is_below(const Fraction& a, const records::Enclosure& around_a, const Fraction& b,
                       const records::Enclosure& around_b) {
    if (around_a.hi < around_b.lo) return true;
    if (around_a.lo > around_b.hi) return false;
    return compare(a, b) < 0;
  }

  std::optional<Fraction> least_;
  std::optional<Fraction> greatest_;
  records::Enclosure least_around_;
  records::Enclosure greatest_around_;
};

/// Records whether readings on both sides of a computed value have been seen, so that the value
/// lies between them.
class Bracket {
 public:
  /// `sign` is the sign of computed − reading.
  void see(int sign) {
    some_below_ = some_below_ || sign >= 0;
    some_above_ = some_above_ || sign <= 0;
  }
  bool holds() const { return some_below_ && some_above_; }

 private:
  bool some_below_ = false;
  bool some_above_ = false;
};

}  // namespace

ValueErrors::ValueErrors(const TriangleSetup& triangle, const TriangleValues& values)
    : triangle_(&triangle), values_(&values) {
  const std::size_t attributes = triangle.scene->source().attributes.size();
  subjects_.reserve(1 + attributes);
  subjects_.push_back(depth_subject());
  for (std::size_t a = 0; a < attributes; ++a) subjects_.push_back(attribute_subject(a));
}

ValueErrors::Subject ValueErrors::depth_subject() const {
  const Scene& scene = *triangle_->scene;
  Subject subject;
  subject.quantity = values_->depth_quantity();
  subject.scale = scale_exponent(std::max(scene.least_depth(), scene.greatest_depth()));
  subject.is_clamped = scene.clamps_depth();
  subject.clamp = {{scene.clamp_least()}, {scene.clamp_greatest()}};
  subject.ends = values_->depth_ends();
  subject.corners.resize(triangle_->corner_count());
  if (triangle_->promise.is_made && triangle_->depth_offset()) {
    subject.offset = triangle_->depth_offset()->exact;
  }
  if (scene.stores_depths()) subject.has_ideal = !has_open_depths(*triangle_);
  if (scene.unorm_bits() != 0) set_steps(subject);
  return subject;
}

/// Puts a depth, and all that it is compared with, in units of steps, which are exactly what the
/// scale ULP of numbers up to 2^24 are then.
void ValueErrors::set_steps(Subject& subject) const {
  const Ring steps(steps_of(triangle_->scene->unorm_bits()));
  for (Ring& numerator : subject.quantity.numerators) numerator = numerator * steps;
  const auto scale = [&steps](FractionRange& range) {
    range.lo.numerator = range.lo.numerator * steps;
    range.hi.numerator = range.hi.numerator * steps;
  };
  scale(subject.clamp);
  scale(subject.ends);
  if (subject.offset) scale(*subject.offset);
  subject.scale = kFractionBits;
  subject.steps = steps;
  if (has_open_depths(*triangle_)) {
    subject.reach = exact_reach(triangle_->scene->contract().depth_store);
  }
}

ValueErrors::Subject ValueErrors::attribute_subject(std::size_t attribute) const {
  Subject subject;
  subject.quantity = values_->quantity(attribute);
  const auto declared = triangle_->scene->source().attributes[attribute].interpolation;
  if (declared == cases::Interpolation::smooth && !subject.quantity.is_perspective) {
    subject.perspective = values_->perspective_quantity(attribute);
  }
  subject.scale = scale_exponent(values_->vertex_magnitude(attribute));
  subject.ends = values_->ends(attribute);
  subject.corners.resize(triangle_->corner_count());
  return subject;
}

const Reading& ValueErrors::ideal(const Subject& subject) const {
  if (!subject.ideal) subject.ideal = subject.quantity.on(triangle_->ideal);
  return *subject.ideal;
}

const Reading& ValueErrors::corner(const Subject& subject, std::size_t index) const {
  std::optional<Reading>& reading = subject.corners[index];
  if (!reading) reading = subject.quantity.on(triangle_->corner(index));
  return *reading;
}

Fraction ValueErrors::clamped(const Subject& subject, Fraction value) {
  if (!subject.is_clamped) return value;
  if (compare(subject.clamp.lo, value) > 0) return subject.clamp.lo;
  if (compare(subject.clamp.hi, value) < 0) return subject.clamp.hi;
  return value;
}

/// The sign of computed − v, where v is `value` clamped as the rules do.
int ValueErrors::compare_clamped(const Subject& subject, const Ring& computed,
                                 const Fraction& value) {
  const int sign = compare(computed, value);
  if (!subject.is_clamped) return sign;
  const Ring& lo = subject.clamp.lo.numerator;
  const Ring& hi = subject.clamp.hi.numerator;
  if (computed < lo) return -1;
  if (computed > hi) return 1;
  const bool both_at_an_end = (computed == lo && sign > 0) || (computed == hi && sign < 0);
  return both_at_an_end ? 0 : sign;
}

/// The excess of a computed value if the contract allows [lo, hi] before clamping.
UlpError ValueErrors::beyond(const Subject& subject, Fraction lo, Fraction hi,
                             const Ring& computed) {
  if (compare_clamped(subject, computed, hi) > 0) {
    return {computed, clamped(subject, std::move(hi)), subject.scale};
  }
  if (compare_clamped(subject, computed, lo) < 0) {
    return {computed, clamped(subject, std::move(lo)), subject.scale};
  }
  return {};
}

/// The same for a depth that is stored, if the contract allows `range` before that.
UlpError ValueErrors::beyond_stored(const Subject& subject, const FractionRange& range,
                                    const Ring& computed) {
  const Fraction& reach = subject.reach;
  if (sign_of(reach.numerator) == 0) return beyond(subject, range.lo, range.hi, computed);
  const Fraction lo = sum(clamped(subject, range.lo), {-reach.numerator, reach.denominator});
  if (compare(computed, lo) < 0) return {computed, lo, subject.scale};
  const Fraction hi = sum(clamped(subject, range.hi), reach);
  if (compare(computed, hi) > 0) return {computed, hi, subject.scale};
  return {};
}

std::optional<UlpError> ValueErrors::single_excess(const Subject& subject, const Point& p,
                                                   Place place, const Ring& computed) const {
  const ProjectiveMap& map = *values_->single_map();
  if (map.orientation() == 0) return std::nullopt;
  if (place == Place::center && sign_of(map.inverse_w().at(p)) <= 0) return std::nullopt;
  const Reading& reading = &map == &triangle_->ideal ? ideal(subject) : corner(subject, 0);
  const Fraction value = reading.at(p);
  if (sign_of(value.denominator) <= 0) return std::nullopt;
  if (!subject.offset) return beyond_stored(subject, {value, value}, computed);
  const FractionRange biased{sum(value, subject.offset->lo), sum(value, subject.offset->hi)};
  return beyond_stored(subject, biased, computed);
}

std::optional<UlpError> ValueErrors::placed_excess(const Subject& subject, const Point& p,
                                                   Place place, const Ring& computed) const {
  const bool is_affine_at_sample = place == Place::sample && !subject.quantity.is_perspective;
  const bool has_ideal = triangle_->scene->contract().basis == cases::Basis::unspecified &&
                         triangle_->ideal.orientation() != 0 &&
                         (is_affine_at_sample || sign_of(triangle_->ideal.inverse_w().at(p)) > 0);
  const bool is_between_ends = compare_clamped(subject, computed, subject.ends.lo) >= 0 &&
                               compare_clamped(subject, computed, subject.ends.hi) <= 0;
  const int orientation = triangle_->corner(0).orientation();
  bool has_pole = orientation == 0;
  Bracket bracket;
  std::vector<Fraction> readings;
  if (has_ideal) {
    readings.push_back(ideal(subject).at(p));
    bracket.see(compare_clamped(subject, computed, readings.back()));
  }
  for (std::size_t k = 0; !has_pole && k < triangle_->corner_count(); ++k) {
    const ProjectiveMap& map = triangle_->corner(k);
    has_pole = map.orientation() != orientation || sign_of(map.inverse_w().at(p)) <= 0;
    if (has_pole) break;
    readings.push_back(corner(subject, k).at(p));
    bracket.see(compare_clamped(subject, computed, readings.back()));
    // Valid even if a later placement has a pole: the range would then include
    // [ends.lo, ends.hi], which contains the value too.
    if (place == Place::sample && is_between_ends && bracket.holds()) return UlpError();
  }
  if (has_pole && place == Place::center) return std::nullopt;

  Hull hull;
  if (has_pole) {
    hull.add(subject.ends.lo);
    hull.add(subject.ends.hi);
    if (has_ideal) hull.add(readings.front());
    return beyond(subject, hull.lo(), hull.hi(), computed);
  }
  for (std::size_t k = has_ideal ? 1 : 0; k < readings.size(); ++k) hull.add(readings[k]);
  Fraction lo = hull.lo();
  Fraction hi = hull.hi();
  if (place == Place::sample) {
    lo = greatest(lo, subject.ends.lo);
    hi = least(hi, subject.ends.hi);
  }
  if (has_ideal) {
    lo = least(lo, readings.front());
    hi = greatest(hi, readings.front());
  }
  return beyond(subject, std::move(lo), std::move(hi), computed);
}

/// True if a computed value is certainly permitted, because the exact triangle has this value in
/// the region where the attribute may be evaluated. If false, the caller must examine the range.
bool ValueErrors::is_attained(const Subject& subject, const cases::Attribute& declared, int x,
                              int y, const Point& p, const Ring& computed) const {
  const Scene& scene = *triangle_->scene;
  if (subject.offset || sign_of(subject.reach.numerator) != 0) return false;
  if (subject.is_clamped &&
      (compare(computed, subject.clamp.lo) < 0 || compare(computed, subject.clamp.hi) > 0)) {
    return false;
  }
  if (declared.location == cases::Location::centroid) {
    // For a triangle of shape placed, centroids at samples beyond the horizon are undefined.
    const bool is_anywhere = !scene.conventions().centroid_is_a_sample &&
                             triangle_->shape != Shape::placed && !scene.covers_outside();
    return is_anywhere && values_->centroid_region(x, y).attains(ideal(subject), computed);
  }
  const bool is_sample =
      declared.location == cases::Location::sample || scene.source().framebuffer.samples == 1;
  return is_sample && !scene.covers_outside() && triangle_->shape == Shape::cut &&
         values_->single_map() == nullptr &&
         values_->cut_region(p).attains(ideal(subject), computed);
}

/// The error relative to the triangle that the contract's basis names or, if the basis allows
/// several, relative to the exact triangle. Empty if clipping leaves the snapped triangle open, if
/// that triangle is degenerate, or if 1/w <= 0 at p.
std::optional<UlpError> ValueErrors::ideal_error(const Subject& subject, const Point& p,
                                                 const Ring& computed) const {
  const ProjectiveMap* map = values_->single_map();
  if (map == nullptr) {
    const bool is_snapped = triangle_->scene->contract().basis == cases::Basis::snapped;
    if (is_snapped && triangle_->shape == Shape::cut) return std::nullopt;
    map = &triangle_->ideal;
  }
  if (map->orientation() == 0 || sign_of(map->inverse_w().at(p)) <= 0) return std::nullopt;
  if (subject.perspective) {
    return UlpError(computed, subject.perspective->on(*map).at(p), subject.scale);
  }
  if (!subject.has_ideal) return std::nullopt;
  const Reading& reading = map == &triangle_->ideal ? ideal(subject) : corner(subject, 0);
  Fraction value = reading.at(p);
  if (subject.offset) value = sum(value, subject.offset->lo);
  return UlpError(computed, clamped(subject, std::move(value)), subject.scale);
}

std::optional<ValueError> ValueErrors::of(std::optional<std::size_t> attribute, int x, int y,
                                          int sample, const Ring& computed) const {
  const Scene& scene = *triangle_->scene;
  const Subject& subject = subjects_[attribute ? 1 + *attribute : 0];
  cases::Attribute declared;  // the depth keeps the default: at the sample
  if (attribute) {
    declared = scene.source().attributes[*attribute];
    declared.location = scene.location_of(declared);
  }
  if (declared.interpolation == cases::Interpolation::flat) {
    const Ring value = values_->vertex_values(*attribute)[scene.conventions().provoking_vertex];
    const UlpError error(computed, Fraction{value}, subject.scale);
    return ValueError{error, error};
  }

  // If a pixel has one sample, the sample is its centre; if the sample is covered, its value is a
  // mean of the vertices' values.
  const bool at_center =
      declared.location == cases::Location::center &&
      (scene.source().framebuffer.samples > 1 || values_->single_map() != nullptr);
  const Point p = at_center ? scene.center_point(x, y) : scene.sample_point(x, y, sample);
  // Under conservative coverage a sample may lie outside the triangle, as centres may.
  const bool may_lie_outside = at_center || scene.covers_outside();
  const Place place = may_lie_outside ? Place::center : Place::sample;
  const bool is_centroid = declared.location == cases::Location::centroid;
  const bool has_one_map = values_->single_map() != nullptr;
  // Readings say nothing about open offsets, and hold no distance between them and what is stored.
  const bool has_readings =
      triangle_->shape == Shape::placed && !subject.offset && sign_of(subject.reach.numerator) == 0;
  if (!is_centroid && (has_one_map || has_readings)) {
    const std::optional<UlpError> error = has_one_map ? single_excess(subject, p, place, computed)
                                                      : placed_excess(subject, p, place, computed);
    if (!error) return std::nullopt;
    return ValueError{*error, ideal_error(subject, p, computed)};
  }
  const auto ideal_there = [&]() -> std::optional<UlpError> {
    if (is_centroid) return std::nullopt;
    return ideal_error(subject, p, computed);
  };
  if (is_attained(subject, declared, x, y, p, computed)) return ValueError{{}, ideal_there()};

  std::optional<OpenValue> open =
      attribute ? values_->attribute(*attribute, x, y, sample) : values_->depth(x, y, sample);
  if (!open) return std::nullopt;
  auto& [lo, hi] = open->range;
  if (!attribute) {
    lo.numerator = lo.numerator * subject.steps;
    hi.numerator = hi.numerator * subject.steps;
  }
  return ValueError{beyond_stored(subject, open->range, computed), ideal_there()};
}

}  // namespace rastercheck::oracle
