// The law catches a clamp that is ignored, and one that limits the other side as well.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::bias_is_limited_by_its_clamp_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-bias-is-limited-by-its-clamp";

/// Depth rises from 1/4 to 1/2 along x, by 1/32 a pixel.
Case sloped(float slope, float clamp) {
  Case c = square();
  for (cases::ClipVertex& p : c.positions) p.z = (p.x + 3) / 8;
  c.depth_bias = {0, slope, clamp};
  return c;
}

void shift(Fragments& drawn, float by) {
  for (float& depth : drawn.depth) depth += by;
}

TEST(BiasClamp, LimitsOneSide) {
  for (const float slope : {1.0F, -1.0F}) {
    for (const float clamp : {0x1p-8F, -0x1p-8F}) {
      const Check check = check_of(kLaw, sloped(slope, clamp), {}, "cpu");
      EXPECT_EQ(check.violation_count, 0U) << slope << ", " << clamp;
      EXPECT_THAT(check.labels,
                  testing::Contains((slope > 0) == (clamp > 0) ? "cut by the clamp"
                                                               : "beyond the clamp's other side"));
    }
  }
}

TEST(BiasClamp, IsNotIgnored) {
  const Damage ignores = [](const Case& c, Fragments& drawn) {
    if (c.depth_bias.clamp != 0) shift(drawn, 0x1p-5F - 0x1p-8F);
  };
  EXPECT_EQ(check_of(kLaw, sloped(1, 0x1p-8F), ignores, "cpu").violation_count, 64U);
}

TEST(BiasClamp, LeavesTheOtherSideAlone) {
  const Damage limits_both = [](const Case& c, Fragments& drawn) {
    if (c.depth_bias.clamp != 0) shift(drawn, 0x1p-5F - 0x1p-8F);
  };
  EXPECT_EQ(check_of(kLaw, sloped(-1, 0x1p-8F), limits_both, "cpu").violation_count, 64U);
}

TEST(BiasClamp, NeedsOneOffset) {
  DamagedBackend backend({}, "cpu");
  backend.promised = backend.promise(square());
  backend.promised->depth_bias.slope = cases::BiasSlope::between;
  EXPECT_FALSE(check_of(kLaw, sloped(1, 0x1p-8F), backend).is_applicable);
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  EXPECT_FALSE(check_of(kLaw, square(), {}, "cpu").is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::bias_is_limited_by_its_clamp_test
