#include "rasterizer/internal/clip_functionals.h"

#include <gtest/gtest.h>

#include "rasterizer/internal/determinant.h"
#include "tests/rasterizer/exact_frame.h"

namespace rastercheck::rasterizer::clip_functionals_test {
namespace {

/// The functionals of a triangle whose vertices have these z and w and, if any, one clip distance
/// each.
ClipFunctionals functionals_of(const State& state, const std::array<glm::vec2, 3>& zw,
                               const std::array<float, 3>& distances = {}) {
  const Corners corners{
      glm::vec4{0, 0, zw[0].x, zw[0].y}, {1, 0, zw[1].x, zw[1].y}, {0, 1, zw[2].x, zw[2].y}};
  ClipFunctionals out;
  const std::span<const float> all(distances);
  clip_functionals(state, corners, {all.subspan(0, 1), all.subspan(1, 1), all.subspan(2, 1)}, out);
  return out;
}

State state_of(Convention convention, std::size_t distances = 0) {
  State state = small_state(4, 4, convention);
  state.clip_distance_count = distances;
  return state;
}

TEST(ClipFunctionals, AreNoneWhereNothingIsCut) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    const State state = state_of(convention, 1);
    const ClipFunctionals out =
        functionals_of(state, {{{0.5F, 1}, {0.25F, 2}, {1, 3}}}, {1, 2, 0x1p-149F});
    EXPECT_TRUE(out.all.empty());
    EXPECT_FALSE(out.hides_all);
  }
}

// Kills: Vulkan's near plane used for OpenGL; near and far planes exchanged.
TEST(ClipFunctionals, NearAndFarAreTheConventions) {
  const std::array<glm::vec2, 3> behind_zero{{{-0.5F, 1}, {0.5F, 1}, {0.5F, 1}}};
  EXPECT_TRUE(functionals_of(state_of(Convention::opengl), behind_zero).all.empty());
  EXPECT_EQ(functionals_of(state_of(Convention::vulkan), behind_zero).all.size(), 1U);
  EXPECT_EQ(functionals_of(state_of(Convention::d3d), behind_zero).all.size(), 1U);
  const std::array<glm::vec2, 3> beyond_far{{{1.5F, 1}, {0.5F, 1}, {0.5F, 1}}};
  const std::array<glm::vec2, 3> beyond_both{{{-2, 1}, {2, 1}, {0.5F, 1}}};
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    EXPECT_EQ(functionals_of(state_of(convention), beyond_far).all.size(), 1U);
    EXPECT_EQ(functionals_of(state_of(convention), beyond_both).all.size(), 2U);
    State clamped = state_of(convention);
    clamped.depth_clamp = true;
    EXPECT_TRUE(functionals_of(clamped, beyond_both).all.empty());
  }
}

TEST(ClipFunctionals, HideWhatIsWhollyBeyondAPlane) {
  const State state = state_of(Convention::vulkan, 1);
  const std::array<glm::vec2, 3> between{{{0.5F, 1}, {0.5F, 1}, {0.5F, 1}}};
  EXPECT_TRUE(functionals_of(state, {{{2, 1}, {3, 1}, {1.5F, 1}}}, {1, 1, 1}).hides_all);
  EXPECT_TRUE(functionals_of(state, {{{-1, 1}, {-2, 1}, {-0x1p-149F, 1}}}, {1, 1, 1}).hides_all);
  EXPECT_TRUE(functionals_of(state, between, {-1, -2, -0x1p-149F}).hides_all);
  EXPECT_FALSE(functionals_of(state, between, {-1, -2, 0}).hides_all);
  EXPECT_FALSE(functionals_of(state, between, {-1, -2, 1}).hides_all);
}

// A distance that is zero at all vertices is inside everywhere, under every rule. One that is zero
// at some vertices and positive at the others cuts nothing only where zero counts as inside
// (Direct3D).
TEST(ClipFunctionals, OfZeroDistances) {
  const std::array<glm::vec2, 3> between{{{0.5F, 1}, {0.5F, 1}, {0.5F, 1}}};
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    const State state = state_of(convention, 1);
    EXPECT_TRUE(functionals_of(state, between, {0, -0.0F, 0}).all.empty());
    EXPECT_EQ(functionals_of(state, between, {0, 1, 1}).all.empty(), convention == Convention::d3d);
  }
}

// First z = w at all vertices, then z one ulp above w, then a w − z that float32 would round.
// Kills: g computed in float32.
TEST(ClipFunctionals, SeeTheSmallestDifferences) {
  const State state = state_of(Convention::opengl);
  EXPECT_TRUE(functionals_of(state, {{{1, 1}, {1, 1}, {1, 1}}}).all.empty());
  EXPECT_TRUE(functionals_of(state, {{{0x1.000002p0F, 1}, {0x1.000002p0F, 1}, {0x1.000002p0F, 1}}})
                  .hides_all);
  // At the first vertex w − z is 2^127 + 2^-149, for which a double needs a tail.
  const ClipFunctionals out = functionals_of(
      state, {{{-0x1p-149F, 0x1p127F}, {0x1p127F, 0x1p127F}, {0x1.8p127F, 0x1p127F}}});
  ASSERT_EQ(out.all.size(), 1U);
  EXPECT_EQ(out.all[0].g[0].value, 0x1p127);
  EXPECT_EQ(out.all[0].g[0].tail, 0x1p-149);
}

