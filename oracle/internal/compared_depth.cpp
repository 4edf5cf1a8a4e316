#include "oracle/internal/compared_depth.h"

#include <algorithm>
#include <cmath>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/next_double.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/ulp.h"

namespace rastercheck::oracle {
namespace {

/// The bound on each side, where `step` may be added to both.
template <typename Number>
DepthSlack<Number> sided(const cases::Contract& contract, ComparedAs as, const Number& bound,
                         const Number& step) {
  const cases::DepthError excluded =
      as == ComparedAs::drawn ? cases::DepthError::never_nearer : cases::DepthError::never_farther;
  const bool is_one_sided = contract.depth_error != cases::DepthError::either_side;
  const bool is_never_nearer = is_one_sided && contract.depth_error == excluded;
  const bool is_never_farther = is_one_sided && contract.depth_error != excluded;
  const Number both = bound + step;
  return {is_never_nearer ? step : both, is_never_farther ? step : both};
}

}  // namespace

DepthSlack<Field> depth_slack(const TriangleSetup& triangle, ComparedAs as) {
  const Scene& scene = *triangle.scene;
  const Field largest(std::max(scene.least_depth(), scene.greatest_depth()));
  const Rational unit = ulp(to_rational(largest));
  const cases::ValueBound& promised = triangle.promise.bounds.depth;
  const Field bound =
      exact_field(promised.constant) * to_field(unit) + exact_field(promised.absolute);
  return sided(scene.contract(), as, bound,
               Field(cases::depth_step(scene.contract().depth_format)));
}

DepthSlack<double> near_depth_slack(const TriangleSetup& triangle, ComparedAs as) {
  const cases::Viewport& viewport = triangle.scene->source().viewport;
  const float largest = std::max(viewport.min_depth, viewport.max_depth);
  const cases::ValueBound& promised = triangle.promise.bounds.depth;
  // Exact, because it is a float32 times a power of 2.
  double bound = std::ldexp(double{promised.constant}, ulp_exponent(largest));
  const double step = cases::depth_step(triangle.scene->contract().depth_format);
  // Rounds upwards by more than two sums can round down.
  const bool is_sum = step != 0 || promised.absolute != 0;
  if (is_sum) bound = (bound + double{promised.absolute}) * (1 + 0x1p-50);
  return sided(triangle.scene->contract(), as, bound, is_sum ? step * (1 + 0x1p-50) : step);
}

double directed(const SceneTruth& scene, double depth) {
  return scene.contract().is_depth_reversed() ? -depth : depth;
}

double initial_depth(const SceneTruth& scene) {
  return directed(scene, double{scene.contract().depth_beginning(scene.source().depth_clear)});
}

std::optional<FieldRange> compared_depths(const TriangleTruth& truth, int x, int y, int sample,
                                          ComparedAs as) {
  if (truth.is_value_free(std::nullopt)) return std::nullopt;
  const std::optional<ValueRange> depth = truth.depth(x, y, sample);
  if (!depth) return std::nullopt;
  const DepthSlack<Field> slack = depth_slack(truth.setup(), as);
  const Field& lo = to_field(depth->lo);
  const Field& hi = to_field(depth->hi);
  const bool is_reversed = truth.setup().scene->contract().is_depth_reversed();
  return is_reversed ? FieldRange{-hi - slack.nearer, -lo + slack.farther}
                     : FieldRange{lo - slack.nearer, hi + slack.farther};
}

records::Enclosure widened_depths(const SceneTruth& scene, const records::Enclosure& depths,
                                  const DepthSlack<double>& slack) {
  const bool is_reversed = scene.contract().is_depth_reversed();
  const double lo = is_reversed ? -depths.hi : depths.lo;
  const double hi = is_reversed ? -depths.lo : depths.hi;
  return {next_below(lo - slack.nearer), next_above(hi + slack.farther)};
}

}  // namespace rastercheck::oracle
