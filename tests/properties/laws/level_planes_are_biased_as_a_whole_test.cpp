// The law catches an offset that differs within a plane of equal depth, or between two triangles of
// it, also where only the biased drawing is wrong.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::level_planes_are_biased_as_a_whole_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-bias-moves-planes-of-equal-depth-as-a-whole";

Case biased() {
  Case c = square();
  c.depth_bias.constant = 8;
  return c;
}

TEST(LevelPlanes, AreBiasedAsAWhole) {
  const Check check = check_of(kLaw, biased(), {}, "cpu");
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::IsSupersetOf({"biased", "several triangles"}));
}

TEST(LevelPlanes, HaveOneOffset) {
  const auto off_by_one = [](bool is_biased) {
    return [is_biased](const Case& c, Fragments& drawn) {
      float& depth = drawn.depth[find(drawn, 0, 2, 3)];
      if (c.depth_bias.is_none() != is_biased) depth = std::nextafter(depth, 1.0F);
    };
  };
  for (const bool is_biased : {true, false}) {
    expect_at(only(check_of(kLaw, biased(), off_by_one(is_biased), "cpu")),
              FragmentClass::beyond_bound, AttributeKind::depth, 0, 2, 3);
  }
}

TEST(LevelPlanes, HaveOneOffsetForAllTriangles) {
  const Check check = check_of(
      kLaw, biased(),
      [](const Case& c, Fragments& drawn) {
        if (c.depth_bias.is_none()) return;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
          if (drawn.triangle[i] == 1) drawn.depth[i] = std::nextafter(drawn.depth[i], 1.0F);
        }
      },
      "cpu");
  EXPECT_EQ(check.violation_count, 36U);
}

// Pixel (7, 7) is not covered by triangle 0.
TEST(LevelPlanes, LeaveSamplesThatShouldNotBeThereAlone) {
  const auto adds = [](const Case&, Fragments& drawn) { add(drawn, 0, 7, 7); };
  EXPECT_EQ(check_of(kLaw, biased(), adds, "cpu").violation_count, 0U);
}

TEST(LevelPlanes, AreLevel) {
  Case c = biased();
  for (cases::ClipVertex& p : c.positions) p.z = (p.x + 2) / 8;
  EXPECT_FALSE(check_of(kLaw, c, {}, "cpu").is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::level_planes_are_biased_as_a_whole_test
