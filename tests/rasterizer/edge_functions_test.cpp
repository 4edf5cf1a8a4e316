#include "rasterizer/internal/edge_functions.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/rasterizer/exact_frame.h"

namespace rastercheck::rasterizer::edge_functions_test {
namespace {

Rational value_of(const ExactSum& sum) {
  Rational value = 0;
  for (const double component : sum.components()) value += Rational(component);
  return value;
}

EdgeFunctions edges_of(const FramedDraw& draw) {
  return edge_functions(draw.corners, draw.orientation, draw.frame, 1);
}

void expect_coefficient(const Coefficient& coefficient, const Rational& exact) {
  EXPECT_EQ(Rational(coefficient.value) + Rational(coefficient.tail), exact);
  EXPECT_EQ(coefficient.value + coefficient.tail, coefficient.value);
  EXPECT_EQ(sgn(Rational(coefficient.value)), sgn(exact));
}

TEST(EdgeFunctions, CoefficientsAreExactWithTheirTails) {
  Random random(40);
  for (int i = 0; i < 4'000 && !HasFailure(); ++i) {
    const FramedDraw draw = random_framed_draw(random);
    const EdgeFunctions edges = edges_of(draw);
    for (std::size_t e = 0; e < 3; ++e) {
      const auto exact = exact_coefficients(draw.corners, draw.orientation, e);
      expect_coefficient(edges[e].a, exact[0]);
      expect_coefficient(edges[e].b, exact[1]);
      expect_coefficient(edges[e].c, exact[2]);
    }
  }
}

/// Checks an edge function at a sample; returns true if the evaluation was exact.
bool expect_sample(const EdgeFunction& edge, const SampleFrame& frame, const SampleOffset& at,
                   const Rational& exact) {
  const double computed = edge.at(frame, at.x, edge.row(frame, at.y));
  const Rational error = abs(Rational(computed) - exact);
  // If the band is 0, this checks that nothing was rounded.
  EXPECT_LE(error, Rational(edge.band));
  EXPECT_LE(abs(exact), Rational(edge.greatest) * (1 + power_of_two(-50)));
  EXPECT_EQ(value_of(exact_edge(edge, frame, at.x, at.y)), exact);
  return error == 0;
}

// Corners and viewports of all sizes, subnormal to 2^127; samples of targets up to the largest.
// Kills: a band that omits a rounding, the tails, or the errors of U and V; a test for exactness
// that accepts roundings; an exact edge that drops a product.
TEST(EdgeFunctions, AreWithinTheirBands) {
  Random random(41);
  int rounded = 0;
  int exact_bands = 0;
  for (int i = 0; i < 5'000 && !HasFailure(); ++i) {
    const FramedDraw draw = random_framed_draw(random);
    const EdgeFunctions edges = edges_of(draw);
    for (int k = 0; k < 3; ++k) {
      const SampleOffset at = random_sample(random, draw.bounds, draw.samples);
      const auto exact = exact_weights(draw.corners, draw.orientation, draw.state, at.x, at.y);
      for (std::size_t e = 0; e < 3; ++e) {
        rounded += expect_sample(edges[e], draw.frame, at, exact[e]) ? 0 : 1;
        exact_bands += edges[e].band == 0 ? 1 : 0;
      }
    }
  }
  // Both kinds are common.
  EXPECT_GT(rounded, 5'000);
  EXPECT_GT(exact_bands, 1'000);
}

// A viewport far from the origin, seen through one pixel: U is small, but its error is not. Kills:
// a band without the errors of U and V.
TEST(EdgeFunctions, AreWithinTheirBandsFarFromTheOrigin) {
  Random random(43);
  for (int i = 0; i < 2'000 && !HasFailure(); ++i) {
    FramedDraw draw;
    const int x = random.between(8'000, kMaxSize - 1);
    const int y = random.between(8'000, kMaxSize - 1);
    draw.state.viewport.origin = {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F};
    draw.state.viewport.size = {random.real(-60, -1), random.real(-60, -1)};
    if (draw.state.viewport.size.x == 0 || draw.state.viewport.size.y == 0) continue;
    draw.state.scissor = {{x, y}, {1, 1}};
    draw.bounds = draw_bounds(draw.state, {kMaxSize, kMaxSize, 1});
    draw.frame = sample_frame(draw.state, draw.bounds, 1);
    draw.orientation = 1;
    for (glm::vec4& p : draw.corners) p = {random.real(-2, 1), random.real(-2, 1), 0, 1};
    const SampleOffset at{x + 0.5, y + 0.5};
    const auto exact = exact_weights(draw.corners, 1, draw.state, at.x, at.y);
    const EdgeFunctions edges = edges_of(draw);
    for (std::size_t e = 0; e < 3; ++e) expect_sample(edges[e], draw.frame, at, exact[e]);
  }
}

// Bands are not too wide: the largest error found is not far below the band.
TEST(EdgeFunctions, BandsAreNotIdle) {
  Random random(42);
  double worst = 0;
  for (int i = 0; i < 4'000; ++i) {
    const FramedDraw draw = random_framed_draw(random);
    const EdgeFunctions edges = edges_of(draw);
    const SampleOffset at = random_sample(random, draw.bounds, draw.samples);
    const auto exact = exact_weights(draw.corners, draw.orientation, draw.state, at.x, at.y);
    for (std::size_t e = 0; e < 3; ++e) {
      if (edges[e].band == 0) continue;
      const double computed = edges[e].at(draw.frame, at.x, edges[e].row(draw.frame, at.y));
      const Rational share = abs(Rational(computed) - exact[e]) / Rational(edges[e].band);
      worst = std::max(worst, share.get_d());
    }
  }
  EXPECT_GT(worst, 0.05);
  EXPECT_LT(worst, 0.75);
}

// On a grid ties are everywhere: no sample may need an exact sum there, or drawing becomes slow.
TEST(EdgeFunctions, RoundNothingOnAGrid) {
  for (const int side : {16, 1'024, kMaxSize}) {
    const State state = small_state(side, side);
    const SampleFrame frame = sample_frame(state, draw_bounds(state, {side, side, 16}), 16);
    const auto extent = static_cast<float>(side);
    const Corners corners{at(state, 0.25F, 3.5F), at(state, extent - 0.75F, 8),
                          at(state, 7.5F, extent)};
    for (const EdgeFunction& edge : edge_functions(corners, 1, frame, 1)) EXPECT_EQ(edge.band, 0);
  }
}

// The smallest and the largest products: W = H = 2^-149 makes T = 2^-298.
TEST(EdgeFunctions, NeitherUnderflowNorOverflow) {
  constexpr float kLeast = 0x1p-149F;
  constexpr float kMost = 0x1.fffffep127F;
  for (const float size : {kLeast, kMost, -kMost}) {
    for (const float origin : {0.5F, kLeast, -kMost, kMost}) {
      State state;
      state.viewport = {{origin, origin}, {size, size}, 0, 1};
      const DrawBounds bounds = draw_bounds(state, {kMaxSize, kMaxSize, 4});
      const SampleFrame frame = sample_frame(state, bounds, 4);
      for (const float unit : {kLeast, kMost}) {
        const Corners corners{
            glm::vec4{unit, 0, 0, unit}, {-unit, unit, 0, unit}, {-kLeast, -unit, 0, kLeast}};
        const EdgeFunctions edges = edge_functions(corners, 1, frame, 1);
        for (const SampleOffset& at : {SampleOffset{0.5, 0.5}, SampleOffset{16'383.125, 0.125}}) {
          const auto exact = exact_weights(corners, 1, state, at.x, at.y);
          for (std::size_t e = 0; e < 3; ++e) expect_sample(edges[e], frame, at, exact[e]);
        }
      }
    }
  }
}

/// True if the fill rule gives a zero to an edge with this inward normal in the displayed window:
/// always if the normal points right; straight down for top-left, straight up for bottom-left.
bool owns_by_hand(int right, int down, FillRule rule) {
  if (right != 0) return right > 0;
  return rule == FillRule::top_left ? down > 0 : down < 0;
}

TEST(OwnsZero, IsTheFillRuleAsDisplayed) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    for (const FillRule rule : {FillRule::top_left, FillRule::bottom_left}) {
      const bool v_points_down = convention != Convention::opengl;
      const int tie_sign = (rule == FillRule::top_left) == v_points_down ? 1 : -1;
      for (const auto& [width, height] : {std::array{4.0F, 4.0F}, std::array{-4.0F, 4.0F},
                                          std::array{4.0F, -4.0F}, std::array{-4.0F, -4.0F}}) {
        State state = small_state(4, 4, convention);
        state.viewport.size = {width, height};
        const SampleFrame frame = sample_frame(state, draw_bounds(state, {4, 4, 1}), 1);
        const int turn = convention == Convention::d3d ? -1 : 1;
        for (const auto& [right, down] :
             {std::array{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
          const int b = v_points_down ? down : -down;  // along window v
          EXPECT_EQ(
              owns_zero(width > 0 ? right : -right, turn * (height > 0 ? b : -b), frame, tie_sign),
              owns_by_hand(right, down, rule))
              << right << ", " << down;
        }
      }
    }
  }
}

// The same rule for whole triangles of either orientation: left and top edges under Vulkan's rule.
TEST(OwnsZero, IsAskedOfTheInwardNormal) {
  const State state = small_state(8, 8);
  const SampleFrame frame = sample_frame(state, draw_bounds(state, {8, 8, 1}), 1);
  const Corners clockwise{at(state, 1, 1), at(state, 5, 1), at(state, 1, 5)};
  const Corners turned{clockwise[0], clockwise[2], clockwise[1]};
  const EdgeFunctions edges = edge_functions(clockwise, 1, frame, 1);
  EXPECT_FALSE(edges[0].owns_zero);  // the slope on the right
  EXPECT_TRUE(edges[1].owns_zero);   // left
  EXPECT_TRUE(edges[2].owns_zero);   // top
  const EdgeFunctions others = edge_functions(turned, -1, frame, 1);
  EXPECT_FALSE(others[0].owns_zero);
  EXPECT_TRUE(others[1].owns_zero);
  EXPECT_TRUE(others[2].owns_zero);
}

}  // namespace
}  // namespace rastercheck::rasterizer::edge_functions_test
