// Depths with a bias, as fragments have them: by hand, and against rationals.

#include "rasterizer/internal/depth_bias.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "rasterizer/internal/depth_store.h"
#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/brute_force.h"
#include "tests/rasterizer/kept_frame.h"
#include "tests/rasterizer/random_draw.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::depth_bias_test {
namespace {

constexpr TargetSize kFour{4, 4, 1};
constexpr double kSteps16 = 65535;

State with_bias(State state, const DepthBias& bias, DepthFormat format = DepthFormat::float32) {
  state.depth_bias = bias;
  state.depth_format = format;
  return state;
}

/// The depth at the centre of pixel (x, y).
float depth_at(const State& state, const SmallMesh& mesh, int x, int y = 1) {
  const Fragments fragments = fragments_of(state, mesh, kFour);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (fragments.x[i] == x && fragments.y[i] == y) return fragments.depth[i];
  }
  return NAN;
}

/// Depths 1/16 to 9/16, 1/8 more for each pixel of u; 1/4 at the centres of column 1.
const SmallMesh& eighths() {
  static const SmallMesh mesh = sloping(small_state(4, 4), false, 0.125F, 0.25F);
  return mesh;
}

// Kills: a slope that is not that of the window, or has the sign of the derivative.
TEST(DepthBias, AddsTheSlopeOfTheWindow) {
  const State state = with_bias(small_state(4, 4), {0, 0.5F, 0});
  for (const bool along_v : {false, true}) {
    for (const float slope : {0.125F, -0.125F}) {
      const SmallMesh mesh = sloping(state, along_v, slope, 0.5F);
      EXPECT_EQ(depth_at(state, mesh, 1, 1), 0.5625F);
      EXPECT_EQ(depth_at(with_bias(state, {0, -2, 0}), mesh, 1, 1), 0.25F);
    }
  }
}

// Kills: the root of the sum of squares, or the sum, in place of the greater derivative.
TEST(DepthBias, TakesTheGreaterDerivative) {
  const State state = with_bias(small_state(4, 4), {0, 1, 0});
  SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
  for (glm::vec4& p : mesh.positions) {
    p.z = 0.25F + (2 * p.x + 2) / 8 - (2 * p.y + 2) / 16;  // u/8 − v/16
  }
  EXPECT_EQ(depth_at(state, mesh, 1, 1), 0.25F + 3.0F / 16 - 3.0F / 32 + 0.125F);
}

// Kills: m without the depth range, or without the viewport's size.
TEST(DepthBias, MeasuresTheSlopeOfWindowDepths) {
  State state = with_bias(small_state(4, 4), {0, 1, 0});
  state.viewport.min_depth = 0.75F;
  state.viewport.max_depth = 0.25F;
  // 3/4 − z/2: 5/8 at column 1, and 1/16 less for each pixel
  EXPECT_EQ(depth_at(state, eighths(), 1), 0.625F + 0.0625F);
  State opengl = state;
  opengl.convention = Convention::opengl;
  // 3/4 − (z + 1)/4 = 7/16 at column 1, and 1/32 less for each pixel
  EXPECT_EQ(depth_at(opengl, eighths(), 1), 0.4375F + 0.03125F);
  State wide = with_bias(small_state(8, 4), {0, 1, 0});
  // The same NDC positions twice as far apart: 1/16 for each pixel; u = 1.5 is where it was 0.75.
  EXPECT_EQ(depth_at(wide, eighths(), 1), 0.25F - 0.75F / 8 + 0.0625F);
}

// Kills: an exponent that is not that of the vertices' greatest depth.
TEST(DepthBias, CountsInUnitsOfTheGreatestVertexDepth) {
  const State state = with_bias(small_state(4, 4), {0x1p20F, 0, 0});
  // The triangles have corners at 9/16, so that e = −1 and r = 2^-24.
  EXPECT_EQ(depth_at(state, eighths(), 1), 0.25F + 0x1p-4F);
  SmallMesh level = rectangle(state, {0, 0}, {4, 4});
  const auto drawn = [&](float depth, const State& by) {
    for (glm::vec4& p : level.positions) p.z = depth;
    return depth_at(by, level, 1);
  };
  EXPECT_EQ(drawn(0.5F, state), 0.5F + 0x1p-4F);
  const float below = std::nextafter(0.5F, 0.0F);
  EXPECT_EQ(drawn(below, state), static_cast<float>(double{below} + 0x1p-5));
  EXPECT_EQ(drawn(0, state), 0);
  State opengl = state;
  opengl.convention = Convention::opengl;
  EXPECT_EQ(drawn(0, opengl), 0.5F + 0x1p-4F);
  // Depths below 1/2 by less than double can tell: (1 − 2^-60)/2.
  EXPECT_EQ(drawn(-0x1p-60F, opengl), 0.5F + 0x1p-5F);
  State clamped = with_bias(state, {-0x1p20F, 0, 0});
  clamped.depth_clamp = true;
  EXPECT_EQ(drawn(8, clamped), 1);  // 8 − 2^-3: the clamp comes last
  // 1 + 2^-3 − 2^-3: e = 0, as the vertices count as clamped to 1.
  EXPECT_EQ(drawn(0.5F, with_bias(clamped, {-0x1p18F, 0, 0})), 0.5F - 0x1p-6F);
  EXPECT_EQ(drawn(1.0625F, clamped), 0.9375F);
}

