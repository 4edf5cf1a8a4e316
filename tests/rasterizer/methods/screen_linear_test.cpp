#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tests/rasterizer/methods/method_draw.h"

namespace rastercheck::rasterizer::screen_linear_test {
namespace {

constexpr TargetSize kEight{8, 8, 1};
constexpr std::string_view kBoth[] = {"screen-linear", "screen-linear-barycentric"};

/// A triangle with the corners (1, 0), (7, 1), (2, 6), w = 1, 2, 4, and r = 2, 9, 5.
SmallMesh of_the_slides(State& state) {
  SmallMesh mesh;
  mesh.positions = {at(state, 1, 0, 1), at(state, 7, 1, 2), at(state, 2, 6, 4)};
  mesh.triangles = {{0, 1, 2}};
  return with_attributes(state, mesh, 1, {2, 9, 5});
}

// Rasterization slides, p. 4: a u + b v + c = r at the three corners. The differences give 6a + b =
// 7 and a + 6b = 3, so that a = 39/35, b = 11/35 and c = 2 − a = 31/35 for any w. Kills: a plane
// evaluated at the pixels' corners; values in perspective.
TEST(ScreenLinear, SolvesForThePlaneThroughTheCorners) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    for (const std::string_view method : kBoth) {
      State state = small_state(8, 8, convention);
      const SmallMesh mesh = of_the_slides(state);
      const Fragments fragments = drawn_by(method, state, mesh, kEight);
      expect_values(fragments, [](double u, double v) { return (39 * u + 11 * v + 31) / 35; });
      EXPECT_FLOAT_EQ(value_at(fragments, 3, 2), 39.0F / 7) << method;
    }
  }
}

TEST(ScreenLinear, IsWhatNoperspectiveIs) {
  State state = small_state(8, 8);
  SmallMesh mesh = of_the_slides(state);
  mesh = with_attributes(state, mesh, 2, {2, 2, 9, 9, 5, 5});
  state.attributes[1].interpolation = Interpolation::noperspective;
  for (const std::string_view method : kBoth) {
    const Fragments fragments = drawn_by(method, state, mesh, kEight);
    ASSERT_GT(fragments.size(), 10U);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      EXPECT_FLOAT_EQ(fragments.attributes[2 * i], fragments.attributes[2 * i + 1]) << method;
    }
  }
}

/// A triangle with r = 1 and w = 1 at u = 1/2, r = 0 and w = rho at u = far.
SmallMesh receding(State& state, float far, float rho) {
  SmallMesh mesh;
  mesh.positions = {at(state, 0.5F, 0), at(state, 0.5F, 8), at(state, far, 4, rho)};
  mesh.triangles = {{0, 1, 2}};
  return with_attributes(state, mesh, 1, {1, 1, 0});
}

struct Receding {
  float far;
  float rho;
  int worst;  ///< the column whose centre has λ = 1/(√ρ + 1)
};

// The methods draw λ = (far − u)/(far − 1/2); the value in perspective is b = ρ λ/(ρ λ + 1 − λ).
//   ρ = 4: b − λ is at most (2 − 1)/(2 + 1) = 1/3, at λ = 1/3: u = 1/2 + 2/3 · 6 = 4 1/2
//   ρ = 9: at most (3 − 1)/(3 + 1) = 1/2, at λ = 1/4: u = 1/2 + 3/4 · 4 = 3 1/2, and
//          u = 1/2 + 3/4 · 8 = 6 1/2
// Kills: a bound in the header that is too small or too large.
TEST(ScreenLinear, IsOffByAllThatItsHeaderSays) {
  for (const Receding& way : {Receding{6.5F, 4, 4}, {4.5F, 9, 3}, {8.5F, 9, 6}}) {
    State state = small_state(8, 8);
    const SmallMesh mesh = receding(state, way.far, way.rho);
    const double root = std::sqrt(double{way.rho});
    const double most = (root - 1) / (root + 1);
    const Fragments exact = fragments_of(state, mesh, kEight);
    for (const std::string_view method : kBoth) {
      const Fragments drawn = drawn_by(method, state, mesh, kEight);
      ASSERT_EQ(drawn.size(), exact.size());
      EXPECT_FLOAT_EQ(value_at(drawn, way.worst, 3), static_cast<float>(1 / (root + 1)));
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        const double off = double{exact.attributes[i]} - double{drawn.attributes[i]};
        EXPECT_GE(off, 0);
        EXPECT_LE(off, most + 0x1p-23);
        if (drawn.x[i] == way.worst) {
          EXPECT_NEAR(off, most, 0x1p-23);
        }
      }
    }
  }
}

TEST(ScreenLinear, ClaimsToBeAffine) {
  State state = small_state(8, 8);
  const SmallMesh mesh = of_the_slides(state);
  for (const std::string_view method : kBoth) {
    const Promise promise = find_method(method)->promise(state, mesh.mesh(), kEight);
    EXPECT_EQ(promise.claims, Claim::affine);
    EXPECT_EQ(promise.smooth.range_share, 0);
  }
}

// Each row takes two differences, and two products and a difference; det takes two sums. A plane
// takes 3 times three products, two sums and a quotient. A weight takes two products, two sums and
// a quotient.
TEST(ScreenLinear, CountsItsOperations) {
  const OperationCounts plane = operations_of("screen-linear");
  EXPECT_EQ(plane.per_vertex, (Operations{.divisions = 2}));
  EXPECT_EQ(plane.per_polygon,
            (Operations{.additions = 6 + 3 + 2 + 12, .multiplications = 6 + 18, .divisions = 6}));
  EXPECT_EQ(plane.per_pixel, (Operations{.additions = 4, .multiplications = 4}));
  const OperationCounts barycentric = operations_of("screen-linear-barycentric");
  EXPECT_EQ(barycentric.per_vertex, (Operations{.divisions = 2}));
  EXPECT_EQ(barycentric.per_polygon, (Operations{.additions = 6 + 3 + 2, .multiplications = 6}));
  EXPECT_EQ(barycentric.per_pixel,
            (Operations{.additions = 6 + 4, .multiplications = 6 + 6, .divisions = 3}));
}

}  // namespace
}  // namespace rastercheck::rasterizer::screen_linear_test
