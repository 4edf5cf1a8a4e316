// Condition numbers of a fragment (RULES §5), reported beside its error. If a large error comes
// with a large condition number, the problem is ill-conditioned; if the condition number is small,
// the implementation is imprecise.

#include <algorithm>

#include "oracle/internal/rational_number.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/values.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {
namespace {

/// Σ |n_i E_i| / |Σ n_i E_i|; empty if the sum is 0.
std::optional<Rational> amplification(const ProjectiveMap& map, const Quantity& quantity,
                                      const Point& p) {
  Ring sum(0);
  Ring sum_of_magnitudes(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Ring term = quantity.numerators[i] * map.edge(i).at(p);
    sum += term;
    sum_of_magnitudes += magnitude(term);
  }
  if (sign_of(sum) == 0) return std::nullopt;
  return to_rational(quotient(sum_of_magnitudes, magnitude(sum)));
}

/// max_i (|A_i u| + |B_i v| + |C_i|) / D; empty if D <= 0.
std::optional<Rational> weight_cancellation(const ProjectiveMap& map, const Point& p) {
  const Ring d = map.inverse_w().at(p);
  if (sign_of(d) <= 0) return std::nullopt;
  Ring largest(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Line& e = map.edge(i);
    largest = std::max<Ring>(largest, magnitude(e.a * p.u) + magnitude(e.b * p.v) + magnitude(e.c));
  }
  return to_rational(quotient(largest, d));
}

}  // namespace

std::optional<Conditioning> TriangleTruth::conditioning(std::size_t attribute, int x, int y,
                                                        int sample) const {
  // A flat attribute is not a sum: nothing is amplified.
  if (setup_->scene->source().attributes[attribute].interpolation == cases::Interpolation::flat) {
    return std::nullopt;
  }
  const Point p = values().location(attribute, x, y, sample);
  if (!values().is_defined_at(attribute, p)) return std::nullopt;
  const ProjectiveMap* map = values().single_map();
  return Conditioning{amplification(*map, values().quantity(attribute), p),
                      weight_cancellation(*map, p)};
}

}  // namespace rastercheck::oracle
