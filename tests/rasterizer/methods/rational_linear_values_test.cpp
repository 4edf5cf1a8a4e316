#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/either_way.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::rational_linear_values_test {
namespace {

constexpr TargetSize kFour{4, 4, 1};
constexpr Convention kConventions[] = {Convention::opengl, Convention::vulkan, Convention::d3d};

// --- Values -------------------------------------------------------------------------------------

using RationalLinearValues = EitherWay;

INSTANTIATE_TEST_SUITE_P(Drawn, RationalLinearValues, EitherWay::ways(), EitherWay::way_name);

/// A triangle with w = 1 and the attribute 0 at u = 0, w = 2 and the attribute 1 at u = 4. The
/// attribute is u/8 over (8 − u)/8.
SmallMesh in_perspective(const State& state) {
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1, 0), at(state, 4, 0, 2, 0.5F), at(state, 0, 4, 1, 0)};
  mesh.attributes = {0, 1, 0};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

// Kills: interpolation linear in window space ("rubber sheet").
TEST_P(RationalLinearValues, SmoothIsLinearOverLinear) {
  for (const Convention convention : kConventions) {
    State state = small_state(4, 4, convention);
    state.attributes = {{}};
    expect_values(fragments_of(state, in_perspective(state), kFour),
                  [](double u, double) { return u / (8 - u); });
  }
}

// Kills: sums of zeros of both signs at an extrapolated centre; −0 · w with w < 0.
TEST_P(RationalLinearValues, AZeroAtAllVerticesKeepsItsSign) {
  State state = small_state(4, 4);
  for (const Location location : {Location::sample, Location::center, Location::centroid}) {
    for (const Interpolation interpolation :
         {Interpolation::smooth, Interpolation::noperspective}) {
      state.attributes = {{interpolation, location}};
      for (const float zero : {0.0F, -0.0F}) {
        SmallMesh mesh = in_perspective(state);
        mesh.positions[0] = -mesh.positions[0];
        mesh.attributes = {zero, zero, zero};
        const Fragments fragments = fragments_of(state, mesh, {4, 4, 4});
        ASSERT_GT(fragments.size(), 0U);
        for (const float value : fragments.attributes) {
          EXPECT_EQ(value, 0);
          EXPECT_EQ(std::signbit(value), std::signbit(zero));
        }
      }
    }
  }
}

TEST_P(RationalLinearValues, NoperspectiveIsLinearInTheWindow) {
  State state = small_state(4, 4);
  state.attributes = {{Interpolation::noperspective, Location::sample}};
  expect_values(fragments_of(state, in_perspective(state), kFour),
                [](double u, double) { return u / 4; });
}

// Kills: noperspective values made linear in clip space by clipping.
TEST_P(RationalLinearValues, NoperspectiveStaysLinearInTheWindowWhereClipped) {
  State state = small_state(4, 4);
  state.attributes = {{Interpolation::noperspective, Location::sample}};
  SmallMesh mesh = in_perspective(state);
  // Depth falls from 1 to −1 along u, which cuts the triangle at u = 2.
  mesh.positions[0].z = 1;
  mesh.positions[1].z = -2;
  mesh.positions[2].z = 1;
  const Fragments fragments = fragments_of(state, mesh, kFour);
  EXPECT_EQ(picture(fragments, kFour), (Rows{"##..", "##..", "#...", "...."}));
  expect_values(fragments, [](double u, double) { return u / 4; });
}

TEST_P(RationalLinearValues, FlatIsTheProvokingVertex) {
  for (const Convention convention : kConventions) {
    State state = small_state(4, 4, convention);
    state.attributes = {{Interpolation::flat, Location::sample}};
    SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
    mesh.attributes = {0.1F, 0.2F, 0.3F};
    mesh.triangles = {{1, 0, 2}};
    const float expected = convention == Convention::opengl ? 0.3F : 0.2F;
    const Fragments fragments = fragments_of(state, mesh, kFour);
    EXPECT_EQ(fragments.attributes, std::vector<float>(fragments.size(), expected));
  }
}

TEST_P(RationalLinearValues, EveryAttributeHasItsOwnQualifier) {
  State state = small_state(4, 4);
  state.attributes = {{Interpolation::noperspective, Location::sample},
                      {Interpolation::flat, Location::center},
                      {Interpolation::smooth, Location::center}};
  SmallMesh mesh = in_perspective(state);
  mesh.attributes = {0, 5, 0, 1, 6, 1, 0, 7, 0};
  const Fragments fragments = fragments_of(state, mesh, kFour);
  ASSERT_EQ(fragments.attributes.size(), 3 * fragments.size());
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const float u = static_cast<float>(fragments.x[i]) + 0.5F;
    EXPECT_EQ(fragments.attributes[3 * i], u / 4);
    EXPECT_EQ(fragments.attributes[3 * i + 1], 5);
    EXPECT_FLOAT_EQ(fragments.attributes[3 * i + 2], u / (8 - u));
  }
}

