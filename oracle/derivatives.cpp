// Screen derivatives of attributes (RULES §4), and the judgement of computed ones
// (cases::Contract::derivative_bound). With E_i affine in (u, v), r = N/D, N = Σ n_i E_i and D the
// divisor, Σ E_i or the constant |det M|:
//
//   ∂r/∂u = (N_u D − N D_u) / D²        scale = max|r_i| Σ|E_i,u| D / D²
//
// Numerators and the common denominator D² stay in the ring. If D is constant, the common
// denominator is D, and the scale is Σ|n_i E_i,u| / D.

#include <algorithm>
#include <cmath>

#include "oracle/internal/coverage.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/ulp_error.h"
#include "oracle/internal/values.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {
namespace {

using records::FragmentClass;
using records::Verdict;

/// One derivative and its scale, over a common denominator.
struct RingDerivative {
  Ring numerator{0};
  Ring scale{0};
};

/// The derivatives along u and v; the denominator is positive.
struct RingDerivatives {
  std::array<RingDerivative, 2> along;
  Ring denominator{1};
};

Ring coefficient(const Line& line, std::size_t axis) { return axis == 0 ? line.a : line.b; }

RingDerivatives smooth_derivatives(const ProjectiveMap& map, const std::array<Ring, 3>& r,
                                   const Point& p) {
  const Line numerator = map.combine(r);
  const Ring n = numerator.at(p);
  const Ring d = map.inverse_w().at(p);
  const Ring most = std::max({magnitude(r[0]), magnitude(r[1]), magnitude(r[2])});
  RingDerivatives found;
  found.denominator = d * d;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    Ring sizes(0);
    for (std::size_t i = 0; i < 3; ++i) sizes += magnitude(coefficient(map.edge(i), axis));
    found.along[axis].numerator =
        coefficient(numerator, axis) * d - n * coefficient(map.inverse_w(), axis);
    found.along[axis].scale = most * sizes * d;
  }
  return found;
}

RingDerivatives affine_derivatives(const ProjectiveMap& map, const std::array<Ring, 3>& n) {
  RingDerivatives found;
  found.denominator = map.determinant();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Ring term = n[i] * coefficient(map.edge(i), axis);
      found.along[axis].numerator += term;
      found.along[axis].scale += magnitude(term);
    }
  }
  return found;
}

/// Derivatives per pixel, from those per window unit.
RingDerivatives per_pixels(RingDerivatives found, const Ring& units_per_pixel) {
  for (RingDerivative& along : found.along) {
    along.numerator = along.numerator * units_per_pixel;
    along.scale = along.scale * units_per_pixel;
  }
  return found;
}

/// D3D's centroid: the centre if all samples are covered, else the first covered sample. Empty if
/// any sample is only permitted, or if none is covered.
std::optional<Point> centroid(const TriangleSetup& setup, int x, int y) {
  const int count = setup.scene->source().framebuffer.samples;
  std::optional<int> first;
  bool are_all_covered = true;
  for (int s = 0; s < count; ++s) {
    const Verdict verdict = decide(setup, x, y, s).verdict;
    if (verdict == Verdict::permitted) return std::nullopt;
    are_all_covered = are_all_covered && verdict == Verdict::required;
    if (!first && verdict == Verdict::required) first = s;
  }
  if (are_all_covered) return setup.scene->center_point(x, y);
  if (!first) return std::nullopt;
  return setup.scene->sample_point(x, y, *first);
}

/// The point at which an attribute of a fragment is evaluated; empty if the rules leave a choice.
std::optional<Point> place_of(const TriangleSetup& setup, const TriangleValues& values,
                              std::size_t attribute, int x, int y, int sample) {
  const Scene& scene = *setup.scene;
  const cases::Attribute& declared = scene.source().attributes[attribute];
  const bool is_centroid = declared.location == cases::Location::centroid &&
                           declared.interpolation != cases::Interpolation::flat &&
                           scene.source().framebuffer.samples > 1;
  if (!is_centroid) return values.location(attribute, x, y, sample);
  if (!scene.conventions().centroid_is_a_sample) return std::nullopt;
  return centroid(setup, x, y);
}

