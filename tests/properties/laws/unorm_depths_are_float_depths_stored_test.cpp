// The law catches truncated depths, and depths that their format does not have.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::unorm_depths_are_float_depths_stored_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "unorm-depths-are-float-depths-stored";

/// Depth 1/4, which is 16383.75 of 65535.
Case in_16_bits() {
  Case c = square();
  c.depth_format = cases::DepthFormat::unorm16;
  return c;
}

/// Sets a depth of the drawing in the unorm format.
Damage setting(float depth) {
  return [depth](const Case& c, Fragments& drawn) {
    if (cases::unorm_bits(c.depth_format) != 0) drawn.depth[find(drawn, 0, 1, 2)] = depth;
  };
}

TEST(UnormDepths, AreFloatDepthsStored) {
  const Check check = check_of(kLaw, in_16_bits(), {}, "cpu");
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  EXPECT_THAT(check.labels, testing::Contains("16 bits"));
}

TEST(UnormDepths, AreNotTruncated) {
  expect_at(only(check_of(kLaw, in_16_bits(), setting(16383.0F / 65535), "cpu")),
            FragmentClass::beyond_bound, AttributeKind::depth, 0, 1, 2);
}

TEST(UnormDepths, AreNumbersOfTheirFormat) {
  for (const float depth : {0.25F, std::nextafter(16384.0F / 65535, 1.0F), -0x1p-20F, 1.5F}) {
    const Check check = check_of(kLaw, in_16_bits(), setting(depth), "cpu");
    expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::depth, 0, 1, 2);
    EXPECT_EQ(only(check).note, "no number of the format");
  }
}

TEST(UnormDepths, OfOpenPositionsAreWatchedInLevelPlanes) {
  DamagedBackend backend(setting(16000.0F / 65535), "cpu");
  backend.promised = backend.promise(in_16_bits());
  backend.promised->basis = cases::Basis::unspecified;
  EXPECT_EQ(check_of(kLaw, in_16_bits(), backend).violation_count, 1U);
  Case sloped = in_16_bits();
  for (cases::ClipVertex& p : sloped.positions) p.z = (p.x + 3) / 8;
  EXPECT_EQ(check_of(kLaw, sloped, backend).violation_count, 0U);
}

TEST(UnormDepths, AreNotFloats) { EXPECT_FALSE(check_of(kLaw, square(), {}, "cpu").is_applicable); }

}  // namespace
}  // namespace rastercheck::properties::unorm_depths_are_float_depths_stored_test
