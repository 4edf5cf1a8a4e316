#include "oracle/internal/value_errors.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/internal/coverage.h"
#include "oracle/internal/rational_number.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::value_errors_test {
namespace {

cases::Contract random_contract() {
  cases::Contract contract;
  contract.basis = one_of({cases::Basis::ideal, cases::Basis::snapped, cases::Basis::unspecified});
  contract.tie_rule = one_of({cases::TieRule::top_left, cases::TieRule::unspecified});
  contract.guard_band = one_of({4.0F, 32768.0F});
  if (*rc::gen::inRange(0, 6) > 0) {
    contract.coverage = cases::Snapping{
        one_of({2, 8, 16}), one_of({cases::Rounding::nearest_even, cases::Rounding::unspecified}),
        one_of({0.0F, 0.25F})};
  }
  return contract;
}

/// The computed values that are hardest to judge: the ends of the range, rounded, their neighbours,
/// and a few others.
std::vector<float> values_near(const OpenValue& open) {
  std::vector<float> values{0.0F};
  const Field lo = open.range.lo.value();
  const Field hi = open.range.hi.value();
  for (const Field& end : {lo, hi, Field((lo + hi) / 2)}) {
    const float rounded = nearest_float(end);
    if (!std::isfinite(rounded)) continue;
    values.push_back(rounded);
    for (const float far : {-3e38F, 3e38F}) values.push_back(std::nextafter(rounded, far));
  }
  return values;
}

/// The excess by definition: from the range itself.
Field excess_by_definition(const Ring& computed, const OpenValue& open, const Ring& magnitude) {
  const ScaleExponent scale = scale_exponent(magnitude);
  const Field f(computed);
  if (f > open.range.hi.value()) return UlpError(computed, open.range.hi, scale).value();
  if (f < open.range.lo.value()) return UlpError(computed, open.range.lo, scale).value();
  return 0;
}

Ring magnitude_of(const Scene& scene, const TriangleValues& values,
                  std::optional<std::size_t> attribute) {
  if (!attribute) return std::max(scene.least_depth(), scene.greatest_depth());
  Ring largest(0);
  for (const Ring& value : values.vertex_values(*attribute)) {
    largest = std::max(largest, magnitude(value));
  }
  return largest;
}

/// Compares the errors of every covered sample with those computed from the ranges that
/// TriangleValues gives.
void expect_errors_of_ranges(const TriangleSetup& setup) {
  const Scene& scene = *setup.scene;
  const TriangleValues values(setup);
  const ValueErrors errors(setup, values);
  const PixelBox box = setup.pixels();
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const int s = (x + y) % scene.source().framebuffer.samples;
      if (decide(setup, x, y, s).verdict == records::Verdict::forbidden) continue;
      for (std::size_t subject = 0; subject <= scene.source().attributes.size(); ++subject) {
        const std::optional<std::size_t> attribute =
            subject == 0 ? std::nullopt : std::optional(subject - 1);
        const std::optional<OpenValue> open =
            attribute ? values.attribute(*attribute, x, y, s) : values.depth(x, y, s);
        if (!open) {
          RC_ASSERT(!errors.of(attribute, x, y, s, Ring(0)));
          continue;
        }
        const Ring scale = magnitude_of(scene, values, attribute);
        for (const float computed : values_near(*open)) {
          const auto error = errors.of(attribute, x, y, s, exact_ring(computed));
          RC_ASSERT(error.has_value());
          RC_ASSERT(error->excess.value() ==
                    excess_by_definition(exact_ring(computed), *open, scale));
        }
      }
    }
  }
}

// Kills: a reading outside the range; a bracket chosen too early; ends that are not clamped; a
// forgotten pole; clamping in the wrong order.
RC_GTEST_PROP(ValueErrors, AreThoseOfTheRange, ()) {
  cases::Case c = random_exact_case();
  if (*rc::gen::inRange(0, 8) == 0) c.attributes[0].location = cases::Location::centroid;
  const cases::Contract contract = random_contract();
  const SceneTruth truth(c, contract);
  expect_errors_of_ranges(TriangleSetup(truth.scene(), 0));
}

/// Ordinary triangles: all w are positive, and most of the target is covered.
RC_GTEST_PROP(ValueErrors, AreThoseOfTheRangeOfOrdinaryTriangles, ()) {
  cases::Case c = random_exact_case();
  for (cases::ClipVertex& p : c.positions) {
    const float x = ordinary_float(3);
    const float y = ordinary_float(3);
    const int w = *rc::gen::inRange(1, 9);
    p = {x * static_cast<float>(w), y * static_cast<float>(w), 0.5F * static_cast<float>(w),
         static_cast<float>(w)};
  }
  const cases::Contract contract = random_contract();
  const SceneTruth truth(c, contract);
  expect_errors_of_ranges(TriangleSetup(truth.scene(), 0));
}

}  // namespace
}  // namespace rastercheck::oracle::value_errors_test
