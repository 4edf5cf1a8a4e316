// The law catches values and coverage that depend on which vertex comes first.

#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::vertex_order_changes_nothing_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "vertex-order-changes-nothing-beyond-the-bound";

TEST(VertexOrder, FindsAValueThatDependsOnIt) {
  const Check check = check_of(kLaw, square(), [](const Case& c, Fragments& drawn) {
    if (c.triangles[0][0] == 1) value(drawn, 0, 2, 3, 1) = std::nextafter(1.0F, 2.0F);
  });
  expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::smooth, 0, 2, 3);
  EXPECT_EQ(only(check).note, "drawn in the order second, third, first vertex");
}

TEST(VertexOrder, FindsCoverageThatDependsOnIt) {
  const Check check = check_of(kLaw, square(), [](const Case& c, Fragments& drawn) {
    if (c.triangles[0][0] == 2) drop(drawn, 0, 1, 1);
  });
  expect_at(only(check), FragmentClass::missing, AttributeKind::coverage, 0, 1, 1);
  EXPECT_EQ(only(check).note, "drawn in the order third, first, second vertex");
}

TEST(VertexOrder, LetsFlatAttributesFollowTheProvokingVertex) {
  Case c = square();
  c.attributes[0].interpolation = cases::Interpolation::flat;
  EXPECT_EQ(check_of(kLaw, c, {}).violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::vertex_order_changes_nothing_test
