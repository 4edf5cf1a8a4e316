// The law catches a clamp that counts although the bias is zero.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::zero_bias_changes_nothing_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-bias-of-zero-changes-nothing";

/// The law gives this case the clamp 2^-30.
Case clamped() {
  Case c = square();
  c.choices = 4;
  return c;
}

TEST(ZeroBias, ChangesNothing) {
  const Check check = check_of(kLaw, clamped(), {}, "cpu");
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Contains("clamped bias"));
}

TEST(ZeroBias, IsNotItsClamp) {
  const Damage adds_clamp = [](const Case& c, Fragments& drawn) {
    if (c.depth_bias.clamp > 0) drawn.depth[find(drawn, 0, 1, 2)] += 0x1p-20F;
  };
  expect_at(only(check_of(kLaw, clamped(), adds_clamp, "cpu")), FragmentClass::beyond_bound,
            AttributeKind::depth, 0, 1, 2);
}

// The case's own bias is replaced, so that the two drawings have none.
TEST(ZeroBias, TakesThePlaceOfTheCasesBias) {
  Case c = clamped();
  c.depth_bias.constant = 1024;
  EXPECT_EQ(check_of(kLaw, c, {}, "cpu").violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::zero_bias_changes_nothing_test
