// Lines by hand. Pictures show window rows from v = 0 on. That lines of every kind are exact, with
// w of any sign and cut by planes, a property checks: lines-obey-the-contract.

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::lines_test {
namespace {

constexpr int kSide = 8;
constexpr TargetSize kTarget{kSide, kSide, 1};

State state_of(LineMode mode, float width = 1, Convention convention = Convention::vulkan) {
  State state = small_state(kSide, kSide, convention);
  state.primitive = Primitive::lines;
  state.line_mode = mode;
  state.line_width = width;
  return state;
}

/// Lines from each of these window positions to the next.
SmallMesh path(const State& state, const std::vector<glm::vec2>& points) {
  SmallMesh mesh;
  for (const glm::vec2& p : points) mesh.positions.push_back(at(state, p.x, p.y));
  for (std::uint32_t i = 1; i < points.size(); ++i) mesh.triangles.emplace_back(i - 1, i, i);
  return mesh;
}

Rows rows_of(const State& state, const std::vector<glm::vec2>& points) {
  return picture(state, path(state, points), kTarget);
}

/// The same rows without empty ones at the end.
Rows upper(Rows rows) {
  while (!rows.empty() && rows.back().find_first_not_of('.') == std::string::npos) rows.pop_back();
  return rows;
}

// --- Bresenham's lines ---------------------------------------------------------------------------

/// The pixels that a line draws in a window of 5 × 1 pixels, snapped to 1/256 of a pixel.
std::string thin_row(Convention convention, glm::vec2 a, glm::vec2 b) {
  State state = small_state(5, 1, convention);
  state.primitive = Primitive::lines;
  state.line_mode = LineMode::bresenham;
  state.snapping = Snapping{8};
  return picture(state, path(state, {a, b}), {5, 1, 1}).at(0);
}

// From a public report. On the grid, (0.99, 0.49) and (0.7, 0.2) lie exactly on an upper edge of
// the first pixel's diamond, which does not belong to a diamond under Direct3D. The move by
// −(ε, ε²) of the other APIs takes both into it.
TEST(BresenhamsLine, DrawsThePixelsWhoseDiamondsItLeaves) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    const std::string tie = convention == Convention::d3d ? ".###." : "####.";
    const glm::vec2 last{4.5F, 0.5F};
    EXPECT_EQ(thin_row(convention, {0.99F, 0.5F}, last), "####.");
    EXPECT_EQ(thin_row(convention, {0.99F, 0.49F}, last), tie);
    EXPECT_EQ(thin_row(convention, {0.5F, 0.2F}, last), "####.");
    EXPECT_EQ(thin_row(convention, {0.7F, 0.2F}, last), tie);
    EXPECT_EQ(thin_row(convention, {0.99F, 0.47F}, last), ".###.");
    EXPECT_EQ(thin_row(convention, {0.5F, 0.5F}, {4.99F, 0.5F}), "####.");
    EXPECT_EQ(thin_row(convention, {0.5F, 0.5F}, {4.99F, 0.35F}), "#####");
  }
}

TEST(BresenhamsLine, DrawsEveryPixelOfALoopOnce) {
  const State state = state_of(LineMode::bresenham);
  const std::vector<glm::vec2> loop{
      {1.5F, 1.5F}, {5.5F, 1.5F}, {5.5F, 5.5F}, {1.5F, 5.5F}, {1.5F, 1.5F}};
  EXPECT_EQ(upper(rows_of(state, loop)),
            (Rows{"........", ".#####..", ".#...#..", ".#...#..", ".#...#..", ".#####.."}));
}

TEST(BresenhamsLine, IsReplicatedAlongItsMinorAxis) {
  const auto flat = [](float width) {
    return upper(rows_of(state_of(LineMode::bresenham, width), {{0.5F, 2.5F}, {3.5F, 2.5F}}));
  };
  const Rows thin{"........", "........", "###....."};
  const Rows two{"........", "###.....", "###....."};
  const Rows three{"........", "###.....", "###.....", "###....."};
  EXPECT_EQ(flat(0.25F), thin);
  EXPECT_EQ(flat(1.4375F), thin);
  EXPECT_EQ(flat(1.5F), two);
  EXPECT_EQ(flat(2.4375F), two);
  EXPECT_EQ(flat(3), three);
}

