#include "oracle/internal/compared_depth.h"

#include <algorithm>
#include <cmath>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/next_double.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/stored_depth.h"
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

/// The step that a backend may round depths by on its own account.
double step_of(const Scene& scene) {
  return scene.unorm_bits() != 0 ? 0 : cases::depth_step(scene.contract().depth_format);
}

/// The greatest depth that a bias may lead to, beyond the viewport's depth range: ULP are those of
/// the depth then. 0 without a bias.
Ring greatest_biased(const Scene& scene) {
  return scene.has_depth_bias() ? scene.clamp_greatest() : Ring(0);
}

/// The depths that a unorm format may store for those in a range.
records::Enclosure stored_depths(const Scene& scene, const Field& lo, const Field& hi) {
  const int bits = scene.unorm_bits();
  const StoredRange k = stored_range(lo, hi, bits, scene.contract().depth_store);
  return {k.least / steps_of(bits), k.greatest / steps_of(bits)};
}

/// The same in doubles; NaN for NaN.
records::Enclosure near_stored_depths(const Scene& scene, const records::Enclosure& depths) {
  const double steps = steps_of(scene.unorm_bits());
  const cases::DepthStore store = scene.contract().depth_store;
  const double reach = cases::reach_of(store);
  const double lo = next_below(std::clamp(depths.lo, 0.0, 1.0) * steps);
  const double hi = next_above(std::clamp(depths.hi, 0.0, 1.0) * steps);
  const bool is_either = store == cases::DepthStore::either;
  const double least = is_either ? std::floor(lo) : std::ceil(next_below(lo - reach));
  const double greatest = is_either ? std::ceil(hi) : std::floor(next_above(hi + reach));
  return {std::max(least, 0.0) / steps, std::min(greatest, steps) / steps};
}

records::Enclosure directed(const SceneTruth& scene, const records::Enclosure& depths) {
  return scene.contract().is_depth_reversed() ? records::Enclosure{-depths.hi, -depths.lo} : depths;
}

}  // namespace

DepthSlack<Field> depth_slack(const TriangleSetup& triangle, ComparedAs as) {
  const Scene& scene = *triangle.scene;
  const Field largest(std::max(scene.greatest_depth(), greatest_biased(scene)));
  const Rational unit = ulp(to_rational(largest));
  const cases::ValueBound& promised = triangle.promise.bounds.depth;
  const Field bound =
      exact_field(promised.constant) * to_field(unit) + exact_field(promised.absolute);
  return sided(scene.contract(), as, bound, Field(step_of(scene)));
}

DepthSlack<double> near_depth_slack(const TriangleSetup& triangle, ComparedAs as) {
  const cases::Viewport& viewport = triangle.scene->source().viewport;
  const auto biased = static_cast<float>(near_double(greatest_biased(*triangle.scene)));
  const float largest = std::max({viewport.min_depth, viewport.max_depth, biased});
  const cases::ValueBound& promised = triangle.promise.bounds.depth;
  // Exact, because it is a float32 times a power of 2.
  double bound = std::ldexp(double{promised.constant}, ulp_exponent(largest));
  const double step = step_of(*triangle.scene);
  // Rounds upwards by more than two sums can round down.
  const bool is_sum = step != 0 || promised.absolute != 0;
  if (is_sum) bound = (bound + double{promised.absolute}) * (1 + 0x1p-50);
  return sided(triangle.scene->contract(), as, bound, is_sum ? step * (1 + 0x1p-50) : step);
}

records::Enclosure initial_depths(const SceneTruth& scene) {
  const double clear{scene.contract().depth_beginning(scene.source().depth_clear)};
  if (scene.scene().unorm_bits() != 0) {
    return directed(scene, stored_depths(scene.scene(), Field(clear), Field(clear)));
  }
  const bool is_exact = clear == 0 || clear == 1;
  const double step = is_exact ? 0 : step_of(scene.scene());
  return directed(scene, records::Enclosure{clear - step, clear + step});
}

std::optional<FieldRange> compared_depths(const TriangleTruth& truth, int x, int y, int sample,
                                          ComparedAs as) {
  if (truth.is_value_free(std::nullopt)) return std::nullopt;
  const std::optional<ValueRange> depth = truth.depth(x, y, sample);
  if (!depth) return std::nullopt;
  const Scene& scene = *truth.setup().scene;
  const DepthSlack<Field> slack = depth_slack(truth.setup(), as);
  const bool is_reversed = scene.contract().is_depth_reversed();
  Field lo = to_field(depth->lo) - (is_reversed ? slack.farther : slack.nearer);
  Field hi = to_field(depth->hi) + (is_reversed ? slack.nearer : slack.farther);
  if (scene.unorm_bits() != 0) {
    const records::Enclosure stored = stored_depths(scene, lo, hi);
    lo = Field(stored.lo);
    hi = Field(stored.hi);
  }
  return is_reversed ? FieldRange{-hi, -lo} : FieldRange{lo, hi};
}

records::Enclosure widened_depths(const SceneTruth& scene, const records::Enclosure& depths,
                                  const DepthSlack<double>& slack) {
  const bool is_reversed = scene.contract().is_depth_reversed();
  const records::Enclosure widened{
      next_below(depths.lo - (is_reversed ? slack.farther : slack.nearer)),
      next_above(depths.hi + (is_reversed ? slack.nearer : slack.farther))};
  return directed(scene, scene.scene().unorm_bits() != 0
                             ? near_stored_depths(scene.scene(), widened)
                             : widened);
}

}  // namespace rastercheck::oracle
