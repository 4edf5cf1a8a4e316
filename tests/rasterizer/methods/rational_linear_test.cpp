#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/either_way.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::rational_linear_test {
namespace {

constexpr TargetSize kFour{4, 4, 1};
constexpr TargetSize kEight{8, 8, 1};
constexpr Convention kConventions[] = {Convention::opengl, Convention::vulkan, Convention::d3d};

// --- Coverage -----------------------------------------------------------------------------------

using RationalLinearCoverage = EitherWay;

INSTANTIATE_TEST_SUITE_P(Drawn, RationalLinearCoverage, EitherWay::ways(), EitherWay::way_name);

TEST_P(RationalLinearCoverage, ARightEdgeExcludesTheSamplesOnIt) {
  const State state = small_state(4, 4);
  EXPECT_EQ(picture(state, triangle(state, {0, 0}, {4, 0}, {0, 4}), kFour),
            (Rows{"###.", "##..", "#...", "...."}));
}

TEST_P(RationalLinearCoverage, ALeftEdgeIncludesTheSamplesOnIt) {
  const State state = small_state(4, 4);
  EXPECT_EQ(picture(state, triangle(state, {4, 0}, {4, 4}, {0, 4}), kFour),
            (Rows{"...#", "..##", ".###", "####"}));
}

TEST_P(RationalLinearCoverage, IsTheSameForEveryOrderOfTheVertices) {
  const State state = small_state(4, 4);
  SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  for (const glm::uvec3& order :
       {glm::uvec3{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
    mesh.triangles = {order};
    EXPECT_EQ(picture(state, mesh, kFour), (Rows{"###.", "##..", "#...", "...."}));
  }
}

// Kills: a fill rule that is ignored, or that ignores where v points.
TEST_P(RationalLinearCoverage, TheFillRuleIsMeantAsDisplayed) {
  const Rows least{"##..", "##..", "....", "...."};
  const Rows greatest{"....", "##..", "##..", "...."};
  for (const Convention convention : kConventions) {
    State state = small_state(4, 4, convention);
    const SmallMesh mesh = rectangle(state, {0.5F, 0.5F}, {2.5F, 2.5F});
    const bool down = convention != Convention::opengl;
    state.fill_rule = FillRule::top_left;
    EXPECT_EQ(picture(state, mesh, kFour), down ? least : greatest);
    state.fill_rule = FillRule::bottom_left;
    EXPECT_EQ(picture(state, mesh, kFour), down ? greatest : least);
  }
}

TEST_P(RationalLinearCoverage, ASampleOnAVertexFollowsBothItsEdges) {
  const State state = small_state(4, 4);
  // A left and a top edge meet at (1/2, 1/2). At the other vertices, a left and a bottom edge meet,
  // or a top and a right edge.
  EXPECT_EQ(picture(state, triangle(state, {0.5F, 0.5F}, {2.5F, 0.5F}, {0.5F, 2.5F}), kFour),
            (Rows{"##..", "#...", "....", "...."}));
}

// Kills: a shared edge crossed at two different places; a shared edge that both triangles own, or
// neither.
TEST_P(RationalLinearCoverage, ASquareSplitByEitherDiagonalCoversEachSampleOnce) {
  for (const Convention convention : kConventions) {
    for (const int samples : {1, 2, 4, 8, 16}) {
      for (const FillRule rule : {FillRule::top_left, FillRule::bottom_left}) {
        State state = small_state(8, 8, convention);
        state.fill_rule = rule;
        const TargetSize size{8, 8, samples};
        for (const bool across : {false, true}) {
          // The square is larger than the target, because some samples lie on the target's own
          // border.
          const SmallMesh mesh = rectangle(state, {-4, -4}, {12, 12}, across);
          EXPECT_EQ(times_drawn(fragments_of(state, mesh, size), size),
                    std::vector<int>(static_cast<std::size_t>(64 * samples), 1));
        }
      }
    }
  }
}

// Kills: crossings, or clipping, that depend on which of the two triangles at an edge is drawn.
TEST_P(RationalLinearCoverage, AFanAroundAPointCoversEachSampleOnce) {
  std::mt19937 random(20260801);
  const auto between = [&random](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24F;
  };
  for (int round = 0; round < 300; ++round) {
    State state = small_state(16, 16, kConventions[round % 3]);
    state.depth_clamp = round % 2 == 0;
    const TargetSize size{16, 16, round % 5 == 0 ? 4 : 1};
    SmallMesh mesh;
    mesh.positions = {at(state, between(2, 14), between(2, 14), between(0.5F, 4))};
    const unsigned spokes = 3 + static_cast<unsigned>(random() % 10);
    // Some spokes are far, and reach beyond the guard band of 1024 half widths.
    const float radius = round % 4 == 0 ? 1e6F : 40;
    for (unsigned i = 0; i < spokes; ++i) {
      const double angle = 6.283185307179586 * i / spokes;
      mesh.positions.push_back(at(state, 8 + radius * static_cast<float>(std::cos(angle)),
                                  8 + radius * static_cast<float>(std::sin(angle)),
                                  between(0.5F, 4)));
      mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % spokes});
    }
    EXPECT_EQ(times_drawn(fragments_of(state, mesh, size), size),
              std::vector<int>(static_cast<std::size_t>(256 * size.samples), 1))
        << round;
  }
}

TEST_P(RationalLinearCoverage, TheStandardPatternsAreCoveredSampleBySample) {
  const State state = small_state(1, 1);
  // The rectangle covers the samples with x < 8/16.
  const SmallMesh mesh = rectangle(state, {0, 0}, {0.5F, 1});
  EXPECT_EQ(picture(state, mesh, {1, 1, 1}), (Rows{"."}));
  EXPECT_EQ(picture(state, mesh, {1, 1, 2}), (Rows{".#"}));
  EXPECT_EQ(picture(state, mesh, {1, 1, 4}), (Rows{"#.#."}));
  EXPECT_EQ(picture(state, mesh, {1, 1, 8}), (Rows{".#.###.."}));
  EXPECT_EQ(picture(state, mesh, {1, 1, 16}), (Rows{".##.#...#.###..#"}));
}

// --- Clipping -----------------------------------------------------------------------------------

using RationalLinearClipping = EitherWay;

INSTANTIATE_TEST_SUITE_P(Drawn, RationalLinearClipping, EitherWay::ways(), EitherWay::way_name);

/// Vertices at window (2, 0) and (6, 0) before the eye; the third is behind it, at (4, −8): the
/// visible part lies below v = 0 between the lines from (4, −8) through the other two vertices.
SmallMesh behind_the_eye(const State& state) {
  SmallMesh mesh;
  mesh.positions = {at(state, 2, 0), at(state, 6, 0), at(state, 4, -8, -1)};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

// Kills: dividing before clipping.
TEST_P(RationalLinearClipping, AVertexBehindTheEyeOpensTheTriangleToInfinity) {
  const Rows expected{"..####..", "..####..", ".######.", ".######.",
                      ".######.", ".######.", "########", "########"};
  for (const bool depth_clamp : {false, true}) {
    for (const Convention convention : kConventions) {
      State state = small_state(8, 8, convention);
      state.depth_clamp = depth_clamp;
      EXPECT_EQ(picture(state, behind_the_eye(state), kEight), expected);
    }
  }
}

TEST_P(RationalLinearClipping, ValuesGoOnBehindTheEye) {
  State state = small_state(8, 8);
  state.attributes = {{}};
  SmallMesh mesh = behind_the_eye(state);
  mesh.attributes = {0, 0, 1};
  // For weights a, b, c of the vertices, v = 8c / (a + b − c) = 8c / (1 − 2c).
  const auto exact = [](double, double v) { return v / (8 + 2 * v); };
  expect_values(fragments_of(state, mesh, kEight), exact);
  state.depth_clamp = true;
  expect_values(fragments_of(state, mesh, kEight), exact);
}

TEST_P(RationalLinearClipping, WhatIsWhollyBehindTheEyeIsNotDrawn) {
  for (const bool depth_clamp : {false, true}) {
    State state = small_state(8, 8);
    state.depth_clamp = depth_clamp;
    SmallMesh mesh = behind_the_eye(state);
    mesh.positions[0] *= -1.0F;
    mesh.positions[1] *= -1.0F;
    EXPECT_EQ(fragments_of(state, mesh, kEight).size(), 0U);
  }
}

/// A picture of 4 x 4 samples with the columns drawn that `which` marks, or the rows if `along_v`.
Rows stripes(bool along_v, const std::string& which) {
  Rows rows;
  for (std::size_t i = 0; i < 4; ++i) rows.push_back(along_v ? std::string(4, which[i]) : which);
  return rows;
}

// Kills: clip edges that follow the fill rule; near confused with far; OpenGL's depth range used
// for the other conventions.
TEST_P(RationalLinearClipping, SamplesOnANearOrFarCutAreInside) {
  for (const Convention convention : kConventions) {
    const State state = small_state(4, 4, convention);
    const float nearest = convention == Convention::opengl ? -1 : 0;
    for (const bool along_v : {false, true}) {
      for (const float slope : {0.125F, -0.125F}) {
        const Rows low = stripes(along_v, "##..");
        const Rows high = stripes(along_v, ".###");
        EXPECT_EQ(picture(state, sloping(state, along_v, slope, nearest), kFour),
                  slope > 0 ? high : low);
        EXPECT_EQ(picture(state, sloping(state, along_v, slope, 1), kFour), slope > 0 ? low : high);
      }
    }
  }
}

// Kills: an edge that no longer counts as cut after it is cut a second time.
TEST_P(RationalLinearClipping, SamplesOnADepthCutAreInsideHoweverItIsCutItself) {
  State state = small_state(4, 4);
  state.clip_distance_count = 1;
  SmallMesh mesh = sloping(state, false, -0.125F, 0);  // inside up to u = 1.5
  mesh.clip_distances = {1, 1, -1, -1};                // inside up to v = 2
  EXPECT_EQ(picture(state, mesh, kFour), (Rows{"##..", "##..", "....", "...."}));
  mesh.clip_distances = {-1, -1, 1, 1};
  EXPECT_EQ(picture(state, mesh, kFour), (Rows{"....", "....", "##..", "##.."}));
}

TEST_P(RationalLinearClipping, DepthClampKeepsWhatIsNearerOrFartherAndClampsItsDepth) {
  State state = small_state(4, 4);
  state.depth_clamp = true;
  state.viewport.min_depth = 0.25F;
  state.viewport.max_depth = 0.75F;
  const Fragments fragments = fragments_of(state, sloping(state, false, 1, 0.5F), kFour);
  ASSERT_EQ(fragments.size(), 16U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const float expected = fragments.x[i] == 0 ? 0.25F : fragments.x[i] == 1 ? 0.5F : 0.75F;
    EXPECT_EQ(fragments.depth[i], expected);
  }
}

// Kills: clip distances that keep samples at 0 in every convention, or in none.
TEST_P(RationalLinearClipping, ADistanceAndItsNegativeShareNoSampleButInD3d) {
  for (const Convention convention : kConventions) {
    for (const bool along_v : {false, true}) {
      State state = small_state(4, 4, convention);
      state.clip_distance_count = 1;
      SmallMesh mesh = sloping(state, along_v, 1, 0);
      for (glm::vec4& p : mesh.positions) {
        mesh.clip_distances.push_back(p.z);
        p.z = 0;
      }
      const Rows positive = picture(state, mesh, kFour);
      for (float& distance : mesh.clip_distances) distance = -distance;
      const Rows negative = picture(state, mesh, kFour);
      EXPECT_EQ(positive, stripes(along_v, ".###"));
      EXPECT_EQ(negative, stripes(along_v, convention == Convention::d3d ? "##.." : "#..."));
    }
  }
}

TEST_P(RationalLinearClipping, DistancesThatVanishEverywhereClipNothing) {
  State state = small_state(4, 4);
  state.clip_distance_count = kMaxClipDistances;
  SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
  mesh.clip_distances.assign(4 * kMaxClipDistances, 0);
  EXPECT_EQ(picture(state, mesh, kFour), Rows(4, "####"));
}

TEST_P(RationalLinearClipping, EveryDistanceClips) {
  for (std::size_t i = 0; i < kMaxClipDistances; ++i) {
    State state = small_state(4, 4);
    state.clip_distance_count = kMaxClipDistances;
    SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
    mesh.clip_distances.assign(4 * kMaxClipDistances, 1);
    // The distance falls from 1 on the left to −1 on the right.
    mesh.clip_distances[1 * kMaxClipDistances + i] = -1;
    mesh.clip_distances[2 * kMaxClipDistances + i] = -1;
    EXPECT_EQ(picture(state, mesh, kFour), Rows(4, "##..")) << i;
  }
}

// Kills: a guard band that moves edges or values.
TEST_P(RationalLinearClipping, ValuesStayWhereTheGuardBandCuts) {
  for (const float far : {512.0F, 4096.0F, 0x1p20F}) {
    State state = small_state(8, 8);
    state.attributes = {{}};
    SmallMesh mesh = triangle(state, {0, 0}, {far, 0}, {0, far});
    mesh.attributes = {1, 1 + far, 1};
    expect_values(fragments_of(state, mesh, kEight), [](double u, double) { return 1 + u; });
    EXPECT_EQ(picture(state, mesh, kEight), Rows(8, "########"));
  }
}

// --- Conventions --------------------------------------------------------------------------------

class RationalLinearConventions : public EitherWay {
 protected:
  /// True if the triangle with window corners (0, 0), (4, 0), (0, 4), which turn from u to v, is
  /// drawn.
  static bool is_drawn(const State& state) {
    const State plain = small_state(4, 4, state.convention);
    return fragments_of(state, triangle(plain, {0, 0}, {4, 0}, {0, 4}), kFour).size() > 0;
  }
};

INSTANTIATE_TEST_SUITE_P(Drawn, RationalLinearConventions, EitherWay::ways(), EitherWay::way_name);

TEST_P(RationalLinearConventions, NdcYPointsDownInVulkanAndTheWindowUpInOpengl) {
  // A triangle in the corner with the least x and y in NDC.
  const SmallMesh mesh{{{-1, -1, 0, 1}, {0, -1, 0, 1}, {-1, 0, 0, 1}}, {}, {}, {{0, 1, 2}}};
  const Rows least_rows{"#.", ".."};
  const Rows greatest_rows{"..", "#."};
  for (const Convention convention : kConventions) {
    State state = small_state(4, 4, convention);
    state.viewport.size = {2, 2};
    state.fill_rule = FillRule::bottom_left;
    SmallMesh larger = mesh;
    larger.positions[1].x = 0.25F;
    larger.positions[2].y = 0.25F;
    EXPECT_EQ(picture(state, larger, {2, 2, 1}),
              convention == Convention::d3d ? greatest_rows : least_rows);
  }
}

TEST_P(RationalLinearConventions, ANegativeViewportHeightTurnsThePictureOver) {
  State state = small_state(4, 4);
  const SmallMesh mesh = triangle(state, {0, 0}, {4.25F, 0}, {0, 4.25F});
  state.viewport.origin = {0, 4};
  state.viewport.size = {4, -4};
  EXPECT_EQ(picture(state, mesh, kFour), (Rows{"#...", "##..", "###.", "####"}));
}

// Kills: facing that ignores where v points.
TEST_P(RationalLinearConventions, FacingIsMeantAsDisplayed) {
  for (const Convention convention : kConventions) {
    State state = small_state(4, 4, convention);
    const bool is_ccw = convention == Convention::opengl;  // v up
    for (const FrontFace front : {FrontFace::ccw, FrontFace::cw}) {
      state.front_face = front;
      const bool is_front = is_ccw == (front == FrontFace::ccw);
      state.cull = Cull::none;
      EXPECT_TRUE(is_drawn(state));
      state.cull = Cull::back;
      EXPECT_EQ(is_drawn(state), is_front);
      state.cull = Cull::front;
      EXPECT_EQ(is_drawn(state), !is_front);
    }
  }
}

TEST_P(RationalLinearConventions, ANegativeViewportHeightTurnsFacing) {
  State state = small_state(4, 4);
  state.viewport.origin = {0, 4};
  state.viewport.size = {4, -4};
  state.cull = Cull::back;
  state.front_face = FrontFace::ccw;
  EXPECT_TRUE(is_drawn(state));
  state.front_face = FrontFace::cw;
  EXPECT_FALSE(is_drawn(state));
}

// Kills: facing computed from divided positions.
TEST_P(RationalLinearConventions, FacingHoldsWithAVertexBehindTheEye) {
  State state = small_state(8, 8);
  state.cull = Cull::back;
  const SmallMesh mesh = behind_the_eye(state);
  // The visible part lies below v = 0, so that the edge from (2, 0) to (6, 0) is its upper side:
  // clockwise as displayed.
  state.front_face = FrontFace::cw;
  EXPECT_GT(fragments_of(state, mesh, kEight).size(), 0U);
  state.front_face = FrontFace::ccw;
  EXPECT_EQ(fragments_of(state, mesh, kEight).size(), 0U);
}

TEST_P(RationalLinearConventions, CulledTrianglesAreNotCounted) {
  State state = small_state(4, 4);
  state.cull = Cull::back;
  Fragments fragments;
  const SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  EXPECT_EQ(draw_fragments(state, mesh.mesh(), kFour, fragments).counts, DrawCounts{});
  EXPECT_EQ(fragments.size(), 0U);
}

}  // namespace
}  // namespace rastercheck::rasterizer::rational_linear_test
