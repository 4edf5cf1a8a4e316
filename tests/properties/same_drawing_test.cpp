// Two drawings are the same, or where they differ is named.

#include "properties/internal/same_drawing.h"

#include <gtest/gtest.h>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {
namespace {

using cases::Framebuffer;
using records::AttributeKind;
using records::FragmentClass;

Framebuffer drawn_square() {
  const auto cpu = backends::make_backend("cpu");
  return *draw(square(), **cpu);
}

Check compared(const Framebuffer& drawn) {
  return compare_drawings(square(), drawn_square(), drawn, "a note");
}

TEST(SameDrawing, IsOneInAnyOrder) {
  Framebuffer drawn = drawn_square();
  ASSERT_GT(drawn.size(), 2U);
  drop(drawn, 0, 1, 1);
  const Framebuffer whole = drawn_square();
  const std::size_t index = find(whole, 0, 1, 1);
  add(drawn, 0, 1, 1);
  drawn.depth.back() = whole.depth[index];
  for (std::size_t a = 0; a < whole.attribute_count; ++a) {
    value(drawn, 0, 1, 1, a) = whole.attributes_of(index)[a];
  }
  const Check check = compared(drawn);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, whole.size());
  EXPECT_EQ(check.labels, std::vector<std::string>{"drawn"});
}

TEST(SameDrawing, LacksNoFragment) {
  Framebuffer drawn = drawn_square();
  drop(drawn, 0, 1, 1);
  const Check check = compared(drawn);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations[0].x, 1U);
  EXPECT_EQ(check.violations[0].note, "a note");
}

TEST(SameDrawing, HasNoFragmentMore) {
  Framebuffer drawn = drawn_square();
  add(drawn, 0, 6, 6);
  add(drawn, 0, 1, 1);
  const Check check = compared(drawn);
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].exact, "forbidden: it was not drawn");
  EXPECT_EQ(check.violations[1].exact, "forbidden: more than once");
}

TEST(SameDrawing, HasTheSameValues) {
  Framebuffer drawn = drawn_square();
  value(drawn, 0, 1, 1, 2) = -0.0F;
  const Check check = compared(drawn);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::wrong_sign_of_zero);
  EXPECT_EQ(check.violations[0].kind, AttributeKind::smooth);
  EXPECT_EQ(check.violations[0].attribute, 2U);
}

}  // namespace
}  // namespace rastercheck::properties