/// Decides by the rules, in rational arithmetic, whether a functional keeps a sample. `is_zero`
/// becomes true if the functional is 0 there.
bool is_kept_by_hand(const ClipFunctional& functional, const FramedDraw& draw,
                     const SampleOffset& at, int tie_sign, bool& is_zero) {
  const auto e = exact_weights(draw.corners, draw.orientation, draw.state, at.x, at.y);
  Rational sum = 0;
  std::array<Rational, 2> normal;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational g = Rational(functional.g[i].value) + Rational(functional.g[i].tail);
    const auto k = exact_coefficients(draw.corners, draw.orientation, i);
    sum += g * e[i];
    normal[0] += g * k[0];
    normal[1] += g * k[1];
  }
  is_zero = sum == 0;
  if (!is_zero || functional.is_closed) return sum >= 0;
  // The normal's signs along window u and v.
  const int right = sgn(normal[0]) * (draw.state.viewport.size.x > 0 ? 1 : -1);
  const int turn = draw.state.convention == Convention::d3d ? -1 : 1;
  const int along_v = sgn(normal[1]) * (draw.state.viewport.size.y > 0 ? turn : -turn);
  return right > 0 || (right == 0 && tie_sign * along_v > 0);
}

/// Compares every functional of a draw at a sample with rational arithmetic; returns the number of
/// zeros.
int expect_kept(const FramedDraw& draw, const SampleOffset& at, int tie_sign) {
  const EdgeFunctions edges = edge_functions(draw.corners, draw.orientation, draw.frame, tie_sign);
  ClipFunctionals functionals;
  const std::span<const float> all(draw.mesh.clip_distances);
  const std::size_t count = draw.state.clip_distance_count;
  clip_functionals(
      draw.state, draw.corners,
      {all.subspan(0, count), all.subspan(count, count), all.subspan(2 * count, count)},
      functionals);
  std::array<double, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = edges[i].at(draw.frame, at.x, edges[i].row(draw.frame, at.y));
  }
  int zeros = 0;
  for (const ClipFunctional& functional : functionals.all) {
    bool is_zero = false;
    const bool expected = is_kept_by_hand(functional, draw, at, tie_sign, is_zero);
    zeros += is_zero ? 1 : 0;
    EXPECT_EQ(is_kept(functional, edges, e, draw.frame, at.x, at.y, tie_sign), expected);
  }
  return zeros;
}

// Kills: an error bound that is too small; the edges' bands forgotten; tails dropped from the exact
// sum.
TEST(ClipFunctionals, KeepWhatRationalArithmeticKeeps) {
  Random random(60);
  for (int i = 0; i < 4'000 && !HasFailure(); ++i) {
    const FramedDraw draw = random_framed_draw(random);
    for (int k = 0; k < 3; ++k) {
      expect_kept(draw, random_sample(random, draw.bounds, draw.samples), random.pick({-1, 1}));
    }
  }
}

// Planes through a pixel's centre in all directions, some in a mirrored viewport. Kills: a zero
// decided by the rule for closed functionals, or by a normal of the wrong sign.
TEST(ClipFunctionals, DecideZerosByTheirNormals) {
  Random random(61);
  int zeros = 0;
  for (int i = 0; i < 3'000 && !HasFailure(); ++i) {
    FramedDraw draw;
    draw.state = small_state(
        1'024, 1'024, random.pick({Convention::opengl, Convention::vulkan, Convention::d3d}));
    draw.state.clip_distance_count = 1;
    const SampleOffset at{random.between(0, 1'023) + 0.5, random.between(0, 1'023) + 0.5};
    // With slopes of up to 500, products of distances and weights have more than 53 bits, though
    // each factor is exact.
    const int most = random.pick({2, 500});
    const int along_u = random.between(-most, most);
    const int along_v = random.between(-most, most);
    for (glm::vec4& p : draw.corners) {
      const auto u = static_cast<float>(random.between(-8'000, 16'000)) / 8;
      const auto v = static_cast<float>(random.between(-8'000, 16'000)) / 8;
      p = rasterizer::at(draw.state, u, v, 1, 0.5F);
      draw.mesh.clip_distances.push_back(
          static_cast<float>(along_u * (u - at.x) + along_v * (v - at.y)));
    }
    draw.orientation = determinant_sign(draw.corners[0], draw.corners[1], draw.corners[2]);
    if (draw.orientation == 0) continue;
    if (random.one_in(2)) {  // mirrored, which moves the sample to its mirror image
      draw.state.viewport = {{1'024, 0}, {-1'024, 1'024}, 0, 1};
    }
    const double u = draw.state.viewport.size.x < 0 ? 1'024 - at.x : at.x;
    draw.bounds = draw_bounds(draw.state, {1'024, 1'024, 1});
    draw.frame = sample_frame(draw.state, draw.bounds, 1);
    zeros += expect_kept(draw, {u, at.y}, random.pick({-1, 1}));
  }
  EXPECT_GT(zeros, 1'000);
}

}  // namespace
}  // namespace rastercheck::rasterizer::clip_functionals_test
