#include "backends/upright_viewport.h"

#include <gtest/gtest.h>

namespace rastercheck::backends::upright_viewport_test {
namespace {

cases::Case case_with(const cases::Viewport& viewport) {
  cases::Case c;
  c.framebuffer = {64, 64, 1};
  c.viewport = viewport;
  c.positions = {{0.25F, -0.5F, 0, 1}, {3, 2, 1, 4}};
  return c;
}

/// The exact window x of a vertex.
double window_x(const cases::Case& c, std::size_t vertex) {
  const cases::ClipVertex& p = c.positions[vertex];
  return (double{p.x} / double{p.w} + 1) / 2 * double{c.viewport.width} + double{c.viewport.x};
}
double window_y(const cases::Case& c, std::size_t vertex) {
  const cases::ClipVertex& p = c.positions[vertex];
  return (double{p.y} / double{p.w} + 1) / 2 * double{c.viewport.height} + double{c.viewport.y};
}

TEST(UprightViewport, LeavesEveryPositionWhereItIs) {
  for (const cases::Viewport& viewport : {cases::Viewport{40, 3, -32, 16, 0, 1},
                                          {8, 48, 32, -16.5F, 0, 1},
                                          {40.25F, 48, -32, -16, 0.5F, 0.25F}}) {
    const cases::Case c = case_with(viewport);
    const auto upright = with_upright_viewport(c, NegativeSizes::none);
    ASSERT_TRUE(upright);
    EXPECT_GT(upright->viewport.width, 0);
    EXPECT_GT(upright->viewport.height, 0);
    EXPECT_EQ(upright->viewport.min_depth, viewport.min_depth);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(window_x(*upright, i), window_x(c, i));
      EXPECT_EQ(window_y(*upright, i), window_y(c, i));
    }
  }
}

TEST(UprightViewport, TurnsNoHeightThatTheDriverTurns) {
  const cases::Case c = case_with({40, 48, -32, -16, 0, 1});
  const auto upright = with_upright_viewport(c, NegativeSizes::height);
  ASSERT_TRUE(upright);
  EXPECT_EQ(upright->viewport, (cases::Viewport{8, 48, 32, -16, 0, 1}));
  EXPECT_FALSE(with_upright_viewport(*upright, NegativeSizes::height));
}

TEST(UprightViewport, DoesNotRoundTheOtherSide) {
  EXPECT_FALSE(with_upright_viewport(case_with({0x1p-30F, 0, -32, 16, 0, 1}), NegativeSizes::none));
}

}  // namespace
}  // namespace rastercheck::backends::upright_viewport_test