std::optional<RingDerivatives> derivatives_at(const TriangleSetup& setup,
                                              const TriangleValues& values, std::size_t attribute,
                                              const std::optional<Point>& p) {
  const cases::Attribute& declared = setup.scene->source().attributes[attribute];
  if (declared.interpolation == cases::Interpolation::flat) return RingDerivatives{};
  if (!p || !values.is_defined_at(attribute, *p)) return std::nullopt;
  const ProjectiveMap& map = *values.single_map();
  const Quantity quantity = values.quantity(attribute);
  const Ring& per_pixel = setup.scene->units_per_pixel();
  if (!quantity.is_perspective) {
    return per_pixels(affine_derivatives(map, quantity.numerators), per_pixel);
  }
  if (sign_of(map.inverse_w().at(*p)) <= 0) return std::nullopt;
  return per_pixels(smooth_derivatives(map, quantity.numerators, *p), per_pixel);
}

/// Divides `number` (the numerator or the scale) of both derivatives by the denominator.
Derivatives divided(const RingDerivatives& found, Ring RingDerivative::*number) {
  const auto over = [&found](const Ring& n) { return to_rational(quotient(n, found.denominator)); };
  const auto& [u, v] = found.along;
  return {over(u.*number), over(v.*number)};
}

/// Returns floor(log2(n/d)), empty for n = 0. Doubles mostly suffice to decide.
ScaleExponent exponent_of(const Ring& n, const Ring& d) {
  if (sign_of(n) == 0) return std::nullopt;
  const records::Enclosure rough = enclose(Fraction{n, d});
  constexpr double kLeast = 0x1p-1000;
  constexpr double kMost = 0x1p1000;
  if (rough.lo > kLeast && rough.hi < kMost && std::ilogb(rough.lo) == std::ilogb(rough.hi)) {
    return std::ilogb(rough.lo);
  }
  return floor_log2(quotient(n, d));
}

JudgedDerivative judge_one(const RingDerivative& exact, const Ring& denominator, float computed,
                           float bound) {
  if (std::isnan(computed)) return {FragmentClass::not_a_number, std::nullopt};
  const bool is_infinite = std::isinf(computed);
  const UlpError error(computed_ring(computed), {exact.numerator, denominator},
                       exponent_of(exact.scale, denominator));
  const records::Enclosure rough = error.enclosure();
  const bool is_within = std::max(std::abs(rough.lo), std::abs(rough.hi)) <= double{bound} ||
                         magnitude(error.value()) <= exact_field(bound);
  if (is_infinite) {
    const bool lies_farther = computed > 0 ? rough.hi < 0 : rough.lo > 0;
    return {is_within || lies_farther ? FragmentClass::correct : FragmentClass::infinite,
            std::nullopt};
  }
  return {is_within ? FragmentClass::correct : FragmentClass::beyond_bound, rough};
}

}  // namespace

std::optional<Derivatives> TriangleTruth::derivatives(std::size_t attribute, int x, int y,
                                                      int sample) const {
  const auto found =
      derivatives_at(*setup_, values(), attribute, values().location(attribute, x, y, sample));
  if (!found) return std::nullopt;
  return divided(*found, &RingDerivative::numerator);
}

std::optional<ScaledDerivatives> TriangleTruth::scaled_derivatives(std::size_t attribute, int x,
                                                                   int y, int sample) const {
  const auto found = derivatives_at(*setup_, values(), attribute,
                                    place_of(*setup_, values(), attribute, x, y, sample));
  if (!found) return std::nullopt;
  return ScaledDerivatives{divided(*found, &RingDerivative::numerator),
                           divided(*found, &RingDerivative::scale)};
}

std::optional<std::array<JudgedDerivative, 2>> TriangleTruth::judge_derivatives(
    std::size_t attribute, int x, int y, int sample, std::span<const float, 2> computed,
    float bound) const {
  const auto found = derivatives_at(*setup_, values(), attribute,
                                    place_of(*setup_, values(), attribute, x, y, sample));
  if (!found) return std::nullopt;
  std::array<JudgedDerivative, 2> judged;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    judged[axis] = judge_one(found->along[axis], found->denominator, computed[axis], bound);
  }
  return judged;
}

}  // namespace rastercheck::oracle