// Kills: means with weights that do not add to one.
TEST_P(RationalLinearValues, ConstantsComeOutExactly) {
  for (const float constant : {0.1F, -3e38F, 1e-45F, 1.0F / 3}) {
    State state = small_state(16, 16);
    state.attributes = {{}, {Interpolation::noperspective, Location::center}};
    SmallMesh mesh;
    mesh.positions = {at(state, 1, 2, 0.7F), at(state, 15, 3, 1.9F), at(state, 4, 16, 3.1F)};
    mesh.attributes.assign(6, constant);
    mesh.triangles = {{0, 1, 2}};
    const Fragments fragments = fragments_of(state, mesh, {16, 16, 4});
    ASSERT_GT(fragments.size(), 200U);
    EXPECT_EQ(fragments.attributes, std::vector<float>(2 * fragments.size(), constant));
  }
}

TEST_P(RationalLinearValues, ASampleOnAVertexHasItsValue) {
  State state = small_state(4, 4);
  state.attributes = {{}};
  SmallMesh mesh;
  mesh.positions = {at(state, 0.5F, 0.5F, 3), at(state, 3.5F, 0.5F, 5), at(state, 0.5F, 3.5F, 7)};
  mesh.attributes = {0.1F, 0.2F, 0.3F};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(value_at(fragments_of(state, mesh, kFour), 0, 0), 0.1F);
}

// Kills: sums in float32, whose parts overflow.
TEST_P(RationalLinearValues, WhatIsBeyondFloatComesOutInfinite) {
  State state = small_state(1, 1);
  state.attributes = {{Interpolation::noperspective, Location::center}};
  // The triangle is u + v < 9/16. Of two samples, it covers sample 1, at (4, 4) sixteenths. At the
  // centre the value is 16/9 of 3e38.
  SmallMesh mesh = triangle(state, {0, 0}, {0.5625F, 0}, {0, 0.5625F});
  mesh.attributes = {0, 3e38F, 3e38F};
  const Fragments fragments = fragments_of(state, mesh, {1, 1, 2});
  ASSERT_GT(fragments.size(), 0U);
  EXPECT_EQ(fragments.attributes[0], std::numeric_limits<float>::infinity());
}

// --- Locations ----------------------------------------------------------------------------------

class RationalLinearLocations : public EitherWay {
 protected:
  /// The fragments of the columns left of `edge`, with w = 1 and the attribute u, in a target of 2
  /// x 1 pixels with 4 samples. The samples' x in sixteenths are 6, 14, 2, 10, so that only sample
  /// 2 of pixel 1 lies left of 5/4.
  static Fragments left_part(Location location, float edge) {
    State state = small_state(2, 1);
    state.attributes = {{Interpolation::smooth, location}};
    SmallMesh mesh = rectangle(state, {0, 0}, {edge, 1});
    mesh.attributes = {0, edge, edge, 0};
    return fragments_of(state, mesh, {2, 1, 4});
  }
};

INSTANTIATE_TEST_SUITE_P(Drawn, RationalLinearLocations, EitherWay::ways(), EitherWay::way_name);

TEST_P(RationalLinearLocations, SampleIsWhereTheSampleLies) {
  const Fragments fragments = left_part(Location::sample, 1.25F);
  ASSERT_EQ(picture(fragments, {2, 1, 4}), (Rows{"####..#."}));
  EXPECT_EQ(value_at(fragments, 0, 0, 0), 6 / 16.0F);
  EXPECT_EQ(value_at(fragments, 0, 0, 1), 14 / 16.0F);
  EXPECT_EQ(value_at(fragments, 0, 0, 3), 10 / 16.0F);
  EXPECT_EQ(value_at(fragments, 1, 0, 2), 18 / 16.0F);
}

// Kills: a centre moved into the triangle.
TEST_P(RationalLinearLocations, CenterExtrapolatesWhereTheCentreIsUncovered) {
  const Fragments fragments = left_part(Location::center, 1.25F);
  for (int sample = 0; sample < 4; ++sample) EXPECT_EQ(value_at(fragments, 0, 0, sample), 0.5F);
  EXPECT_EQ(value_at(fragments, 1, 0, 2), 1.5F);
}

