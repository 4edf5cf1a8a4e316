// The law catches a bias that a clip distance changes, or depth clamp.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::cutting_keeps_the_bias_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "cutting-a-triangle-keeps-its-bias";

/// `choices` of 0 compares drawings with and without depth clamp, 1 adds a clip distance.
Case biased(std::uint64_t choices) {
  Case c = square();
  c.depth_bias.constant = 1024;
  c.choices = choices;
  return c;
}

TEST(Cutting, KeepsTheBias) {
  for (std::uint64_t choices = 0; choices < 12; ++choices) {
    const Check check = check_of(kLaw, biased(choices), {}, "cpu");
    EXPECT_TRUE(check.is_applicable);
    EXPECT_EQ(check.violation_count, 0U);
  }
}

TEST(Cutting, ByDistanceMustNotChangeIt) {
  const Damage forgets = [](const Case& c, Fragments& drawn) {
    if (c.clip_distance_count == 0) return;
    for (float& depth : drawn.depth) depth = 0.25F;
  };
  EXPECT_GT(check_of(kLaw, biased(1), forgets, "cpu").violation_count, 0U);
}

TEST(Cutting, ByDepthClampMustNotChangeIt) {
  const Damage forgets = [](const Case& c, Fragments& drawn) {
    if (c.depth_clamp) drawn.depth[find(drawn, 0, 1, 2)] = 0.25F;
  };
  expect_at(only(check_of(kLaw, biased(0), forgets, "cpu")), FragmentClass::beyond_bound,
            AttributeKind::depth, 0, 1, 2);
}

// The sum 3/4 + 1/2 leaves the depth range 1/4 to 3/4, but not [0, 1] of a drawing without clamp.
TEST(Cutting, ClampsToTheDepthRange) {
  Case c = biased(0);
  c.viewport.min_depth = 0.25F;
  c.viewport.max_depth = 0.75F;
  for (cases::ClipVertex& p : c.positions) p.z = 0.875F;
  c.depth_bias.constant = 0x1p21F;
  EXPECT_EQ(check_of(kLaw, c, {}, "cpu").violation_count, 0U);
  const Damage leaves_range = [](const Case& drawn_case, Fragments& drawn) {
    if (drawn_case.depth_clamp) drawn.depth[find(drawn, 0, 1, 2)] = 0.8125F;
  };
  EXPECT_EQ(check_of(kLaw, c, leaves_range, "cpu").violation_count, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::cutting_keeps_the_bias_test
