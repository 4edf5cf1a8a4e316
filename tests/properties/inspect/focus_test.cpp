#include "properties/inspect/focus.h"

#include <gtest/gtest.h>

#include "properties/drawing.h"
#include "properties/inspect/case_to_draw.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::focus_test {
namespace {

/// In A, x is slightly off at (1, 1) and more at (3, 2), and `one` is even more off at (3, 2). In
/// B, one depth is off.
void make_off(const cases::Case& /*c*/, cases::Fragments& d) {
  value(d, 0, 1, 1, 0) += 0x1p-22F;
  value(d, 0, 3, 2, 0) += 0x1p-21F;
  value(d, 0, 3, 2, 1) = 0x1.000002p+0F;
  d.depth[find(d, 1, 6, 6)] = 0x1.000002p-2F;
}

Focus focus_of(const FocusRequest& request, const cases::Case& c, backends::Backend& backend) {
  const cases::ClipCase clip = case_to_draw(c).value();
  return find_focus(clip, draw(clip, backend).value(), request);
}

Focus focus_of(const FocusRequest& request, const Damage& damage) {
  DamagedBackend backend(damage, "cpu");
  // Large bounds, so that small errors are not violations.
  backend.promised = cases::contract_of(square());
  backend.promised->bounds.smooth.constant = 100;
  backend.promised->bounds.depth.constant = 100;
  return focus_of(request, square(), backend);
}

Focus at(std::uint32_t triangle, std::uint32_t x, std::uint32_t y,
         std::optional<std::uint32_t> attribute) {
  return {{triangle, y, x, 0}, attribute};
}

FocusRequest request_at(std::uint32_t x, std::uint32_t y) {
  FocusRequest request;
  request.x = x;
  request.y = y;
  return request;
}

// Errors in scale ULP: 1/4 and 1/2 for x, whose largest value is 8; 1 for `one`; 1/4 for the depth.
TEST(Focus, IsTheLargestErrorWhereNothingIsViolated) {
  EXPECT_EQ(focus_of({}, make_off), at(0, 3, 2, 1));
  FocusRequest of_x;
  of_x.attribute = 0;
  EXPECT_EQ(focus_of(of_x, make_off), at(0, 3, 2, 0));
  FocusRequest of_depth;
  of_depth.is_depth = true;
  EXPECT_EQ(focus_of(of_depth, make_off), at(1, 6, 6, std::nullopt));
  FocusRequest of_second;
  of_second.triangle = 1;
  EXPECT_EQ(focus_of(of_second, make_off), at(1, 6, 6, std::nullopt));
  EXPECT_EQ(focus_of(request_at(1, 1), make_off), at(0, 1, 1, 0));
  EXPECT_EQ(focus_of({}, {}), at(0, 0, 0, std::nullopt));  // nothing is wrong: the first fragment
}

// Kills: ignoring a missing sample because of a large error.
TEST(Focus, IsTheFirstViolationWhereThereIsOne) {
  const auto lose = [](const cases::Case& c, cases::Fragments& d) {
    make_off(c, d);
    value(d, 0, 4, 1, 0) = 100;
    drop(d, 0, 5, 1);
    value(d, 0, 0, 3, 0) = 1000;
  };
  EXPECT_EQ(focus_of({}, lose), at(0, 4, 1, 0));
  FocusRequest of_column;
  of_column.x = 5;
  EXPECT_EQ(focus_of(of_column, lose), at(0, 5, 1, std::nullopt));
  const auto add_one = [](const cases::Case& /*c*/, cases::Fragments& d) { add(d, 0, 7, 7); };
  EXPECT_EQ(focus_of({}, add_one), at(0, 7, 7, std::nullopt));
}

TEST(Focus, IsWhatWasAskedForWhereNothingWasDrawn) {
  FocusRequest request = request_at(7, 6);
  request.triangle = 0;
  request.attribute = 2;
  EXPECT_EQ(focus_of(request, {}), at(0, 7, 6, 2));
  FocusRequest absent;
  absent.triangle = 9;
  EXPECT_EQ(focus_of(absent, {}), at(9, 0, 0, std::nullopt));
}

TEST(Focus, FindsTheTriangleOfAPixel) {
  EXPECT_EQ(focus_of(request_at(7, 6), {}).at.triangle, 1U);
  EXPECT_EQ(focus_of(request_at(0, 6), {}).at.triangle, 0U);
}

// Kills: a hidden fragment that counts as missing because of the depth test.
TEST(Focus, DrawsEachTriangleAlone) {
  cases::Case c = square();
  c.depth_test = cases::DepthTest::less;
  c.triangles = {{0, 1, 2}, {0, 1, 2}};
  DamagedBackend backend(
      [](const cases::Case& /*c*/, cases::Fragments& d) { value(d, 1, 2, 1, 0) = 100; }, "cpu");
  EXPECT_EQ(focus_of({}, c, backend).at, (cases::SamplePlace{1, 1, 2, 0}));
}

}  // namespace
}  // namespace rastercheck::properties::focus_test
