// Points by hand. Pictures show window rows from v = 0 on. That all points are exact, a property
// checks: points-obey-the-contract.

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::points_test {
namespace {

constexpr TargetSize kTarget{6, 4, 1};

State state_of(float size, Convention convention = Convention::vulkan) {
  State state = small_state(6, 4, convention);
  state.primitive = Primitive::points;
  state.point_size = size;
  return state;
}

SmallMesh point(const glm::vec4& position) {
  SmallMesh mesh;
  mesh.positions = {position};
  mesh.triangles = {{0, 0, 0}};
  return mesh;
}

Rows rows_of(const State& state, float u, float v) {
  return picture(state, point(at(state, u, v)), kTarget);
}

const Rows kNothing(4, "......");

TEST(Points, AreSquaresAroundTheirVertices) {
  EXPECT_EQ(rows_of(state_of(1), 2.5F, 1.5F), (Rows{"......", "..#...", "......", "......"}));
  EXPECT_EQ(rows_of(state_of(2.5F), 2.5F, 1.5F), (Rows{".###..", ".###..", ".###..", "......"}));
  EXPECT_EQ(rows_of(state_of(0.75F), 2, 1), kNothing);
}

// Samples at half of the size from the vertex are on the sides. Of the columns, the left one is
// owned; of the rows, the one that the fill rule names.
TEST(Points, OwnSamplesOnTheirSidesByTheFillRule) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    for (const FillRule rule : {FillRule::top_left, FillRule::bottom_left}) {
      // The row of least window y is the upper one unless window y points up.
      const bool owns_first_row =
          (rule == FillRule::top_left) == (convention != Convention::opengl);
      State at_corner = state_of(1, convention);
      at_corner.fill_rule = rule;
      EXPECT_EQ(rows_of(at_corner, 3, 2),
                (owns_first_row ? Rows{"......", "..#...", "......", "......"}
                                : Rows{"......", "......", "..#...", "......"}));
      State at_center = at_corner;
      at_center.point_size = 2;
      EXPECT_EQ(rows_of(at_center, 2.5F, 1.5F),
                (owns_first_row ? Rows{".##...", ".##...", "......", "......"}
                                : Rows{"......", ".##...", ".##...", "......"}));
      // An even size at a corner of four pixels: no sample is on a side.
      EXPECT_EQ(rows_of(at_center, 3, 2), (Rows{"......", "..##..", "..##..", "......"}));
    }
  }
}

// From a public report: a point of size 4 in the middle, with w = -1.
TEST(Points, BehindTheEyeAreNotDrawn) {
  const State state = state_of(4);
  EXPECT_EQ(picture(state, point({0, 0, 0, -1}), kTarget), kNothing);
  EXPECT_EQ(picture(state, point({0, 0, -0.5F, -1}), kTarget), kNothing);
  EXPECT_EQ(picture(state, point({0, 0, 0, 0}), kTarget), kNothing);
  EXPECT_EQ(picture(state, point({0, 0, 0, 1}), kTarget), Rows(4, ".####."));
}

TEST(Points, ReachBeyondTheViewportIfTheirVerticesAreInside) {
  State state = state_of(2);
  state.viewport.origin = {2, 1};
  state.viewport.size = {2, 2};
  SmallMesh mesh = point({-1, -1, 0, 1});  // at (2, 1)
  EXPECT_EQ(picture(state, mesh, kTarget), (Rows{".##...", ".##...", "......", "......"}));
  mesh.positions[0].x = -1 - 0x1p-20F;
  EXPECT_EQ(picture(state, mesh, kTarget), kNothing);
}

TEST(Points, BeyondAPlaneAreNotDrawn) {
  State state = state_of(2);
  const Rows drawn{"......", "..##..", "..##..", "......"};
  EXPECT_EQ(picture(state, point({0, 0, 1, 1}), kTarget), drawn);
  const SmallMesh far = point({0, 0, 1 + 0x1p-20F, 1});
  EXPECT_EQ(picture(state, far, kTarget), kNothing);
  state.depth_clamp = true;
  EXPECT_EQ(picture(state, far, kTarget), drawn);
  state.clip_distance_count = 1;
  SmallMesh clipped = far;
  clipped.clip_distances = {0};
  EXPECT_EQ(picture(state, clipped, kTarget), drawn);
  clipped.clip_distances = {-0x1p-140F};
  EXPECT_EQ(picture(state, clipped, kTarget), kNothing);
}

// Whole pixels: the vertex moves to (2, 2), so that the samples beside it are on the sides.
TEST(Points, FollowTheSnappedVertex) {
  State state = state_of(1);
  EXPECT_EQ(rows_of(state, 2.25F, 1.75F), (Rows{"......", "..#...", "......", "......"}));
  state.snapping = Snapping{0};
  EXPECT_EQ(rows_of(state, 2.25F, 1.75F), (Rows{"......", ".#....", "......", "......"}));
}

TEST(Points, HaveTheirVertexsValues) {
  State state = state_of(2);
  state.attributes = {{Interpolation::smooth}, {Interpolation::noperspective}};
  SmallMesh mesh = point(at(state, 3, 2, 4, 0.375F));
  mesh.attributes = {5, -7};
  const Fragments fragments = fragments_of(state, mesh, kTarget);
  EXPECT_EQ(fragments.depth, std::vector<float>(4, 0.375F));
  EXPECT_EQ(fragments.attributes, (std::vector<float>{5, -7, 5, -7, 5, -7, 5, -7}));
  Picture frame;
  ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), kTarget, 1, frame).error);
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 6; ++x) {
      const bool is_drawn = (y == 1 || y == 2) && (x == 2 || x == 3);
      EXPECT_EQ(frame.depth[6 * y + x], is_drawn ? 0.375F : 1);
      EXPECT_EQ(frame.attributes[2 * (6 * y + x) + 1], is_drawn ? -7 : 0);
    }
  }
}

TEST(Points, WithoutASizeAreRefused) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float size : {0.0F, -1.0F, kInfinity, kNan}) {
    Fragments fragments;
    const DrawResult drawn =
        draw_fragments(state_of(size), point({0, 0, 0, 1}).mesh(), kTarget, fragments);
    EXPECT_EQ(drawn.error, Error::primitive_size) << size;
  }
}

TEST(Points, AreRefusedIfConservative) {
  State state = state_of(1);
  state.conservative = Conservative::inner;
  Fragments fragments;
  EXPECT_EQ(draw_fragments(state, point({0, 0, 0, 1}).mesh(), kTarget, fragments).error,
            Error::primitive_state);
}

}  // namespace
}  // namespace rastercheck::rasterizer::points_test
