#include "rasterizer/methods/quad.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <utility>

namespace rastercheck::rasterizer::quad_test {
namespace {

constexpr std::array<glm::vec2, 4> kSquare{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// The trapezoid (0,0), (4,0), (3,2), (1,2), w = 1: its turns are a = 4, 4, 8, 8 (twice the area of
/// the triangle that remains without one corner), and Heckbert's g = 0, h = 1 (Σ = (−2, 0), Δ1 =
/// (1, −2), Δ2 = (−2, 0)).
Quad trapezoid() { return {{{{0, 0, 0, 1}, {4, 0, 0, 1}, {3, 2, 0, 1}, {1, 2, 0, 1}}}, kSquare}; }

glm::dvec2 divided(const glm::dvec3& p) { return {p.x / p.z, p.y / p.z}; }

void expect_near(const glm::dvec2& actual, const glm::dvec2& expected) {
  EXPECT_NEAR(actual.x, expected.x, 1e-14);
  EXPECT_NEAR(actual.y, expected.y, 1e-14);
}

// x = (4 s + 2 t)/(t + 1), y = 4 t/(t + 1).
TEST(Quad, OfTheSquareIsHeckbertsClosedForm) {
  const Quad quad = trapezoid();
  std::array<glm::dvec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = {quad.positions[i].x, quad.positions[i].y, 1};
  }
  const glm::dmat3 closed{4, 0, 0, 2, 4, 1, 0, 0, 1};  // columns (a, d, g), (b, e, h), (c, f, 1)
  EXPECT_EQ(square_to_quad(corners, {1, 1, 2, 2}).matrix, closed);
}

TEST(Quad, HasWeightsThatMakeItsParametersAffineOnTheScreen) {
  const QuadResult inferred = infer(trapezoid());
  ASSERT_EQ(inferred.error, std::nullopt);
  EXPECT_EQ(inferred.map.w_r, (std::array{0.5, 0.5, 0.25, 0.25}));
  // In both directions: the square's diagonals meet in (1/2, 1/2), the trapezoid's in (2, 4/3).
  expect_near(divided(inferred.map.to_clip.matrix * glm::dvec3(0.5, 0.5, 1)), {2, 4.0 / 3});
  expect_near(divided(inferred.map.to_parameters.matrix * glm::dvec3(2, 4.0 / 3, 1)), {0.5, 0.5});
  expect_near(divided(inferred.map.to_parameters.matrix * glm::dvec3(3, 2, 1)), {1, 1});
}

// A rectangle in the plane z = w − 1, in perspective: w = 1 where v = 0, and w = 3 where v = 1. Its
// parameters are affine in clip space, and so they have the same w_r at all corners.
TEST(Quad, ThatIsSeenInPerspectiveHasOneWeight) {
  const Quad quad{{{{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, -1, 2, 3}, {-1, -1, 2, 3}}}, kSquare};
  const QuadResult inferred = infer(quad);
  ASSERT_EQ(inferred.error, std::nullopt);
  EXPECT_EQ(inferred.map.w_r, (std::array{0.5, 0.5, 0.5, 0.5}));
  // Halfway on the screen, at y/w = −2/3, w is the harmonic mean 3/2.
  expect_near(divided(inferred.map.to_parameters.matrix * glm::dvec3(0, -2.0 / 3, 1)), {0.5, 0.25});
}

// Kills: convexity judged by window positions, which corners behind the eye do not have.
TEST(Quad, MayReachBehindTheEye) {
  const Quad quad{{{{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, -1, -2, -1}, {-1, -1, -2, -1}}}, kSquare};
  const QuadResult inferred = infer(quad);
  ASSERT_EQ(inferred.error, std::nullopt);
  EXPECT_EQ(inferred.map.w_r, (std::array{0.5, 0.5, 0.5, 0.5}));
  // w = 1 − 2 v, so that w = 1/2 at v = 1/4.
  expect_near(divided(inferred.map.to_parameters.matrix * glm::dvec3(0, -2, 1)), {0.5, 0.25});
}

TEST(Quad, TakesCornersEitherWayAround) {
  Quad quad = trapezoid();
  std::swap(quad.positions[1], quad.positions[3]);
  std::swap(quad.parameters[1], quad.parameters[3]);
  EXPECT_EQ(infer(quad).map.w_r, (std::array{0.5, 0.25, 0.25, 0.5}));
  // Only the parameters are mirrored.
  Quad mirrored = trapezoid();
  for (glm::vec2& parameter : mirrored.parameters) parameter.x = -parameter.x;
  EXPECT_EQ(infer(mirrored).map.w_r, (std::array{0.5, 0.5, 0.25, 0.25}));
}

TEST(Quad, ThatHasNoMapSaysWhy) {
  const auto error = [](const auto& change) {
    Quad quad = trapezoid();
    change(quad);
    return infer(quad).error;
  };
  EXPECT_EQ(error([](Quad&) {}), std::nullopt);
  for (const float bad : {std::numeric_limits<float>::infinity(), NAN}) {
    EXPECT_EQ(error([&](Quad& q) { q.positions[2].w = bad; }), QuadError::not_finite);
    EXPECT_EQ(error([&](Quad& q) { q.parameters[3].y = bad; }), QuadError::not_finite);
    // z does not matter.
    EXPECT_EQ(error([&](Quad& q) { q.positions[2].z = bad; }), std::nullopt);
  }
  EXPECT_EQ(error([](Quad& q) { q.positions[2] = {2, 1, 0, 1}; }), QuadError::not_convex);
  EXPECT_EQ(error([](Quad& q) { q.positions[2] = {2.5F, 1, 0, 1}; }), QuadError::corners_in_line);
  EXPECT_EQ(error([](Quad& q) { q.positions[2] = q.positions[0]; }), QuadError::corners_in_line);
  EXPECT_EQ(error([](Quad& q) { q.positions[2] = {0, 0, 0, 0}; }), QuadError::corners_in_line);
  EXPECT_EQ(error([](Quad& q) { std::swap(q.positions[2], q.positions[3]); }),
            QuadError::not_convex);
  EXPECT_EQ(error([](Quad& q) { q.parameters[2] = {0.5F, 0.5F}; }), QuadError::parameters_in_line);
  EXPECT_EQ(error([](Quad& q) {
              q.parameters[2] = {0.25F, 0.25F};
            }),
            QuadError::parameters_not_convex);
  EXPECT_EQ(error([](Quad& q) { std::swap(q.parameters[2], q.parameters[3]); }),
            QuadError::parameters_not_convex);
  // Corner 0 is 2^-70 off the line through its neighbours.
  EXPECT_EQ(error([](Quad& q) {
              q.positions = {{{-0x1p-70F, 0, 0, 1}, {0, -1, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}};
            }),
            QuadError::factors_out_of_range);
}

TEST(Quad, ErrorsHaveWords) {
  for (const QuadError error :
       {QuadError::not_finite, QuadError::corners_in_line, QuadError::not_convex,
        QuadError::parameters_in_line, QuadError::parameters_not_convex,
        QuadError::factors_out_of_range}) {
    EXPECT_FALSE(to_string(error).empty());
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::quad_test
