// The law catches a pixel on the shared edge that neither triangle covers, and accepts pixels that
// both cover.

#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::shared_edge_leaves_no_pixel_out_test {
namespace {

using cases::Case;
using cases::Fragments;

constexpr std::string_view kLaw = "a-shared-edge-leaves-no-touched-pixel-out";
constexpr const char* kOuter = "cpu:conservative=outer";

TEST(TouchedPixelsOfASharedEdge, AreDrawnByBothOfTheSquare) {
  const Check check = check_of(kLaw, square(), Damage(), kOuter);
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.labels, std::vector<std::string>{"drawn by both"});
}

TEST(TouchedPixelsOfASharedEdge, MayBeDrawnByOne) {
  const Check check = check_of(
      kLaw, square(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 3, 4); }, kOuter);
  EXPECT_EQ(check.violation_count, 0U);
}

TEST(TouchedPixelsOfASharedEdge, AreCaughtIfNeitherDrawsThem) {
  const auto damage = [](const Case&, Fragments& drawn) {
    drop(drawn, 0, 3, 4);
    drop(drawn, 1, 3, 4);
  };
  const Check check = check_of(kLaw, square(), damage, kOuter);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, records::FragmentClass::missing);
  EXPECT_EQ(check.violations[0].place.x, 3U);
  EXPECT_EQ(check.violations[0].place.y, 4U);
}

TEST(TouchedPixelsOfASharedEdge, AreNotPromisedOtherwise) {
  for (const char* const other : {"cpu", "cpu:conservative=inner"}) {
    EXPECT_FALSE(check_of(kLaw, square(), Damage(), other).is_applicable);
  }
}

}  // namespace
}  // namespace rastercheck::properties::shared_edge_leaves_no_pixel_out_test
