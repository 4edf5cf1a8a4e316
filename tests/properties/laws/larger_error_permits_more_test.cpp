// The law judges a drawing by a larger error as well, which still forbids pixels far from the
// triangle and requires those in it.

#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::larger_error_permits_more_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-larger-error-of-conservative-coverage-permits-more";
constexpr const char* kOuter = "cpu:conservative=outer";

/// The square's first triangle alone.
Case one_triangle() {
  Case c = square();
  c.triangles.resize(1);
  return c;
}

TEST(LargerError, AcceptsExactDrawings) {
  for (const char* const backend : {kOuter, "cpu:conservative=inner"}) {
    const Check check = check_of(kLaw, one_triangle(), Damage(), backend);
    EXPECT_TRUE(check.is_applicable);
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_EQ(check.labels.back(), "permitted by the larger error");
  }
}

// Pixel (7, 7) is six pixels from the diagonal, twice the largest error.
TEST(LargerError, StillForbidsFarPixels) {
  const Check check = check_of(
      kLaw, one_triangle(), [](const Case&, Fragments& drawn) { add(drawn, 0, 7, 7); }, kOuter);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::extra);
}

TEST(LargerError, StillRequiresWhatTheTriangleTouches) {
  const Check check = check_of(
      kLaw, one_triangle(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 0, 0); }, kOuter);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::missing);
}

}  // namespace
}  // namespace rastercheck::properties::larger_error_permits_more_test