TEST_P(RationalLinearLocations, CenterExtrapolatesInPerspective) {
  State state = small_state(4, 4);
  state.attributes = {{Interpolation::smooth, Location::center}};
  const Fragments fragments = fragments_of(state, in_perspective(state), {4, 4, 8});
  ASSERT_GT(fragments.size(), 0U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const double u = fragments.x[i] + 0.5;
    EXPECT_FLOAT_EQ(fragments.attributes[i], static_cast<float>(u / (8 - u)));
  }
}

// Kills: a plane through the part that clipping leaves, which is a line here.
TEST_P(RationalLinearLocations, CenterIsByThePlaneOfTheWholeTriangle) {
  State state = small_state(4, 4);
  state.attributes = {{Interpolation::smooth, Location::center}};
  // The left edge goes through the first sample of each pixel in column 0, and touches the near
  // plane.
  SmallMesh mesh = triangle(state, {0.375F, 0}, {4.375F, 0}, {0.375F, 4});
  mesh.positions[1].z = -1;
  mesh.attributes = {0.375F, 4.375F, 0.375F};
  const Fragments fragments = fragments_of(state, mesh, {4, 4, 4});
  EXPECT_EQ(picture(fragments, {4, 4, 4}), Rows(4, "#..............."));
  EXPECT_EQ(fragments.attributes, std::vector<float>(4, 0.5F));
}

// Kills: a centroid that is always the centre; the last covered sample used instead of the first.
TEST_P(RationalLinearLocations, CentroidIsTheCentreOrTheFirstCoveredSample) {
  // The two triangles of a rectangle are covered separately, so this test uses one triangle that
  // covers all of pixel 0. In row 0, its right side goes from u = 2 to u = 1.
  State state = small_state(2, 1);
  state.attributes = {{Interpolation::smooth, Location::centroid}};
  SmallMesh mesh = triangle(state, {0, 0}, {2, 0}, {0, 2});
  mesh.attributes = {0, 2, 0};
  const Fragments fragments = fragments_of(state, mesh, {2, 1, 4});
  // The triangle is u + v < 2. The samples of pixel 1 are at (22, 2), (30, 6), (18, 10), (26, 14)
  // sixteenths.
  ASSERT_EQ(picture(fragments, {2, 1, 4}), (Rows{"#####.#."}));
  for (int sample = 0; sample < 4; ++sample) EXPECT_EQ(value_at(fragments, 0, 0, sample), 0.5F);
  EXPECT_EQ(value_at(fragments, 1, 0, 0), 22 / 16.0F);
  EXPECT_EQ(value_at(fragments, 1, 0, 2), 22 / 16.0F);
}

TEST_P(RationalLinearLocations, CentroidTakesSamplesOutsideTheViewportForUncovered) {
  State state = small_state(2, 2);
  state.attributes = {{Interpolation::smooth, Location::centroid}};
  state.viewport.origin = {0.5F, 0};
  SmallMesh mesh = triangle(state, {-2, 0}, {4, 0}, {-2, 6});
  mesh.attributes = {-1.5F, 4.5F, -1.5F};  // the window's u, which the viewport shifts by 1/2
  const Fragments fragments = fragments_of(state, mesh, {1, 1, 4});
  ASSERT_EQ(picture(fragments, {1, 1, 4}), (Rows{".#.#"}));
  EXPECT_EQ(value_at(fragments, 0, 0, 3), 14 / 16.0F);
}

TEST_P(RationalLinearLocations, WithOneSampleAllThreeAreTheSame) {
  State state = small_state(16, 16);
  state.attributes = {{Interpolation::smooth, Location::sample},
                      {Interpolation::smooth, Location::center},
                      {Interpolation::smooth, Location::centroid}};
  SmallMesh mesh;
  mesh.positions = {at(state, 1, 2, 0.7F), at(state, 15, 3, 1.9F), at(state, 4, 16, 3.1F)};
  mesh.attributes = {0.1F, 0.1F, 0.1F, 0.7F, 0.7F, 0.7F, -0.3F, -0.3F, -0.3F};
  mesh.triangles = {{0, 1, 2}};
  const Fragments fragments = fragments_of(state, mesh, {16, 16, 1});
  ASSERT_GT(fragments.size(), 50U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    EXPECT_EQ(fragments.attributes[3 * i], fragments.attributes[3 * i + 1]);
    EXPECT_EQ(fragments.attributes[3 * i], fragments.attributes[3 * i + 2]);
  }
}

// --- Depth --------------------------------------------------------------------------------------

using RationalLinearDepth = EitherWay;