// Kills: vertices with w <= 0 that are left out, or divided.
TEST(DepthBias, AVertexBehindTheEyeCountsAsTheGreaterEnd) {
  State state = with_bias(small_state(4, 4), {0x1p20F, 0, 0});
  state.viewport.min_depth = 0.75F;
  state.viewport.max_depth = 0.125F;
  SmallMesh mesh;
  // z = w: the far end, 1/8, everywhere. In front of the eye e = −3 and r = 2^-26.
  mesh.positions = {{-1, -1, 1, 1}, {7, -1, 1, 1}, {-1, 7, 1, 1}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(depth_at(state, mesh, 1), 0.125F + 0x1p-6F);
  for (const float w : {-1.0F, 0.0F}) {
    mesh.positions[1] = {7, 0, w, w};
    EXPECT_EQ(depth_at(state, mesh, 1), 0.125F + 0x1p-4F) << w;  // e = −1
  }
}

// Kills: a unit of a unorm format that is that of another rule.
TEST(DepthBias, CountsInUnitsOfTheFormat) {
  const auto drawn = [](Convention convention, DepthFormat format, float constant) {
    State state = with_bias(small_state(4, 4, convention), {constant, 0, 0}, format);
    SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
    if (convention == Convention::opengl) {
      for (glm::vec4& p : mesh.positions) p.z = -p.w;
    }
    return double{depth_at(state, mesh, 1)};
  };
  using C = Convention;
  for (const C convention : {C::vulkan, C::opengl}) {
    // 2^15/2^16 · 65535 = 32767.5 and 3/2^16 · 65535 = 3 − 3/65536
    EXPECT_NEAR(drawn(convention, DepthFormat::unorm16, 0x1p15F) * kSteps16, 32767.5, 0.51);
    EXPECT_EQ(drawn(convention, DepthFormat::unorm16, 0xf000), float(61439 / kSteps16));
    EXPECT_EQ(drawn(convention, DepthFormat::unorm24, 3), float(3 / 16777215.0));
  }
  // float32(1/65535) = (1 + 2^-16) 2^-16, and times 65535 a little less than 1
  EXPECT_EQ(drawn(C::d3d, DepthFormat::unorm16, 0xf000), float(61440 / kSteps16));
  EXPECT_EQ(drawn(C::d3d, DepthFormat::unorm24, 3), float(3 / 16777215.0));
}

// Kills: a clamp of the other side; a clamp of the bias's terms, or of the depth.
TEST(DepthBias, ClampsTheOffsetOnItsSide) {
  const auto drawn = [](float slope, float clamp) {
    return depth_at(with_bias(small_state(4, 4), {0, slope, clamp}), eighths(), 1);
  };
  EXPECT_EQ(drawn(1, 0.0625F), 0.3125F);
  EXPECT_EQ(drawn(1, 0.5F), 0.375F);
  EXPECT_EQ(drawn(-1, 0.0625F), 0.125F);
  EXPECT_EQ(drawn(-1, -0.0625F), 0.1875F);
  EXPECT_EQ(drawn(-1, -0.5F), 0.125F);
  EXPECT_EQ(drawn(1, -0.0625F), 0.375F);
  // Terms of 2^100 are clamped where double is not asked.
  EXPECT_EQ(drawn(0x1p100F, 0.0625F), 0.3125F);
  EXPECT_EQ(drawn(-0x1p100F, -0.0625F), 0.1875F);
  // Nothing is added: the clamp means nothing.
  EXPECT_EQ(drawn(0, 0.0625F), 0.25F);
}

// Kills: a sum that is clamped to another range, or not at all.
TEST(DepthBias, ClampsTheSum) {
  for (const DepthFormat format : {DepthFormat::float32, DepthFormat::unorm24}) {
    State state = with_bias(small_state(4, 4), {0, 0x1p6F, 0}, format);
    state.viewport.min_depth = 0.25F;
    state.viewport.max_depth = 0.75F;
    const float quarter = stored_depth(format, 0.25F);
    const float three_quarters = stored_depth(format, 0.75F);
    const State down = with_bias(state, {0, -0x1p6F, 0}, format);
    EXPECT_EQ(depth_at(state, eighths(), 1), 1);
    EXPECT_EQ(depth_at(down, eighths(), 1), 0);
    for (const bool is_d3d : {false, true}) {
      const auto limited = [&](State by) {
        by.depth_clamp = !is_d3d;
        if (is_d3d) by.convention = Convention::d3d;
        return depth_at(by, eighths(), 1);
      };
      EXPECT_EQ(limited(state), three_quarters);
      EXPECT_EQ(limited(down), quarter);
    }
  }
}

// With w from 1 to 4 and z = 1/4, depth is 1/(4 w), which is linear in the window.
TEST(DepthBias, InfiniteReversedProjectionsHaveSlopes) {
  const State state = with_bias(small_state(4, 4), {0x1p20F, -1, 0});
  SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
  for (glm::vec4& p : mesh.positions) p = at(state, 2 * p.x + 2, 2 * p.y + 2, p.x < 0 ? 1 : 4, 0);
  for (glm::vec4& p : mesh.positions) p.z = 0.25F;
  // Depths 1/4 to 1/16: 3/64 less for each pixel, r = 2^-25.
  EXPECT_EQ(depth_at(state, mesh, 1), 0.25F - 1.5F * 0.046875F - 0.046875F + 0x1p-5F);
  for (glm::vec4& p : mesh.positions) p.z = 0x1p-6F;
  EXPECT_EQ(depth_at(state, mesh, 1), (0.25F - 2.5F * 0.046875F) / 16 + 0x1p-9F);
}

// Kills: offsets whose terms cancel in double. z_x = 1/8.
TEST(DepthBias, KeepsWhatIsLeftOfTermsThatCancel) {
  // 2^20 + 2^-3 − 2^20
  const State state =
      with_bias(small_state(4, 4), {-0x1p36F, 0x1p23F + 1, 0}, DepthFormat::unorm16);
  EXPECT_EQ(depth_at(state, eighths(), 1), stored_depth(DepthFormat::unorm16, 0.375F));
}

// Kills: depths far beyond the range that are rounded, or clamped, before an offset brings them
// back.
TEST(DepthBias, BringsDepthsBack) {
  for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24}) {
    const int bits = format == DepthFormat::unorm16 ? 16 : 24;
    State state = with_bias(small_state(4, 4), {-std::ldexp(1.0F, 20 + bits), 0, 0}, format);
    state.depth_clamp = true;
    SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
    for (glm::vec4& p : mesh.positions) p.z = 0x1p20F + 0.25F;
    EXPECT_EQ(depth_at(state, mesh, 1), stored_depth(format, 0.25F));
    for (glm::vec4& p : mesh.positions) p = p * 3.0F;  // z/w needs a division
    EXPECT_EQ(depth_at(state, mesh, 1), stored_depth(format, 0.25F));
    for (glm::vec4& p : mesh.positions) p = p / 3.0F;
    for (glm::vec4& p : mesh.positions) p.z = 0x1p20F + (p.x < 0 ? 0.0F : 0.5F);
    EXPECT_EQ(depth_at(state, mesh, 1), stored_depth(format, 0.1875F));
  }
}