// --- Rectangles and parallelograms ---------------------------------------------------------------

TEST(RectangularLine, CoversHalfItsWidthToEitherSide) {
  EXPECT_EQ(upper(rows_of(state_of(LineMode::rectangular, 3), {{1, 2.5F}, {5, 2.5F}})),
            (Rows{"........", ".####...", ".####...", ".####..."}));
}

// The neighbours of the diagonal are 0.7071 pixels from it. The sample at (3.5, 4.5) is on the
// lower right end, which does not own it.
TEST(RectangularLine, EndsAtRightAngles) {
  const std::vector<glm::vec2> diagonal{{0, 0}, {4, 4}};
  EXPECT_EQ(upper(rows_of(state_of(LineMode::rectangular, 1.40625F), diagonal)),
            (Rows{"#.......", ".#......", "..#.....", "...#...."}));
  EXPECT_EQ(upper(rows_of(state_of(LineMode::rectangular, 1.421875F), diagonal)),
            (Rows{"##......", "###.....", ".###....", "..##...."}));
}

// Ends own samples by the fill rule, whichever way a line goes: of the corners, which lie on two
// ends each, one is drawn twice and one not at all.
TEST(RectangularLine, OwnsSamplesOnItsEndsByTheFillRule) {
  const State state = state_of(LineMode::rectangular);
  const std::vector<glm::vec2> loop{
      {1.5F, 1.5F}, {5.5F, 1.5F}, {5.5F, 5.5F}, {1.5F, 5.5F}, {1.5F, 1.5F}};
  EXPECT_EQ(upper(rows_of(state, loop)),
            (Rows{"........", ".2####..", ".#...#..", ".#...#..", ".#...#..", ".####..."}));
}

// The samples of a pixel are at v = 1/8, 3/8, 5/8 and 7/8.
TEST(RectangularLine, CoversSamplesOneByOne) {
  const State state = state_of(LineMode::rectangular, 0.5F);
  EXPECT_EQ(picture(state, path(state, {{0, 0.5F}, {2, 0.5F}}), {3, 1, 4}), (Rows{".##..##....."}));
}

// v = u/2 along the middle: 0.25, 0.75, 1.25 and 1.75 in the four columns.
TEST(ParallelogramLine, CoversHalfItsWidthAlongTheMinorAxis) {
  EXPECT_EQ(upper(rows_of(state_of(LineMode::parallelogram), {{0, 0}, {4, 2}})),
            (Rows{"##......", "..##...."}));
  EXPECT_EQ(upper(rows_of(state_of(LineMode::parallelogram, 2), {{0, 0}, {4, 2}})),
            (Rows{"###.....", ".###....", "...#...."}));
}

TEST(Lines, WithoutLengthAreCounted) {
  for (const LineMode mode :
       {LineMode::rectangular, LineMode::parallelogram, LineMode::bresenham}) {
    const State state = state_of(mode, 4);
    Fragments fragments;
    const SmallMesh mesh = path(state, {{2.5F, 2.5F}, {2.5F, 2.5F}});
    const DrawResult drawn = draw_fragments(state, mesh.mesh(), kTarget, fragments);
    EXPECT_EQ(drawn.counts.discarded_degenerate, 1U);
    EXPECT_EQ(fragments.size(), 0U);
  }
}

// --- Values --------------------------------------------------------------------------------------

// In the middle of the window line, with w = 1 and 3, the second end's share of a smooth value is
// (1/3)/(1 + 1/3).
TEST(Lines, HaveValuesByTheShareOfTheSecondEnd) {
  State state = state_of(LineMode::rectangular, 3);
  state.attributes = {{Interpolation::smooth}, {Interpolation::noperspective}};
  SmallMesh mesh;
  mesh.positions = {at(state, 1, 2.5F, 1, 0.25F), at(state, 6, 2.5F, 3, 0.75F)};
  mesh.attributes = {0, 0, 1, 1};
  mesh.triangles = {{0, 1, 1}};
  const Fragments fragments = fragments_of(state, mesh, kTarget);
  int in_the_middle = 0;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (fragments.x[i] != 3) continue;
    ++in_the_middle;
    EXPECT_EQ(fragments.depth[i], 0.5F);
    EXPECT_EQ(fragments.attributes[2 * i], 0.25F);
    EXPECT_EQ(fragments.attributes[2 * i + 1], 0.5F);
  }
  EXPECT_EQ(in_the_middle, 3);
}

