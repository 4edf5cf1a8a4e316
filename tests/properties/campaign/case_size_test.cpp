#include "properties/campaign/internal/case_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::case_size_test {
namespace {

TEST(SignificantBits, CountFromTheFirstToTheLastThatIsSet) {
  EXPECT_EQ(significant_bits(0), 0);
  EXPECT_EQ(significant_bits(-0.0F), 0);
  EXPECT_EQ(significant_bits(1), 1);
  EXPECT_EQ(significant_bits(-0x1p-149F), 1);
  EXPECT_EQ(significant_bits(0x1p127F), 1);
  EXPECT_EQ(significant_bits(3), 2);
  EXPECT_EQ(significant_bits(5), 3);
  EXPECT_EQ(significant_bits(0x1.000002p0F), 24);
  EXPECT_EQ(significant_bits(std::numeric_limits<float>::max()), 24);
}

TEST(WindowBits, CountBehindThePoint) {
  EXPECT_EQ(window_bits(3), 0);
  EXPECT_EQ(window_bits(-0.5), 1);
  EXPECT_EQ(window_bits(2.75), 2);
  EXPECT_EQ(window_bits(0x1p-8), 8);
  EXPECT_EQ(window_bits(0x1p-9), 9);
  EXPECT_EQ(window_bits(1.0 / 3), 9);
  EXPECT_EQ(window_bits(0x1p100), 0);
}

TEST(WindowPointOf, IsWhereTheViewportPutsIt) {
  const cases::Viewport viewport{10, 20, 8, -4};
  const WindowPoint point = window_point(viewport, {-1, 2, 0, 2});
  EXPECT_EQ(point.u, 10 + 8 * 0.25);
  EXPECT_EQ(point.v, 20 - 4 * 1.0);
}

/// True if the change makes the square larger, and undoing the change makes it smaller.
bool makes_larger(const std::function<void(cases::Case&)>& change) {
  const cases::Case before = square();
  cases::Case after = before;
  change(after);
  return size_of(before) < size_of(after) && !(size_of(after) < size_of(before));
}

// Kills: a part of a case that does not count towards its size, and so is never removed.
TEST(SizeOf, CountsEveryPartOfACase) {
  using cases::Case;
  EXPECT_TRUE(makes_larger([](Case& c) { c.triangles.push_back({0, 1, 3}); }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.positions.push_back({0, 0, 0, 1}); }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.framebuffer.samples = 2; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.framebuffer.width = 9; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.coverage = cases::Snapping(); }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.rules = cases::Rules::opengl; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.basis = cases::Basis::snapped; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.fill_rule = cases::TieRule::bottom_left; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.cull = cases::Cull::front; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.front_face = cases::FrontFace::cw; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.scissor = cases::Scissor{0, 0, 8, 8}; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.depth_test = cases::DepthTest::less; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.depth_clamp = true; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.viewport.max_depth = 0.5F; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.viewport.x = 1; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.viewport.width = 16; }));
  EXPECT_TRUE(makes_larger([](Case& c) {
    c.clip_distance_count = 1;
    c.clip_distances.resize(4);
  }));
  EXPECT_TRUE(
      makes_larger([](Case& c) { c.attributes[0].interpolation = cases::Interpolation::flat; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.attributes[1].location = cases::Location::center; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.camera.emplace(); }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.positions[0].w = 2; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.positions[0].x = -0.9375F; }));  // off the grid
  EXPECT_TRUE(makes_larger([](Case& c) { c.positions[0].z = 0.375F; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.positions[0].z = -0.25F; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.positions[0].z = 0.125F; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.attribute_values[2] = -0.0F; }));
  EXPECT_TRUE(makes_larger([](Case& c) { c.attribute_values[0] = 1; }));
  cases::Case with_camera = square();
  with_camera.camera.emplace();
  cases::Case turned = with_camera;
  turned.camera->view[1] = 1;
  EXPECT_LT(size_of(with_camera), size_of(turned));
}

// Kills: rejecting a case because one of its numbers is worse, although the case is better in a
// part that matters more.
TEST(SizeOf, PutsFirstThingsFirst) {
  cases::Case one = square();
  one.triangles.pop_back();
  one.depth_clamp = true;
  EXPECT_LT(size_of(one), size_of(square()));
  cases::Case simple = square();
  simple.positions[0].x = 0x1.234568p0F;
  cases::Case with_state = square();
  with_state.depth_clamp = true;
  EXPECT_LT(size_of(simple), size_of(with_state));
}

TEST(NumbersOf, AreAllThatAVertexAndACameraHave) {
  cases::Case c = square();
  c.clip_distance_count = 2;
  c.clip_distances.resize(8);
  EXPECT_EQ(numbers_of(c).size(), 16U + 12U + 8U);
  c.camera.emplace();
  EXPECT_EQ(numbers_of(c).size(), 16U + 12U + 8U + 48U);
  *numbers_of(c)[3] = 7;
  EXPECT_EQ(c.positions[0].w, 7);
}

}  // namespace
}  // namespace rastercheck::properties::case_size_test
