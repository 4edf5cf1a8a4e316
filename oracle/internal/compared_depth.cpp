#include "oracle/internal/compared_depth.h"

#include <algorithm>
#include <cmath>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/next_double.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/ulp.h"

namespace rastercheck::oracle {

Field depth_slack(const TriangleSetup& triangle) {
  const Scene& scene = *triangle.scene;
  const Field largest(std::max(scene.least_depth(), scene.greatest_depth()));
  const Rational unit = ulp(to_rational(largest));
  return exact_field(triangle.promise.bounds.depth.constant) * to_field(unit) +
         Field(cases::depth_step(scene.contract().depth_format));
}

double near_depth_slack(const TriangleSetup& triangle) {
  const cases::Viewport& viewport = triangle.scene->source().viewport;
  const float largest = std::max(viewport.min_depth, viewport.max_depth);
  // Exact, because it is a float32 times a power of 2.
  const double bound =
      std::ldexp(double{triangle.promise.bounds.depth.constant}, ulp_exponent(largest));
  const double step = cases::depth_step(triangle.scene->contract().depth_format);
  return step == 0 ? bound : (bound + step) * (1 + 0x1p-50);
}

std::optional<FieldRange> compared_depths(const TriangleTruth& truth, int x, int y, int sample) {
  if (truth.is_value_free(std::nullopt)) return std::nullopt;
  const std::optional<ValueRange> depth = truth.depth(x, y, sample);
  if (!depth) return std::nullopt;
  const Field slack = depth_slack(truth.setup());
  return FieldRange{to_field(depth->lo) - slack, to_field(depth->hi) + slack};
}

records::Enclosure widened_depths(const records::Enclosure& depths, double slack) {
  return {next_below(depths.lo - slack), next_above(depths.hi + slack)};
}

}  // namespace rastercheck::oracle