// The clip plane is at u = 4; the first end, which provokes under Vulkan and Direct3D, is beyond.
TEST(Lines, KeepTheirFlatValueAcrossAClipPlane) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    for (const LineMode mode : {LineMode::rectangular, LineMode::parallelogram}) {
      State state = state_of(mode, 1, convention);
      state.attributes = {{Interpolation::flat}};
      state.clip_distance_count = 1;
      SmallMesh mesh = path(state, {{1, 2.5F}, {7, 2.5F}});
      mesh.attributes = {5, 9};
      mesh.clip_distances = {-1, 1};
      const Fragments fragments = fragments_of(state, mesh, kTarget);
      EXPECT_EQ(upper(picture(fragments, kTarget)), (Rows{"........", "........", "....###."}));
      const float expected = convention == Convention::opengl ? 9 : 5;
      EXPECT_EQ(fragments.attributes, (std::vector<float>(3, expected)));
    }
  }
}

// From (1, 2.5) to infinity on the right, where the viewport's side cuts the line.
TEST(Lines, ReachTheHorizonIfAnEndIsBehindTheEye) {
  const State state = state_of(LineMode::rectangular);
  SmallMesh mesh;
  mesh.positions = {at(state, 1, 2.5F, 1, 0.5F), at(state, -5, 2.5F, -1, 0.5F)};
  mesh.triangles = {{0, 1, 1}};
  EXPECT_EQ(upper(picture(state, mesh, kTarget)), (Rows{"........", "........", ".#######"}));
}

TEST(Lines, AreTheSameInFrames) {
  for (const LineMode mode :
       {LineMode::rectangular, LineMode::parallelogram, LineMode::bresenham}) {
    const State state = state_of(mode, 2);
    const SmallMesh mesh = path(state, {{0.5F, 1.25F}, {6.75F, 3.5F}, {2, 7}});
    Picture frame;
    ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), kTarget, 1, frame).error);
    const Fragments fragments = fragments_of(state, mesh, kTarget);
    Rows expected = picture(fragments, kTarget);
    Rows drawn(kSide, std::string(kSide, '.'));
    for (std::size_t i = 0; i < frame.depth.size(); ++i) {
      if (frame.depth[i] != 1) drawn[i / kSide][i % kSide] = '#';
    }
    for (std::string& row : expected) {
      for (char& c : row) c = c == '.' ? '.' : '#';
    }
    EXPECT_EQ(drawn, expected);
  }
}

// --- Errors --------------------------------------------------------------------------------------

std::optional<Error> error_of(const State& state) {
  Fragments fragments;
  return draw_fragments(state, path(state, {{1, 1}, {3, 3}}).mesh(), kTarget, fragments).error;
}

TEST(Lines, WithoutAWidthAreRefused) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float width : {0.0F, -1.0F, kInfinity, kNan}) {
    EXPECT_EQ(error_of(state_of(LineMode::rectangular, width)), Error::primitive_size) << width;
  }
  EXPECT_EQ(error_of(state_of(LineMode::rectangular, 0x1p-149F)), std::nullopt);
}

TEST(Lines, AreRefusedWithWhatOnlyTrianglesHave) {
  State conservative = state_of(LineMode::rectangular);
  conservative.conservative = Conservative::outer;
  EXPECT_EQ(error_of(conservative), Error::primitive_state);
  State biased = state_of(LineMode::rectangular);
  biased.depth_bias.slope = 1;
  EXPECT_EQ(error_of(biased), Error::primitive_state);
}

}  // namespace
}  // namespace rastercheck::rasterizer::lines_test
