#include "properties/window_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/random_state.h"

namespace rastercheck::properties::window_position_test {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

cases::Case screen(cases::Rules rules) {
  cases::Case c;
  c.rules = rules;
  c.framebuffer = {8, 8, 1};
  c.viewport = {2, 4, 8, 16, 0, 1};
  return c;
}

// (8, 8) is three quarters along the viewport's [2, 10] and a quarter along its [4, 20]: NDC 1/2
// and −1/2. The sign of y is reversed if NDC y points up and window y down.
TEST(AtWindow, IsTheInverseOfTheViewport) {
  EXPECT_EQ(at_window(screen(cases::Rules::vulkan), {8, 8}, 0.25F, 2),
            (cases::ClipVertex{1, -1, 0.5F, 2}));
  EXPECT_EQ(at_window(screen(cases::Rules::opengl), {8, 8}, 0.25F, 2),
            (cases::ClipVertex{1, -1, 0.5F, 2}));
  EXPECT_EQ(at_window(screen(cases::Rules::d3d), {8, 8}, 0.25F, 2),
            (cases::ClipVertex{1, 1, 0.5F, 2}));
}

TEST(AtWindow, StaysFinite) {
  const cases::ClipVertex far = at_window(screen(cases::Rules::vulkan), {1e30, 8}, 0, 0x1p100F);
  EXPECT_EQ(far.x, kLargest);
}

TEST(IsExactlyAt, IsTheViewportWithoutRounding) {
  for (const auto rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    const cases::Case c = screen(rules);
    const cases::ClipVertex vertex = at_window(c, {8.5, 7.0625}, 0, 4095.0F / 256);
    EXPECT_TRUE(is_exactly_at(c, vertex, {8.5, 7.0625}));
    EXPECT_FALSE(is_exactly_at(c, vertex, {8.5, 7}));
    EXPECT_FALSE(is_exactly_at(c, vertex, {8, 7.0625}));
    cases::ClipVertex beside = vertex;
    beside.x = stepped(vertex.x, 1);
    EXPECT_FALSE(is_exactly_at(c, beside, {8.5, 7.0625}));
    beside = vertex;
    beside.y = stepped(vertex.y, -1);
    EXPECT_FALSE(is_exactly_at(c, beside, {8.5, 7.0625}));
  }
}

// The terms are 2^-149 · 8, w · 8, w · 4 and −w · 12 with w = 1; sums in double lose the first
// term.
TEST(IsExactlyAt, LosesNothingBesideLargeNumbers) {
  const cases::Case c = screen(cases::Rules::vulkan);
  EXPECT_TRUE(is_exactly_at(c, {0, 0, 0, 1}, {6, 12}));
  EXPECT_FALSE(is_exactly_at(c, {0x1p-149F, 0, 0, 1}, {6, 12}));
  EXPECT_FALSE(is_exactly_at(c, {0, -0x1p-149F, 0, 0x1p127F}, {6, 12}));
  EXPECT_TRUE(is_exactly_at(c, {0, 0, 0, 0x1p127F}, {6, 12}));
}

TEST(VisiblePoint, LiesInViewportAndFramebuffer) {
  Draw draw(1, "a law", 0);
  cases::Case c = screen(cases::Rules::vulkan);
  c.framebuffer.samples = 4;
  for (int i = 0; i < 100; ++i) {
    const WindowPoint p = visible_point(draw, c);
    EXPECT_TRUE(2 <= p.u && p.u <= 8 && 4 <= p.v && p.v <= 8) << p.u << ", " << p.v;
    const WindowPoint sample = visible_sample(draw, c);
    const double u = 16 * (sample.u - std::floor(sample.u));
    EXPECT_TRUE(u == 2 || u == 6 || u == 10 || u == 14) << u;
  }
  c.viewport.x = 100;  // nothing is visible: a point of the framebuffer
  EXPECT_LE(visible_point(draw, c).u, 8);
}

// With a + b = k q, all sums and products below are exact in double.
TEST(EdgeThrough, HoldsThePointExactly) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    Draw draw(1, "a law", i);
    StateRequest request;
    request.is_on_grid = true;
    const cases::Case c = random_state(draw, request);
    const WindowPoint p = visible_sample(draw, c);
    const auto [a, b] = edge_through(draw, c, p, 0.625F);
    const cases::ClipVertex q = at_window(c, p, 0.625F, 1);
    const double k = double{a.w} + double{b.w};
    EXPECT_GT(a.w, 0);
    EXPECT_GT(b.w, 0);
    EXPECT_EQ(double{a.x} + double{b.x}, k * double{q.x}) << i;
    EXPECT_EQ(double{a.y} + double{b.y}, k * double{q.y}) << i;
    EXPECT_EQ(double{a.z} + double{b.z}, k * double{q.z}) << i;
    const WindowPoint back{
        double{c.viewport.x} + (double{q.x} + 1) * double{c.viewport.width} / 2,
        double{c.viewport.y} + ((c.rules == cases::Rules::d3d ? -1 : 1) * double{q.y} + 1) *
                                   double{c.viewport.height} / 2};
    EXPECT_EQ(back.u, p.u);
    EXPECT_EQ(back.v, p.v);
  }
}

}  // namespace
}  // namespace rastercheck::properties::window_position_test
