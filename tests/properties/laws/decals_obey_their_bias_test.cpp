// The law catches decals that lose a pixel to their own plane, or win one without a bias or behind
// it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::decals_obey_their_bias_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-decal-is-drawn-as-its-bias-says";

/// The law draws it with the biases −64 and 64.
Case plane() {
  Case c = square();
  c.choices = 5;
  return c;
}

bool is_tested(const Case& c) { return c.depth_test == cases::DepthTest::less; }

TEST(Decals, AreDrawnAsTheirBiasSays) {
  for (const auto format :
       {cases::DepthFormat::float32, cases::DepthFormat::unorm16, cases::DepthFormat::unorm24}) {
    Case c = plane();
    c.depth_format = format;
    const Check check = check_of(kLaw, c, {}, "cpu");
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_EQ(check.judgement.counts.required, 64U);
    EXPECT_THAT(check.labels, testing::IsSupersetOf({"nearer", "farther"}));
  }
}

TEST(Decals, AreDrawnEverywhere) {
  const Damage loses = [](const Case& c, Fragments& drawn) {
    if (is_tested(c) && c.depth_bias.constant == -64) drop(drawn, 0, 1, 2);
  };
  expect_at(only(check_of(kLaw, plane(), loses, "cpu")), FragmentClass::missing,
            AttributeKind::coverage, 0, 1, 2);
}

TEST(Decals, AreDrawnNowhereBehindTheirPlane) {
  for (const float constant : {0.0F, 64.0F}) {
    const Damage adds = [constant](const Case& c, Fragments& drawn) {
      if (is_tested(c) && c.depth_bias.constant == constant) add(drawn, 1, 6, 5);
    };
    expect_at(only(check_of(kLaw, plane(), adds, "cpu")), FragmentClass::extra,
              AttributeKind::coverage, 1, 6, 5);
  }
}

// At depth 0 nothing is nearer.
TEST(Decals, AreNotBroughtBeforeTheNearPlane) {
  Case c = plane();
  for (cases::ClipVertex& p : c.positions) p.z = 0;
  c.depth_format = cases::DepthFormat::unorm16;
  const Check check = check_of(kLaw, c, {}, "cpu");
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Not(testing::Contains("nearer")));
}

TEST(Decals, LieInPlanesOfEqualDepth) {
  Case c = plane();
  for (cases::ClipVertex& p : c.positions) p.z = (p.x + 2) / 8;
  EXPECT_FALSE(check_of(kLaw, c, {}, "cpu").is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::decals_obey_their_bias_test
