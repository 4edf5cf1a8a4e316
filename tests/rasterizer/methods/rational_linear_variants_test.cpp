// rational-linear and the methods that differ from it in one step: what they cost, and how float32
// and additions along the rows change values.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

#include "tests/rasterizer/methods/method_draw.h"

namespace rastercheck::rasterizer::rational_linear_variants_test {
namespace {

/// The number of edges that bound a row.
constexpr std::size_t kEdges = 2;

constexpr std::string_view kNames[] = {"rational-linear", "rational-linear-float",
                                       "rational-linear-incremental"};

/// The unit in which a promise counts errors.
double scale_ulp(double greatest) {
  return std::ldexp(1.0, std::max(std::ilogb(greatest), -126) - 23);
}

OperationCounts operations_of(std::string_view name) { return find_method(name)->operations(); }

// Heckbert & Moreton 1991, §4: n + 1 divisions per vertex, none per polygon, n divisions per pixel.
// By hand, for three parameters: the weights of a place take three differences; a mean of two ends
// takes two products, a sum and a division.
TEST(RationalLinearOperations, AreThoseOfThePaperAndOfTheMeans) {
  const OperationCounts counts = operations_of("rational-linear");
  EXPECT_EQ(counts.per_polygon, (Operations{0, 0, 0}));
  EXPECT_EQ(counts.per_vertex, (Operations{0, 0, 3}));
  EXPECT_EQ(counts.per_row, (Operations{kEdges * (3 + 3), kEdges * 6, kEdges * 3}));
  EXPECT_EQ(counts.per_pixel, (Operations{3 + 3, 6, 3 + 2}));
}

// The weights are two quotients of differences, so that a mean needs no division.
TEST(RationalLinearOperations, InFloat32DivideOnceForAPlace) {
  const OperationCounts counts = operations_of("rational-linear-float");
  EXPECT_EQ(counts.per_polygon, (Operations{0, 0, 0}));
  EXPECT_EQ(counts.per_vertex, (Operations{0, 0, 3}));
  EXPECT_EQ(counts.per_row, (Operations{kEdges * (3 + 3), kEdges * 6, kEdges * 2}));
  EXPECT_EQ(counts.per_pixel, (Operations{3 + 3, 6, 2 + 2}));
}

// Heckbert & Moreton 1991, §3.1: "a per pixel cost of three additions, two divisions, and a texture
// access". Besides the ends, a row sets up its first sample, its width and three steps.
TEST(RationalLinearOperations, OfIncrementsAreThreeAdditionsAndTwoDivisionsAPixel) {
  const OperationCounts counts = operations_of("rational-linear-incremental");
  EXPECT_EQ(counts.per_vertex, (Operations{0, 0, 3}));
  EXPECT_EQ(counts.per_row, (Operations{12 + (3 + 3) + (1 + 3), 12 + 6, 4 + 2 + 3}));
  EXPECT_EQ(counts.per_pixel, (Operations{3, 0, 2}));
}

// With w = 1 and the attribute 0 at u = 0, w = 2 and the attribute 1 at u = 4, the attribute is u/8
// over (8 − u)/8. All of these numbers are dyadic, so that only the last division rounds.
TEST(RationalLinearVariants, AreExactWhereNothingRounds) {
  State state = small_state(4, 4);
  state.attributes = {{}};
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1), at(state, 4, 0, 2), at(state, 0, 4, 1)};
  mesh.attributes = {0, 1, 0};
  mesh.triangles = {{0, 1, 2}};
  for (const std::string_view name : kNames) {
    const Fragments fragments = drawn_by(name, state, mesh, {4, 4, 1});
    ASSERT_EQ(fragments.size(), 6U);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const float u = static_cast<float>(fragments.x[i]) + 0.5F;
      EXPECT_EQ(fragments.attributes[i], u / (8 - u)) << name;
    }
  }
}

// Kills: r/w and 1/w stored in float32 without scaling, where they overflow and underflow.
TEST(RationalLinearVariants, HoldForTheGreatestAndTheLeastNumbers) {
  State state = small_state(4, 4);
  state.attributes = {{}};
  for (const float w : {0x1p-100F, 0x1p100F}) {
    for (const float r : {0x1p-120F, 0x1p120F}) {
      SmallMesh mesh;
      mesh.positions = {at(state, 0, 0, w), at(state, 4, 0, 2 * w), at(state, 0, 4, w)};
      mesh.attributes = {0, r, 0};
      mesh.triangles = {{0, 1, 2}};
      for (const std::string_view name : kNames) {
        const Fragments fragments = drawn_by(name, state, mesh, {4, 4, 1});
        ASSERT_EQ(fragments.size(), 6U);
        for (std::size_t i = 0; i < fragments.size(); ++i) {
          const float u = static_cast<float>(fragments.x[i]) + 0.5F;
          EXPECT_EQ(fragments.attributes[i] / r, u / (8 - u)) << name;
        }
      }
    }
  }
}

