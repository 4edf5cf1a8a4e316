// Conservative coverage by hand. Pictures show window rows from v = 0 on. That it is exact, with w
// of any sign and cut by planes, the oracle's properties hold; see properties/laws/.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::conservative_coverage_test {
namespace {

State state_of(Conservative conservative, Convention convention = Convention::vulkan) {
  State state = small_state(4, 4, convention);
  state.conservative = conservative;
  return state;
}

/// "#" for a covered pixel; rows joined by '|'. Checks that all samples of a pixel are alike.
std::string picture(const State& state, const SmallMesh& mesh, int samples = 1) {
  Fragments fragments;
  const TargetSize size{4, 4, samples};
  EXPECT_FALSE(draw_fragments(state, mesh.mesh(), size, fragments).error);
  std::string text = "....|....|....|....";
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    text[static_cast<std::size_t>(5 * fragments.y[i] + fragments.x[i])] = '#';
  }
  const auto covered = static_cast<std::size_t>(std::count(text.begin(), text.end(), '#'));
  EXPECT_EQ(fragments.size(), covered * static_cast<std::size_t>(samples));
  return text;
}

// u + v = 4 touches corners of pixels on the other diagonal, which are not covered.
TEST(ConservativeCoverage, TakesWhatIsTouchedOrWhatIsInside) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    const State outer = state_of(Conservative::outer, convention);
    const State inner = state_of(Conservative::inner, convention);
    const SmallMesh mesh = triangle(outer, {0, 0}, {4, 0}, {0, 4});
    for (const int samples : {1, 4}) {
      EXPECT_EQ(picture(outer, mesh, samples), "####|###.|##..|#...");
      EXPECT_EQ(picture(inner, mesh, samples), "###.|##..|#...|....");
    }
  }
}

// An acute corner at (3.5, 0.5): the edges alone would reach the last column.
TEST(ConservativeCoverage, EndsWithTheTriangle) {
  const State state = state_of(Conservative::outer);
  const SmallMesh mesh = triangle(state, {0.25F, 0.25F}, {3, 0.5F}, {0.25F, 0.5F});
  EXPECT_EQ(picture(state, mesh), "###.|....|....|....");
}

TEST(ConservativeCoverage, TakesTrianglesWithoutArea) {
  State state = state_of(Conservative::outer);
  const SmallMesh mesh = triangle(state, {0.5F, 0.5F}, {2.5F, 1.5F}, {1.5F, 1});
  EXPECT_EQ(picture(state, mesh), "##..|.##.|....|....");
  state.cull = Cull::back;
  EXPECT_EQ(picture(state, mesh), "....|....|....|....");
  state.cull = Cull::front;
  EXPECT_EQ(picture(state, mesh), "##..|.##.|....|....");
  EXPECT_EQ(picture(state_of(Conservative::inner), mesh), "....|....|....|....");
}

// The viewport ends in the middle of pixels 2, and the plane z = 0 cuts at u = 2.
TEST(ConservativeCoverage, IsCutByTheViewportAndByPlanes) {
  State state = state_of(Conservative::outer);
  const SmallMesh mesh = triangle(state, {0, 0}, {16, 0}, {0, 16});
  state.viewport.size = {2.5F, 2.5F};
  EXPECT_EQ(picture(state, mesh), "###.|###.|###.|....");
  state.conservative = Conservative::inner;
  EXPECT_EQ(picture(state, mesh), "##..|##..|....|....");

  const State whole = state_of(Conservative::outer);
  SmallMesh cut;
  cut.positions = {at(whole, 0, 0, 1, 0.5F), at(whole, 4, 0, 1, -0.5F), at(whole, 0, 4, 1, 0.5F)};
  cut.triangles = {{0, 1, 2}};
  EXPECT_EQ(picture(whole, cut), "##..|##..|##..|#...");
  EXPECT_EQ(picture(state_of(Conservative::inner), cut), "##..|##..|#...|....");
}

// z = u/4 at samples: at (3.5, 0.5), outside the triangle, 7/8.
TEST(ConservativeCoverage, ContinuesThePlanes) {
  const State state = state_of(Conservative::outer);
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1, 0), at(state, 3.25F, 0, 1, 0.8125F),
                    at(state, 0, 0.25F, 1, 0)};
  mesh.triangles = {{0, 1, 2}};
  Fragments fragments;
  ASSERT_FALSE(draw_fragments(state, mesh.mesh(), {4, 4, 1}, fragments).error);
  ASSERT_EQ(fragments.size(), 4U);
  EXPECT_EQ(fragments.depth[3], 0.875F);
}

TEST(ConservativeCoverage, IsTheSameInFrames) {
  for (const Conservative kind : {Conservative::outer, Conservative::inner}) {
    const State state = state_of(kind);
    const SmallMesh mesh = triangle(state, {0.5F, 0.25F}, {3.5F, 1.75F}, {1, 3.5F});
    std::string of_frame = "....|....|....|....";
    Picture frame;
    ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), {4, 4, 1}, 1, frame).error);
    for (std::size_t i = 0; i < 16; ++i) {
      if (frame.depth[i] != 1) of_frame[5 * (i / 4) + i % 4] = '#';
    }
    EXPECT_EQ(of_frame, picture(state, mesh));
  }
}

TEST(ConservativeCoverage, IsRefusedWithSnapping) {
  State state = state_of(Conservative::outer);
  state.snapping = Snapping{8};
  Fragments fragments;
  const SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  EXPECT_EQ(draw_fragments(state, mesh.mesh(), {4, 4, 1}, fragments).error,
            Error::snapped_conservative);
}

}  // namespace
}  // namespace rastercheck::rasterizer::conservative_coverage_test
