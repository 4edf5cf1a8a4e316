// The law catches samples that are missing, drawn twice, or of a triangle or pixel that does not
// exist, and the wrong triangle; it ignores values.

#include <gtest/gtest.h>

#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::coverage_obeys_the_contract_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "coverage-obeys-the-contract";

TEST(CoverageObeysTheContract, FindsAMissingFragment) {
  const Check check =
      check_of(kLaw, square(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 1, 1); });
  expect_at(only(check), FragmentClass::missing, AttributeKind::coverage, 0, 1, 1);
  EXPECT_EQ(only(check).exact, "required: inside");
  EXPECT_EQ(only(check).actual, "not drawn");
}

TEST(CoverageObeysTheContract, FindsAnExtraFragment) {
  const Check check =
      check_of(kLaw, square(), [](const Case&, Fragments& drawn) { add(drawn, 0, 6, 6); });
  expect_at(only(check), FragmentClass::extra, AttributeKind::coverage, 0, 6, 6);
  EXPECT_EQ(only(check).exact, "forbidden: outside");
  EXPECT_EQ(only(check).actual, "drawn");
}

TEST(CoverageObeysTheContract, FindsAFragmentDrawnTwice) {
  const Check check =
      check_of(kLaw, square(), [](const Case&, Fragments& drawn) { add(drawn, 0, 1, 1); });
  expect_at(only(check), FragmentClass::extra, AttributeKind::coverage, 0, 1, 1);
  EXPECT_EQ(only(check).note, "drawn more than once");
}

TEST(CoverageObeysTheContract, FindsFragmentsOfNothing) {
  const Check check = check_of(kLaw, square(), [](const Case&, Fragments& drawn) {
    add(drawn, 1, 8, 0);
    add(drawn, 2, 0, 0);
  });
  EXPECT_EQ(check.violation_count, 2U);
  for (const records::Violation& violation : check.violations) {
    EXPECT_EQ(violation.fragment_class, FragmentClass::extra);
    EXPECT_EQ(violation.exact, "forbidden: no such triangle, pixel or sample");
  }
}

// A and a copy of A behind it: at pixel (1, 1) the copy is drawn although A is nearer.
TEST(CoverageObeysTheContract, FindsTheWrongTriangleUnderADepthTest) {
  Case c = square();
  c.depth_test = cases::DepthTest::less;
  c.positions.insert(c.positions.end(), {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}});
  c.attribute_values.resize(c.positions.size() * 3);
  c.triangles = {{0, 1, 2}, {4, 5, 6}};
  EXPECT_EQ(check_of(kLaw, c, {}).violation_count, 0U);
  const Check check = check_of(
      kLaw, c, [](const Case&, Fragments& drawn) { drawn.triangle[find(drawn, 0, 1, 1)] = 1; });
  expect_at(only(check), FragmentClass::wrong_triangle, AttributeKind::coverage, 1, 1, 1);
}

TEST(CoverageObeysTheContract, LeavesValuesAlone) {
  const Check check = check_of(kLaw, square(), [](const Case&, Fragments& drawn) {
    value(drawn, 0, 1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
  });
  EXPECT_EQ(check.violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::coverage_obeys_the_contract_test