// Kills: a tie that is decided by 2^-b steps elsewhere than between the two.
TEST(UnormDepth, StoresAHalfAsANeighbour) {
  State state = small_state(4, 4);
  state.depth_format = DepthFormat::unorm16;
  SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
  for (glm::vec4& p : mesh.positions) p.z = 0.5F;
  const double steps = depth_at(state, mesh, 1) * kSteps16;
  EXPECT_NEAR(std::abs(steps - 32767.5), 0.5, 0x1p-7);
}

// Kills: a depth test on depths before they are stored; a later fragment that replaces its equal.
TEST(UnormDepth, IsWhatTheDepthTestCompares) {
  for (const DepthFormat format : {DepthFormat::float32, DepthFormat::unorm16}) {
    State state = small_state(4, 4);
    state.depth_format = format;
    state.depth_test = DepthTest::less;
    state.attributes.resize(1);
    SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
    for (glm::vec4& p : mesh.positions) p.z = 0.25F;
    const SmallMesh nearer = rectangle(state, {0, 0}, {4, 4});
    for (const glm::vec4& p : nearer.positions) {
      mesh.positions.push_back(p);
      mesh.positions.back().z = 0.25F - 0x1p-20F;  // less than a step of 16 bits
    }
    mesh.triangles.insert(mesh.triangles.end(), {{4, 5, 6}, {4, 6, 7}});
    mesh.attributes = {1, 1, 1, 1, 2, 2, 2, 2};
    Picture drawn;
    ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), kFour, 1, drawn).error);
    EXPECT_EQ(drawn.attributes[0], format == DepthFormat::float32 ? 2 : 1);
    EXPECT_EQ(drawn.depth[0],
              format == DepthFormat::float32 ? 0.25F - 0x1p-20F : float(16384 / kSteps16));
    expect_kept(state, mesh.mesh(), kFour);
  }
}