INSTANTIATE_TEST_SUITE_P(Drawn, RationalLinearDepth, EitherWay::ways(), EitherWay::way_name);

TEST_P(RationalLinearDepth, DepthIsMappedFromTheConventionsRange) {
  for (const Convention convention : kConventions) {
    State state = small_state(1, 1, convention);
    state.viewport.min_depth = 0.25F;
    state.viewport.max_depth = 0.75F;
    const SmallMesh mesh = [&] {
      SmallMesh m = triangle(state, {0, 0}, {2, 0}, {0, 2});
      for (glm::vec4& p : m.positions) p = {p.x * 4, p.y * 4, 1, 4};
      return m;
    }();
    // z/w = 1/4 is 5/8 of the way from −1 to 1.
    const float expected = convention == Convention::opengl ? 0.5625F : 0.375F;
    EXPECT_EQ(fragments_of(state, mesh, {1, 1, 1}).depth, (std::vector<float>{expected}));
  }
}

TEST_P(RationalLinearDepth, AReversedDepthRangeReversesDepth) {
  State state = small_state(4, 4);
  state.viewport.min_depth = 1;
  state.viewport.max_depth = 0;
  const Fragments fragments = fragments_of(state, sloping(state, false, 0.25F, 0.5F), kFour);
  ASSERT_EQ(fragments.size(), 16U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    EXPECT_EQ(fragments.depth[i], 0.75F - 0.25F * static_cast<float>(fragments.x[i]));
  }
}

TEST_P(RationalLinearDepth, DepthIsLinearInTheWindow) {
  State state = small_state(4, 4);
  state.attributes = {{}};
  const Fragments fragments = fragments_of(state, in_perspective(state), kFour);
  ASSERT_GT(fragments.size(), 0U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    EXPECT_EQ(fragments.depth[i], (static_cast<float>(fragments.x[i]) + 0.5F) / 8);
  }
}

// Kills: a mean of two equal ends that differs from their value. The depth, 3/4 of 12000002 ·
// 2^-24, lies halfway between two floats, where any error shows.
TEST_P(RationalLinearDepth, APlaneOfEqualDepthHasOneDepth) {
  State state = small_state(16, 16);
  state.viewport.max_depth = 0.75F;
  const float depth = 12000002 * 0x1p-24F;
  SmallMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  mesh.positions = {at(state, 0.3F, 0.9F, 4, depth), at(state, 15.7F, 2.1F, 2, depth),
                    at(state, 3.3F, 15.9F, 1, depth)};
  const auto expect_one_depth = [&] {
    const Fragments fragments = fragments_of(state, mesh, {16, 16, 4});
    ASSERT_GT(fragments.size(), 100U);
    EXPECT_EQ(fragments.depth, std::vector<float>(fragments.size(), 9000002 * 0x1p-24F));
  };
  expect_one_depth();
  // Clipped, with w = 1 at all vertices.
  for (glm::vec4& p : mesh.positions) p /= p.w;
  state.clip_distance_count = 2;
  mesh.clip_distances = {0.7F, -0.1F, -0.3F, 0.9F, 0.3F, 0.7F};
  expect_one_depth();
}

// A triangle that reaches behind the eye and beyond the window, with values at every location, also
// cut and extrapolated ones. Both drawings are within one or two ulp of the exact values, which are
// below 8, so that an ulp is at most 2^-21.
TEST(RationalLinearMethod, DrawsWhatTheRasterizerDoesOfAClippedTriangle) {
  State state = small_state(4, 4);
  state.attributes = {{Interpolation::smooth, Location::sample},
                      {Interpolation::smooth, Location::center},
                      {Interpolation::noperspective, Location::centroid}};
  SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  mesh.positions = {{-1, -2, 0.5F, 1}, {3, -1, 0.5F, 1}, {1, 4, -1, -0.5F}};
  mesh.attributes = {1, 1, 1, 2, 2, 2, 4, 4, 4};
  Fragments expected;
  ASSERT_FALSE(draw_fragments(state, mesh.mesh(), {4, 4, 4}, expected).error);
  ASSERT_GT(expected.size(), 0U);
  Fragments fragments;
  ASSERT_FALSE(
      draw_fragments_by("rational-linear", state, mesh.mesh(), {4, 4, 4}, fragments).error);
  ASSERT_EQ(fragments.size(), expected.size());
  for (std::size_t i = 0; i < expected.attributes.size(); ++i) {
    ASSERT_LT(std::abs(expected.attributes[i]), 8);
    EXPECT_NEAR(fragments.attributes[i], expected.attributes[i], 2 * 0x1p-21);
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::rational_linear_values_test
