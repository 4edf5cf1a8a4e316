#include "rasterizer/internal/fragment_drawing.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::fragment_drawing_test {
namespace {

constexpr TargetSize kFour{4, 4, 1};
constexpr std::array kConventions{Convention::opengl, Convention::vulkan, Convention::d3d};
const Rows kNothing{"....", "....", "....", "...."};
const Rows kAll{"####", "####", "####", "####"};

/// A triangle that covers the whole viewport, whatever the viewport is.
SmallMesh everywhere() {
  SmallMesh mesh;
  mesh.positions = {{-1, -1, 0, 1}, {4, -1, 0, 1}, {-1, 4, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// The picture of `everywhere` in a viewport.
Rows viewport_picture(glm::vec2 origin, glm::vec2 size, const TargetSize& target = kFour) {
  State state;
  state.viewport = {origin, size, 0, 1};
  return picture(state, everywhere(), target);
}

// Edges through sample centres: left edges own the samples, top or bottom edges do so by the rule,
// and where two edges meet, both have to own the sample.
TEST(ExactDraw, TiesAreTheFillRules) {
  const Rows with_level{"###.", "##..", "#...", "...."};
  const Rows without{"....", "##..", "#...", "...."};
  for (const Convention convention : kConventions) {
    State state = small_state(4, 4, convention);
    const SmallMesh mesh = triangle(state, {0.5F, 0.5F}, {3.5F, 0.5F}, {0.5F, 3.5F});
    // The level edge is the top edge if v points down, and the bottom edge otherwise.
    const bool is_top = convention != Convention::opengl;
    state.fill_rule = FillRule::top_left;
    EXPECT_EQ(picture(state, mesh, kFour), is_top ? with_level : without);
    state.fill_rule = FillRule::bottom_left;
    EXPECT_EQ(picture(state, mesh, kFour), is_top ? without : with_level);
  }
}

// Ties as above, in a viewport whose numbers are rounded, so that only exact sums detect the ties.
TEST(ExactDraw, TiesAreSeenWhereDoublesRound) {
  State state;
  state.viewport = {{3.5F, -5}, {0x1p-100F, 20}, 0, 1};
  SmallMesh mesh;
  mesh.positions = {{-1, -1, 0, 1}, {-1, 1, 0, 1}, {3, 0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  // u = 3.5 is NDC −1: the samples lie on the left edge, which owns them.
  EXPECT_EQ(picture(state, mesh, kFour), (Rows{"...#", "...#", "...#", "...#"}));
  mesh.positions[2].x = -5;  // now on the right edge
  EXPECT_EQ(picture(state, mesh, kFour), kNothing);
  mesh.positions[0].x = mesh.positions[1].x = std::nextafter(-1.0F, 0.0F);
  EXPECT_EQ(picture(state, mesh, kFour), (Rows{"...#", "...#", "...#", "...#"}));
}

TEST(ExactDraw, SharedDiagonalsOwnEachSampleOnce) {
  for (const Convention convention : kConventions) {
    for (const FillRule rule : {FillRule::top_left, FillRule::bottom_left}) {
      for (const bool across : {false, true}) {
        for (const glm::vec4& viewport : {glm::vec4{0, 0, 4, 4}, glm::vec4{4, 0, -4, 4},
                                          glm::vec4{0, 4, 4, -4}, glm::vec4{4, 4, -4, -4}}) {
          State state = small_state(4, 4, convention);
          const SmallMesh mesh = rectangle(state, {-1, -1}, {5, 5}, across);
          state.fill_rule = rule;
          state.viewport = {{viewport.x, viewport.y}, {viewport.z, viewport.w}, 0, 1};
          EXPECT_EQ(picture(state, mesh, kFour), kAll);
          EXPECT_EQ(picture(state, mesh, {4, 4, 16}), Rows(4, std::string(64, '#')));
        }
      }
    }
  }
}

// Corners with w <= 0. Two corners at infinity make a quadrant; two corners behind the eye make the
// mirrored one.
TEST(ExactDraw, CornersBehindTheEyeAreOrdinary) {
  const State state = small_state(4, 4);
  SmallMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  mesh.positions = {{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 1, 0, 0}};
  const Rows quadrant{"....", "....", "..##", "..##"};
  EXPECT_EQ(picture(state, mesh, kFour), quadrant);
  State clamped = state;
  clamped.depth_clamp = true;  // otherwise the near plane would clip depth 0 behind the eye
  mesh.positions = {{0, 0, 0, 1}, {-1, 0, 0, -1}, {0, -1, 0, -1}};
  EXPECT_EQ(picture(clamped, mesh, kFour), (Rows{"##..", "##..", "....", "...."}));
  mesh.positions = {{0, 0, 0, -1}, {-1, 0, 0, -1}, {0, -1, 0, -1}};
  EXPECT_EQ(picture(clamped, mesh, kFour), kNothing);
  mesh.positions = {{0, 0, 0, 0}, {-1, 0, 0, 0}, {0, -1, 0, 0}};
  EXPECT_EQ(picture(clamped, mesh, kFour), kNothing);
}

TEST(ExactDraw, TheViewportHoldsItsLowBorderAndNotItsHighOne) {
  const Rows two_by_two{"##..", "##..", "....", "...."};
  EXPECT_EQ(viewport_picture({0, 0}, {2.5F, 2.5F}), two_by_two);
  EXPECT_EQ(viewport_picture({2.5F, 2.5F}, {-2.5F, -2.5F}), two_by_two);
  const Rows from_center{"....", "....", "..##", "..##"};
  EXPECT_EQ(viewport_picture({2.5F, 2.5F}, {9, 9}), from_center);
  EXPECT_EQ(viewport_picture({11.5F, 11.5F}, {-9, -9}), from_center);
}

// 0.1F + 0.4F is slightly above 1/2, and is not a float.
TEST(ExactDraw, TheHighBorderIsNotRounded) {
  const float width = 0.4F;
  EXPECT_EQ(viewport_picture({0.1F, 0}, {width, 4})[0], "#...");
  EXPECT_EQ(viewport_picture({0.1F, 0}, {std::nextafter(width, 0.0F), 4})[0], "....");
  // The smallest difference: the border is 1/2 + 2^-149, which a double rounds to 1/2.
  EXPECT_EQ(viewport_picture({0x1p-149F, 0}, {0.5F, 4})[0], "#...");
  EXPECT_EQ(viewport_picture({-0x1p-149F, 0}, {0.5F, 4})[0], "....");
}

// Samples 12 and 15 of the sixteen lie on the pixel's own borders u = i and v = j.
TEST(ExactDraw, TheSmallestNumbersCountOnAPixelsBorder) {
  const TargetSize one{1, 1, 16};
  EXPECT_EQ(viewport_picture({0, 0}, {4, 4}, one)[0], "################");
  EXPECT_EQ(viewport_picture({0x1p-149F, 0}, {4, 4}, one)[0], "############.###");
  EXPECT_EQ(viewport_picture({0, 0x1p-149F}, {4, 4}, one)[0], "###############.");
  EXPECT_EQ(viewport_picture({-0x1p-149F, -0x1p-149F}, {4, 4}, one)[0], "################");
}

TEST(ExactDraw, AViewportMayBeNarrowerThanAnyPixel) {
  const Rows third_column{"..#.", "..#.", "..#.", "..#."};
  for (const float width : {1e-30F, 0x1p-149F}) {
    EXPECT_EQ(viewport_picture({2.5F, 0}, {width, 4}), third_column);
    EXPECT_EQ(viewport_picture({2.5F, 0}, {-width, 4}), kNothing);
    EXPECT_EQ(viewport_picture({2.25F, 0}, {width, 4}), kNothing);
    EXPECT_EQ(viewport_picture({2.5F, 1.5F}, {width, width}),
              (Rows{"....", "..#.", "....", "...."}));
  }
}

TEST(ExactDraw, AViewportMayBeAsLargeAsNumbersGo) {
  constexpr float kMost = std::numeric_limits<float>::max();
  EXPECT_EQ(viewport_picture({-1, -1}, {kMost, kMost}), kAll);
  EXPECT_EQ(viewport_picture({-kMost, -3e38F}, {kMost, kMost}), kNothing);
  EXPECT_EQ(viewport_picture({kMost, kMost}, {-kMost, -kMost}), kAll);
  // The middle, NDC 0, is u = 0: the whole target lies slightly to its right.
  State state;
  state.viewport = {{-1.5e38F, -1.5e38F}, {3e38F, 3e38F}, 0, 1};
  SmallMesh mesh;
  mesh.positions = {{0, -1, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(picture(state, mesh, kFour), kAll);
  mesh.positions[2].x = -1;
  EXPECT_EQ(picture(state, mesh, kFour), kNothing);
}

// An edge at NDC −1/q lies exactly on u = 0, in viewports so wide that rounding −1/q would move the
// edge by 2^40 pixels. Kills: boxes and spans of rows computed with rounded viewport numbers.
TEST(ExactDraw, EdgesAreWhereTheyAreInTheWidestViewports) {
  for (int q = 3; q < 200; q += 2) {
    const auto w = static_cast<float>(q);
    State state;
    state.viewport = {{(1 - w) * 0x1p96F, -4}, {2 * w * 0x1p96F, 12}, 0, 1};
    SmallMesh mesh;
    mesh.positions = {{-1, -w, 0, w}, {-1, w, 0, w}, {4 * w, 0, 0, w}};
    mesh.triangles = {{0, 1, 2}};
    EXPECT_EQ(picture(state, mesh, kFour), kAll) << q;
    mesh.positions[2].x = -4 * w;
    EXPECT_EQ(picture(state, mesh, kFour), kNothing) << q;
  }
}

TEST(ExactDraw, AnEmptyViewportLeavesNothingButDegenerates) {
  for (const glm::vec2& size : {glm::vec2{0, 4}, glm::vec2{4, 0}, glm::vec2{0, -0.0F}}) {
    State state = small_state(4, 4);
    state.viewport.size = size;
    SmallMesh mesh = everywhere();
    mesh.positions.push_back({NAN, 0, 0, 1});
    mesh.triangles = {{0, 1, 2}, {0, 1, 1}, {0, 1, 3}};
    Fragments fragments;
    const DrawCounts counts = draw_mesh(state, mesh.mesh(), kFour, fragments);
    EXPECT_EQ(fragments.size(), 0U);
    EXPECT_EQ(counts, (DrawCounts{.discarded_not_finite = 1, .discarded_degenerate = 2}));
  }
}

TEST(ExactDraw, WhatCannotBeDrawnIsCountedAndTheRestDrawn) {
  State state = small_state(4, 4);
  state.clip_distance_count = 1;
  SmallMesh mesh = everywhere();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int i = 0; i < 4; ++i) {
    for (const float bad : {kInfinity, -kInfinity, NAN}) {
      mesh.positions.push_back(mesh.positions[2]);
      mesh.positions.back()[i] = bad;
      const auto vertex = static_cast<std::uint32_t>(mesh.positions.size() - 1);
      mesh.triangles.push_back({0, vertex, 1});
    }
  }
  mesh.clip_distances.assign(mesh.positions.size(), 1);
  mesh.positions.push_back(mesh.positions[2]);
  mesh.clip_distances.push_back(NAN);
  mesh.triangles.push_back({0, 1, 15});
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({2, 1, 2});
  Fragments fragments;
  const DrawCounts counts = draw_mesh(state, mesh.mesh(), kFour, fragments);
  EXPECT_EQ(picture(fragments, kFour), kAll);
  EXPECT_EQ(counts, (DrawCounts{.discarded_not_finite = 13, .discarded_degenerate = 2}));
}

// Every pair of columns around the borders of blocks of 64. Kills: a mask shifted by its own width;
// the last pixel of a block lost; a block's values used for the next block.
TEST(ExactDraw, BlocksMeet) {
  const TargetSize size{200, 2, 1};
  State state = small_state(256, 2);
  state.attributes.resize(1);
  for (const int low : {0, 1, 62, 63, 64, 65, 127, 128}) {
    for (const int high : {63, 64, 65, 66, 127, 128, 129, 192, 193, 200}) {
      if (low >= high) continue;
      const glm::vec2 from{low, 0};
      const glm::vec2 to{high, 2};
      SmallMesh mesh = rectangle(state, from, to);
      mesh.attributes = {from.x, to.x, to.x, from.x};
      const Fragments fragments = fragments_of(state, mesh, size);
      std::string row(200, '.');
      for (int x = low; x < high; ++x) row[static_cast<std::size_t>(x)] = '#';
      EXPECT_EQ(picture(fragments, size), Rows(2, row)) << low << ", " << high;
      expect_values(fragments, [](double u, double) { return u; });
    }
  }
}

TEST(ExactDraw, TheLargestTargetIsFilledToItsBorders) {
  for (const TargetSize& size : {TargetSize{kMaxSize, 1, 1}, TargetSize{1, kMaxSize, 1}}) {
    const State state = small_state(kMaxSize, kMaxSize);
    const auto width = static_cast<float>(size.width);
    const auto height = static_cast<float>(size.height);
    const Fragments all = fragments_of(state, rectangle(state, {0, 0}, {width, height}), size);
    EXPECT_EQ(all.size(), static_cast<std::size_t>(kMaxSize));
    const Fragments last =
        fragments_of(state, rectangle(state, {width - 1, height - 1}, {width, height}), size);
    ASSERT_EQ(last.size(), 1U);
    EXPECT_EQ(last.x[0], size.width - 1);
    EXPECT_EQ(last.y[0], size.height - 1);
  }
}

// Thin triangles across the whole largest target, with shared edges: pixels that the span of a row
// leaves out would be missing. Kills: a span that is cut short where the slope is small.
TEST(ExactDraw, LongSliversLeaveNoHole) {
  State state = small_state(kMaxSize, 4);
  state.viewport.size.y = 4;
  const TargetSize size{kMaxSize, 4, 1};
  SmallMesh mesh;
  mesh.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}, {0.3F, 0.1F, 0, 1}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  EXPECT_EQ(picture(state, mesh, size), Rows(4, std::string(kMaxSize, '#')));
}

TEST(ExactDraw, TheScissorCutsPixels) {
  State state = small_state(4, 4);
  state.scissor = {{1, -5}, {2, 7}};
  EXPECT_EQ(picture(state, everywhere(), kFour), (Rows{".##.", ".##.", "....", "...."}));
  for (const Rectangle& none :
       {Rectangle{{4, 0}, {9, 9}}, Rectangle{{0, 0}, {0, 4}}, Rectangle{{-9, 0}, {9, 4}}}) {
    state.scissor = none;
    EXPECT_EQ(picture(state, everywhere(), kFour), kNothing);
  }
}

// Fragments are ordered by triangle, y, x, sample, however blocks and samples are visited.
TEST(ExactDraw, FragmentsComeInOrder) {
  const TargetSize size{130, 3, 4};
  const State state = small_state(130, 3);
  SmallMesh mesh = everywhere();
  mesh.triangles.push_back({2, 1, 0});
  const Fragments fragments = fragments_of(state, mesh, size);
  ASSERT_EQ(fragments.size(), 2U * 130 * 3 * 4);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    EXPECT_EQ(fragments.triangle[i], i / (130 * 3 * 4));
    EXPECT_EQ(fragments.y[i], i / (130 * 4) % 3);
    EXPECT_EQ(fragments.x[i], i / 4 % 130);
    EXPECT_EQ(fragments.sample[i], i % 4);
  }
}

// The weights with the most components known, with attributes that no sum can hold. Kills: an exact
// sum that overflows its array.
TEST(ExactDraw, AttributesThatAreNotFiniteDoNoHarm) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  State state;
  state.viewport = {{-0x1.d7487ep-86F, -0x1.ad251ep-24F}, {0x1.8dd2c2p+96F, 0x1.0a0cecp+52F}, 0, 1};
  state.depth_clamp = true;
  state.attributes = {{Interpolation::noperspective, Location::sample},
                      {Interpolation::smooth, Location::centroid}};
  SmallMesh mesh;
  mesh.positions = {{-0x1.23594p-131F, 0x1.433e24p+92F, 0.5F, 0x1.caa44ep+106F},
                    {-0x1.de4aacp+95F, -0x1.b1c264p+109F, 0.5F, -0x1.91588p-130F},
                    {0x1.2947e8p+21F, 0x1.415adep+69F, 0.5F, 0x1.160fbep-117F}};
  mesh.triangles = {{0, 1, 2}};
  for (const float bad : {kInfinity, -kInfinity, NAN}) {
    mesh.attributes = {bad, bad, 1, bad, 1, -bad};
    Fragments fragments;
    draw_mesh(state, mesh.mesh(), {16, 16, 16}, fragments);
    ASSERT_EQ(fragments.size(), 4'096U);
    for (const float value : fragments.attributes) ASSERT_FALSE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::fragment_drawing_test