/// `drawn` is the stored depth of a sample, `exact` that before it is stored.
void expect_within_bound(const State& state, float drawn, const Rational& exact) {
  const Rational bound = Rational(1, 2) + power_of_two(-7);
  const double steps = depth_steps(state.depth_format);
  if (steps == 0) {
    const Rational scale = std::max(state.viewport.min_depth, state.viewport.max_depth);
    const Rational error = abs(Rational(drawn) - exact);
    ASSERT_LE(error, bound * float_ulp(std::max(exact, scale))) << exact.get_d();
    return;
  }
  const double k = std::round(double{drawn} * steps);
  ASSERT_EQ(drawn, static_cast<float>(k / steps));
  ASSERT_LE(abs(Rational(k) - exact * Rational(steps)), bound) << exact.get_d();
}

DepthBias random_bias(Random& random) {
  DepthBias bias;
  bias.constant = random.pick({0.0F, 1.0F, -3.0F, random.real(-4, 24), random.any_real()});
  bias.slope = random.pick({0.0F, 1.0F, -2.0F, random.real(-6, 6), random.any_real()});
  bias.clamp = random.pick({0.0F, 0.0F, 0x1p-10F, -0x1p-10F, random.any_real()});
  return bias;
}

// Kills: an offset that is not certain and is trusted; a bound that is not kept; a step that is not
// the nearest.
TEST(DepthBias, RandomDepthsAreWithinTheBound) {
  Random random(2029);
  int checked = 0;
  for (int i = 0; i < 6'000; ++i) {
    SCOPED_TRACE(i);
    RandomDraw draw = random_draw(random);
    draw.state.depth_bias = random_bias(random);
    using F = DepthFormat;
    draw.state.depth_format = random.pick({F::float32, F::unorm16, F::unorm24});
    const BruteForce exact(draw.state, draw.mesh, draw.mesh.triangles[0]);
    if (draw.state.depth_format == F::float32 && draw.state.depth_bias.is_none()) continue;
    const auto pattern = brute_force_pattern(draw.size.samples);
    const Fragments fragments = fragments_of(draw.state, draw.mesh, draw.size);
    for (std::size_t f = 0; f < fragments.size(); f += 1 + fragments.size() / 16) {
      const auto& at = pattern[fragments.sample[f]];
      const Rational depth =
          exact.biased_depth(Rational(fragments.x[f]) + at[0], Rational(fragments.y[f]) + at[1]);
      ++checked;
      expect_within_bound(draw.state, fragments.depth[f], depth);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(checked, 3'000);
}

/// A state with numbers that double does not hold, for depths of 24 bits.
State odd_state(Random& random) {
  State state = small_state(16, 16, random.pick({Convention::opengl, Convention::vulkan}));
  state.viewport.origin = {0.3F, 0.7F};
  state.viewport.size = {13.7F, 12.9F};
  state.viewport.min_depth = random.pick({0.0F, 0.1F, 0.9F});
  state.viewport.max_depth = random.pick({1.0F, 0.7F});
  state.depth_format = DepthFormat::unorm24;
  return state;
}

/// A triangle with random w, and z/w of that size.
SmallMesh odd_triangle(Random& random, float size) {
  SmallMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  for (int i = 0; i < 3; ++i) {
    const float w = 0.5F + std::abs(random.real(-3, 0));
    const float z = w * size * (0.1F + std::abs(random.real(-3, -2)));
    mesh.positions.emplace_back(w * random.real(-2, 0), w * random.real(-2, 0), z, w);
  }
  return mesh;
}

/// Expects the bound of the triangle's samples. Returns how many depths no limit decides.
int expect_samples_within_bound(const State& state, const SmallMesh& mesh,
                                const BruteForce& exact) {
  int between = 0;
  const auto [least, greatest] = std::minmax(state.viewport.min_depth, state.viewport.max_depth);
  const Fragments fragments = fragments_of(state, mesh, {16, 16, 1});
  for (std::size_t f = 0; f < fragments.size(); f += 1 + fragments.size() / 16) {
    const Rational half(1, 2);
    const Rational depth =
        exact.biased_depth(Rational(fragments.x[f]) + half, Rational(fragments.y[f]) + half);
    if (depth > least && depth < greatest) ++between;
    expect_within_bound(state, fragments.depth[f], depth);
    if (testing::Test::HasFatalFailure()) break;
  }
  return between;
}

/// constant such that about 1/2 is left of the sum of `terms` and r · constant.
float constant_against(const Rational& terms) {
  return static_cast<float>(Rational((Rational(1, 2) - terms) * power_of_two(24)).get_d());
}

// Kills: an offset in double whose terms are 2^23 times the depth.
TEST(DepthBias, KeepsWhatIsLeftOfRandomTermsThatCancel) {
  Random random(2030);
  int between = 0;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    State state = odd_state(random);
    const SmallMesh mesh = odd_triangle(random, 1);
    const BruteForce exact(state, mesh, mesh.triangles[0]);
    if (exact.is_degenerate() || exact.steepness() == 0) continue;
    state.depth_bias.slope = static_cast<float>(
        Rational(power_of_two(random.between(18, 23)) / exact.steepness()).get_d());
    state.depth_bias.constant =
        constant_against(Rational(state.depth_bias.slope) * exact.steepness());
    between += expect_samples_within_bound(state, mesh, exact);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(between, 1000);
}

// Kills: a level depth that is rounded before the offset brings it back. Pixels would show this
// only where depths are as far as 2^24.
TEST(DepthBias, SumsLevelDepthsThatOffsetsBringBack) {
  Random random(2032);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    State state = odd_state(random);
    state.depth_bias.constant = 1;
    const BiasTerms bias = bias_terms(state);
    const double z = random.real(0, 30);
    const double w = std::abs(random.real(-3, 3)) + 0.125;
    const bool is_opengl = state.convention == Convention::opengl;
    const Rational share = is_opengl ? Rational((Rational(z) / Rational(w) + 1) / 2)
                                     : Rational(Rational(z) / Rational(w));
    const Rational near = state.viewport.min_depth;
    const Rational depth = near + (Rational(state.viewport.max_depth) - near) * share;
    DepthOffset offset;
    offset.value = 0.5 - depth.get_d();
    const Rational exact = depth + Rational(offset.value);
    const Rational error = abs(Rational(deep_level_depth(bias, offset, z, w)) - exact);
    ASSERT_LE(error, power_of_two(-51) * abs(exact));
  }
}

// Kills: depths of 2^22 that lose digits before an offset of as much brings them back.
TEST(DepthBias, BringsRandomDepthsBack) {
  Random random(2031);
  int between = 0;
  for (int i = 0; i < 4000; ++i) {
    SCOPED_TRACE(i);
    State state = odd_state(random);
    state.depth_clamp = true;
    const float size = std::ldexp(1.0F, random.between(21, 23));
    SmallMesh mesh = odd_triangle(random, size);
    if (random.one_in(2)) {  // one depth
      mesh.positions[0].z = mesh.positions[0].w * size * (1 - std::abs(random.real(-3, -2)));
      mesh.positions[1] = mesh.positions[0] * 0.5F + glm::vec4{1, 0, 0, 0};
      mesh.positions[2] = mesh.positions[0] * 2.0F + glm::vec4{0, 1, 0, 0};
    } else {  // depths of size to size + 2
      for (glm::vec4& p : mesh.positions) {
        p.w = random.pick({0.5F, 1.0F, 2.0F});
        p.z = (size + static_cast<float>(random.between(0, 4)) / 2) * p.w;
      }
    }
    const BruteForce exact(state, mesh, mesh.triangles[0]);
    if (exact.is_degenerate()) continue;
    if (random.one_in(2)) state.depth_bias.slope = random.real(-3, 0);
    state.depth_bias.constant = constant_against(
        exact.plane_depth(7, 7) + Rational(state.depth_bias.slope) * exact.steepness());
    between += expect_samples_within_bound(state, mesh, exact);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(between, 500);
}

}  // namespace
}  // namespace rastercheck::rasterizer::depth_bias_test
