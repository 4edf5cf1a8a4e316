// The float32 numbers that the judge takes for right (oracle/judge.h), from both ends:
//
//   greatest f  with  (f − hi)/ulp(max(|hi|, magnitude)) <= bound,    the least f likewise from lo.
//
// A depth that may be wrong to one side only ends at lo, or at hi, on the other.

#include <cmath>
#include <limits>

#include "oracle/internal/rational_number.h"
#include "oracle/internal/stored_depth.h"
#include "oracle/internal/ulp_error.h"
#include "oracle/internal/value_bound.h"
#include "oracle/internal/values.h"
#include "oracle/triangle_truth.h"
#include "oracle/ulp.h"

namespace rastercheck::oracle {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// The greatest float32 that is not greater: the nearest one or its neighbour. Infinite from 2^128
/// on, which is what an infinity counts as.
float greatest_float_within(const Field& limit) {
  const float f = nearest_float(limit);
  return Field(computed_ring(f)) > limit ? std::nextafter(f, -kInfinite) : f;
}

/// `distance` scale ULP of an end.
Field in_units(const Field& distance, const Field& end, const Field& magnitude_of_vertices) {
  const Field greater = std::max(magnitude(end), magnitude_of_vertices);
  return distance * to_field(ulp(to_rational(greater)));
}

Field magnitude_of_depth(const Scene& scene) {
  return Field(std::max(scene.least_depth(), scene.greatest_depth()));
}

/// How far below the range, and above it, a value may lie, in scale ULP; an empty one if any number
/// on that side is right.
struct Allowed {
  std::optional<Field> below;
  std::optional<Field> above;
};

Allowed allowed_of(const cases::Contract& contract, bool is_depth,
                   const std::optional<Rational>& bound) {
  std::optional<Field> most;
  if (bound) most = to_field(*bound);
  if (!is_depth || contract.depth_error == cases::DepthError::either_side) return {most, most};
  const bool is_never_nearer = contract.depth_error == cases::DepthError::never_nearer;
  const bool is_never_less = is_never_nearer != contract.is_depth_reversed();
  return is_never_less ? Allowed{Field(0), most} : Allowed{most, Field(0)};
}

/// The numbers of a unorm format, for depths in `range` before they are stored; `allowed` is in
/// steps.
records::FloatRange stored_numbers(const TriangleSetup& triangle, const FieldRange& range,
                                   const Allowed& allowed, int bits) {
  const Field steps(steps_of(bits));
  const Field reach = has_open_depths(triangle)
                          ? exact_reach(triangle.scene->contract().depth_store).value()
                          : Field(0);
  Field least(0);
  Field greatest = steps;
  if (allowed.below) least = std::max(least, Field(range.lo * steps - reach - *allowed.below));
  if (allowed.above)
    greatest = std::min(greatest, Field(range.hi * steps + reach + *allowed.above));
  return {stored_float(static_cast<double>(ceil_to_long(least)), bits),
          stored_float(static_cast<double>(floor_to_long(greatest)), bits)};
}

}  // namespace

std::optional<records::FloatRange> TriangleTruth::permitted_numbers(
    std::optional<std::size_t> attribute, int x, int y, int sample) const {
  if (why_free(*setup_, attribute)) return std::nullopt;
  const std::optional<ValueRange> range =
      attribute ? this->attribute(*attribute, x, y, sample) : depth(x, y, sample);
  if (!range) return std::nullopt;
  const auto allowed =
      allowed_of(setup_->scene->contract(), !attribute, value_bound(attribute, x, y, sample));
  if (!allowed.below && !allowed.above) return std::nullopt;
  const Field size =
      attribute ? to_field(attribute_magnitude(*attribute)) : magnitude_of_depth(*setup_->scene);
  const Field& lo = to_field(range->lo);
  const Field& hi = to_field(range->hi);
  if (const int bits = setup_->scene->unorm_bits(); bits != 0 && !attribute) {
    return stored_numbers(*setup_, {lo, hi}, allowed, bits);
  }
  records::FloatRange numbers{-kInfinite, kInfinite};
  if (allowed.below)
    numbers.least = 0 - greatest_float_within(in_units(*allowed.below, lo, size) - lo);
  if (allowed.above)
    numbers.greatest = greatest_float_within(hi + in_units(*allowed.above, hi, size));
  return numbers;
}

}  // namespace rastercheck::oracle
