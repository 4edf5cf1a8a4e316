#include "properties/inspect/run_cases.h"

#include <gtest/gtest.h>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::run_cases_test {
namespace {

const cases::Case& source() {
  static const cases::Case kSquare = square();
  return kSquare;
}

// Kills: a case drawn again for a specimen although an inspection has its drawing; the drawing of
// another backend or case.
TEST(CaseDrawer, DrawsACaseOfABackendOnce) {
  CaseDrawer drawer({});
  const cases::ClipCase clip = case_to_draw(source()).value();
  ASSERT_NE(drawer.draw(clip, "cpu"), nullptr);
  const auto* const drawn = drawer.draw(clip, "cpu")->fragments.x.data();
  const std::size_t size = drawer.draw(clip, "cpu")->fragments.size();
  EXPECT_EQ(size, 64U);
  EXPECT_EQ(drawer.draw(clip, "damaged")->fragments.size(), 63U);
  EXPECT_EQ(drawer.draw(part_of(source(), 1)->source, "cpu")->fragments.x.data(), drawn);
  cases::ClipCase other = clip;
  other.triangles.pop_back();
  EXPECT_LT(drawer.draw(other, "cpu")->fragments.size(), 64U);
  EXPECT_EQ(drawer.draw(clip, "cpu")->fragments.x.data(), drawn);
}

TEST(CaseDrawer, HasNoDrawingOfABackendThatCannotDraw) {
  CaseDrawer drawer({});
  const cases::ClipCase clip = case_to_draw(source()).value();
  EXPECT_EQ(drawer.draw(clip, "damaged:absent"), nullptr);
  EXPECT_EQ(drawer.draw(clip, "damaged:refuses"), nullptr);
}

// Kills: drawings without end in memory.
TEST(CaseDrawer, DrawsRightWhenItHasForgottenDrawings) {
  CaseDrawer drawer({});
  cases::Case large = source();
  large.framebuffer = {1024, 1024, 1};
  large.viewport.width = 1024;
  large.viewport.height = 1024;
  const cases::ClipCase clip = case_to_draw(large).value();
  EXPECT_EQ(drawer.draw(clip, "cpu")->fragments.size(), std::size_t{1} << 20);
  EXPECT_EQ(drawer.draw(case_to_draw(source()).value(), "cpu")->fragments.size(), 64U);
  EXPECT_EQ(drawer.draw(clip, "cpu")->fragments.size(), std::size_t{1} << 20);
}

}  // namespace
}  // namespace rastercheck::properties::run_cases_test
