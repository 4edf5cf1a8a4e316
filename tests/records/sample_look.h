#pragma once

// A closer look at the grown case of sample_gate.h, made by hand. It shows pixels (3, 5) and (4, 5)
// of a triangle whose attribute is at most 1, so its scale ULP is 2^-23. The exact values are 1/2
// and 1/4.

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "records/closer_look.h"
#include "tests/records/sample_sections.h"

namespace rastercheck::records {

inline constexpr float kSampleUlp = 0x1p-23F;

/// A value of attribute 0 that is off by `ulps` scale ULP.
inline InspectedValue sample_value(double exact, float ulps) {
  InspectedValue value;
  value.attribute = 0;
  value.exact = exact == 0.5 ? "1/2" : "1/4";
  value.nearest = exact;
  value.actual = static_cast<float>(exact) + ulps * kSampleUlp;
  value.scale_error = {ulps, ulps};
  return value;
}

inline InspectedSample sample_of(std::uint32_t x, const InspectedValue& value) {
  InspectedValue depth;
  depth.exact = "1/4";
  depth.nearest = 0.25;
  depth.actual = 0.25F;
  depth.scale_error = {0, 0};
  InspectedSample sample;
  sample.place.x = x;
  sample.place.y = 5;
  sample.verdict = Verdict::required;
  sample.reason = Reason::inside;
  sample.is_drawn = true;
  sample.values = {depth, value};
  return sample;
}

/// The values are now off by 3 and 0 scale ULP. The baseline kept no pixels.
inline CloserLook sample_look() {
  CloserLook look;
  look.key = {kSampleLaw, "cpu", Origin::random, 12};
  look.kind = AttributeKind::smooth;
  look.stratum = Stratum::sliver;
  Inspection& inspection = look.inspection;
  inspection.law = kSampleLaw;
  inspection.backend = "cpu";
  inspection.source.framebuffer = {8, 8, 1};
  inspection.source.viewport = {0, 0, 8, 8, 0, 1};
  inspection.source.attributes = {{"u & v"}};
  inspection.source.positions.resize(3);
  inspection.source.attribute_values = {0, -1, 0.5F};
  inspection.source.triangles = {{0, 1, 2}};
  inspection.pattern = {{0.5, 0.5}};
  inspection.outlines = {{{1, 1}, {7, 2}, {2, 7}}};
  inspection.place.x = 3;
  inspection.place.y = 5;
  inspection.attribute = 0;
  inspection.left = 3;
  inspection.top = 5;
  inspection.width = 2;
  inspection.height = 1;
  inspection.samples = {sample_of(3, sample_value(0.5, 3)), sample_of(4, sample_value(0.25, 0))};
  inspection.splits = {
      {0, {{Stage::set_up, {2.5, 2.5}}, {Stage::rounding, {0.5, 0.5}}}, {3, 3}, true}};
  return look;
}

/// The pixels that a baseline kept: the first is 1 scale ULP too low, the second is not drawn.
inline Specimen sample_specimen() {
  Specimen specimen;
  specimen.key = {kSampleLaw, "cpu", Origin::random, 12};
  specimen.left = 3;
  specimen.top = 5;
  specimen.width = 2;
  specimen.height = 1;
  specimen.attributes = 1;
  specimen.drawn = {true, false};
  specimen.bits = {std::bit_cast<std::uint32_t>(0.25F),
                   std::bit_cast<std::uint32_t>(0.5F - kSampleUlp), 0, 0};
  return specimen;
}

}  // namespace rastercheck::records