/// The worst difference from rational-linear in scale ULP, over random triangles in a target of
/// `width` x 4 pixels, with w from 1 to `ratio`.
struct Differences {
  double greatest = 0;
  double greatest_beyond = -std::numeric_limits<double>::infinity();  ///< over the promise
};

Differences differences(std::string_view method, int width, float ratio, std::size_t triangles) {
  std::mt19937 random(20260901);
  const auto between = [&random](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24F;
  };
  State state = small_state(width, 4);
  // The second attribute is w itself.
  state.attributes = {{}, {}};
  const TargetSize size{width, 4, 1};
  Differences found;
  for (std::size_t k = 0; k < triangles; ++k) {
    SmallMesh mesh;
    double least_w = ratio;
    for (std::size_t i = 0; i < 3; ++i) {
      const float w = between(1, ratio);
      least_w = std::min(least_w, double{w});
      mesh.positions.push_back(at(state, between(0, static_cast<float>(width)), between(-4, 8), w));
      mesh.attributes.insert(mesh.attributes.end(), {between(-1, 1), w});
    }
    mesh.triangles = {{0, 1, 2}};
    const MethodBound bound = find_method(method)->promise(state, mesh.mesh(), size).smooth;
    const Fragments expected = drawn_by("rational-linear", state, mesh, size);
    const Fragments fragments = drawn_by(method, state, mesh, size);
    EXPECT_EQ(fragments.size(), expected.size());
    double greatest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      greatest = std::max(greatest, std::abs(double{mesh.attributes[2 * i]}));
    }
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const double off =
          std::abs(double{fragments.attributes[2 * i]} - double{expected.attributes[2 * i]}) /
          scale_ulp(greatest);
      const double g = double{expected.attributes[2 * i + 1]} / least_w;
      found.greatest = std::max(found.greatest, off);
      found.greatest_beyond =
          std::max(found.greatest_beyond, off - bound.constant - 0.51 - bound.per_horizon * g);
    }
  }
  return found;
}

// Kills: parameters that are double after all; a promise that does not hold near the horizon.
TEST(RationalLinearFloat, IsOffByUnitsAndNotMoreTowardsTheHorizon) {
  for (const float ratio : {1.5F, 0x1p20F}) {
    const Differences found = differences("rational-linear-float", 256, ratio, 300);
    EXPECT_GT(found.greatest, 1.5);
    EXPECT_LE(found.greatest_beyond, 0);
  }
}

// Kills: steps that are multiplied instead of added, whose error does not grow.
TEST(RationalLinearIncremental, DriftsWithTheWidth) {
  const Differences narrow = differences("rational-linear-incremental", 64, 4, 100);
  const Differences wide = differences("rational-linear-incremental", 8192, 4, 100);
  EXPECT_LE(narrow.greatest_beyond, 0);
  EXPECT_LE(wide.greatest_beyond, 0);
  EXPECT_GT(narrow.greatest, 3);
  EXPECT_GT(wide.greatest, 10 * narrow.greatest);
}

// Kills: values divided by a denominator that has drifted to zero.
TEST(RationalLinearIncremental, StaysInTheRangeOfTheVertices) {
  State state = small_state(4096, 4);
  state.attributes = {{}};
  SmallMesh mesh;
  mesh.positions = {at(state, 0, -4, 1), at(state, 4096, -4, 0x1p40F), at(state, 0, 8, 1)};
  mesh.attributes = {1, 2, 1};
  mesh.triangles = {{0, 1, 2}};
  const Fragments fragments = drawn_by("rational-linear-incremental", state, mesh, {4096, 4, 1});
  ASSERT_GT(fragments.size(), 4096U);
  const auto [least, greatest] =
      std::minmax_element(fragments.attributes.begin(), fragments.attributes.end());
  EXPECT_GE(*least, 1);
  EXPECT_LE(*greatest, 2);
}

// A viewport of 8 columns at the far end of a wide target, in a triangle that reaches across the
// whole target. The viewport's rows, and the rows of centres, are 8 steps long. The promise for so
// few steps is 2 (23 + 16) + 1 scale ULP times g, and g is 1 here. The 4096 steps of the whole
// target would cost hundreds. Kills: increments for centres that begin at the target's left side.
TEST(RationalLinearIncremental, BeginsWhereTheViewportDoes) {
  State state;
  state.viewport.origin = {4088, 0};
  state.viewport.size = {8, 8};
  state.attributes = {{Interpolation::smooth, Location::center}};
  SmallMesh mesh;
  mesh.positions = {at(state, -4088, -64, 4), at(state, 8, -64, 1), at(state, 8, 64, 1)};
  mesh.attributes = {0.3F, 0.9F, 0.9F};
  mesh.triangles = {{0, 1, 2}};
  const TargetSize size{4096, 8, 1};
  const Fragments expected = drawn_by("rational-linear", state, mesh, size);
  const Fragments drawn = drawn_by("rational-linear-incremental", state, mesh, size);
  ASSERT_EQ(drawn.size(), expected.size());
  ASSERT_GT(drawn.size(), 30U);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_NEAR(drawn.attributes[i], expected.attributes[i], 79 * scale_ulp(0.9));
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::rational_linear_variants_test
