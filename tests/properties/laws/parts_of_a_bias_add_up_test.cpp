// The law catches a bias of which only one part counts, and one that is not doubled.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::parts_of_a_bias_add_up_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "the-parts-of-a-bias-add-up";

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

Case with_both() {
  Case c = sloped(1, 0);
  c.depth_bias.constant = 0x1p18F;  // 2^18 · 2^(-2-23) = 2^-7, as the greatest depth is 1/2: 2^-6
  return c;
}

TEST(BiasParts, AddUp) {
  const Check check = check_of(kLaw, with_both(), {}, "cpu");
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::IsSupersetOf({"both", "doubled", "moved"}));
}

TEST(BiasParts, BothCount) {
  const Damage forgets_constant = [](const Case& c, Fragments& drawn) {
    if (c.depth_bias.slope == 1 && c.depth_bias.constant != 0) shift(drawn, -0x1p-7F);
  };
  EXPECT_GE(check_of(kLaw, with_both(), forgets_constant, "cpu").violation_count, 64U);
}

TEST(BiasParts, AreDoubled) {
  const Damage saturates = [](const Case& c, Fragments& drawn) {
    if (c.depth_bias.slope == 2) shift(drawn, -0x1p-7F);
  };
  EXPECT_EQ(check_of(kLaw, with_both(), saturates, "cpu").violation_count, 64U);
}

TEST(BiasParts, AreNotWatchedAtTheEndsOfDepth) {
  Case c = with_both();
  c.depth_bias.slope = 64;
  EXPECT_EQ(check_of(kLaw, c, {}, "cpu").violation_count, 0U);
  EXPECT_FALSE(check_of(kLaw, square(), {}, "cpu").is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::parts_of_a_bias_add_up_test
