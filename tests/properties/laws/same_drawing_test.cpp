// Compares two drawings: they are the same, or the first difference is named.

#include "properties/laws/internal/same_drawing.h"

#include <gtest/gtest.h>

#include "backends/factory.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::same_drawing_test {
namespace {

using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

Fragments drawn_square() {
  const auto cpu = backends::make_backend("cpu");
  return draw(square(), **cpu)->fragments;
}

Check compared(const Fragments& drawn) {
  return compare_drawings(square(), drawn_square(), drawn, "a note");
}

/// The drawing with its fragments in reverse order.
Fragments turned_round(const Fragments& drawn) {
  Fragments turned = drawn;
  turned.derivatives.clear();
  const std::size_t count = drawn.attribute_count;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const std::size_t from = drawn.size() - 1 - i;
    turned.triangle[i] = drawn.triangle[from];
    turned.x[i] = drawn.x[from];
    turned.y[i] = drawn.y[from];
    turned.sample[i] = drawn.sample[from];
    turned.depth[i] = drawn.depth[from];
    for (std::size_t a = 0; a < count; ++a) {
      turned.attributes[i * count + a] = drawn.attributes[from * count + a];
    }
  }
  return turned;
}

TEST(SameDrawing, IsOneInAnyOrder) {
  const Fragments drawn = drawn_square();
  ASSERT_GT(drawn.size(), 2U);
  const Check check = compared(turned_round(drawn));
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, drawn.size());
  EXPECT_EQ(check.labels, std::vector<std::string>{"drawn"});
}

TEST(SameDrawing, LacksNoFragment) {
  Fragments drawn = drawn_square();
  drop(drawn, 0, 1, 1);
  const Check check = compared(drawn);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations[0].place.x, 1U);
  EXPECT_EQ(check.violations[0].note, "a note");
}

TEST(SameDrawing, HasNoFragmentMore) {
  Fragments drawn = drawn_square();
  add(drawn, 0, 6, 6);
  add(drawn, 0, 1, 1);
  const Check check = compared(drawn);
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].exact, "forbidden: the other drawing does not have it");
  EXPECT_EQ(check.violations[1].exact, "forbidden: drawn more than once");
}

TEST(SameDrawing, HasTheSameValues) {
  Fragments drawn = drawn_square();
  value(drawn, 0, 1, 1, 2) = -0.0F;
  const Check check = compared(drawn);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::wrong_sign_of_zero);
  EXPECT_EQ(check.violations[0].kind, AttributeKind::smooth);
  EXPECT_EQ(check.violations[0].attribute, 2U);
}

}  // namespace
}  // namespace rastercheck::properties::same_drawing_test
