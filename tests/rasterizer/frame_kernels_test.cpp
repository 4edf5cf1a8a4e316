// The drawings of the kernels for frames (rasterizer/internal/kernel_setting.h): triangles of all
// sizes compared with a tile's, on and off the grid, behind the eye, cut by depth planes; several
// samples; snapped vertices. Each sample is what its fragments leave, bit for bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "rasterizer/internal/kernel_setting.h"
#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/kept_frame.h"
#include "tests/rasterizer/random_draw.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer::frame_kernels_test {
namespace {

State random_kernel_state(Random& random, const TargetSize& size) {
  State state;
  state.convention = random.pick({Convention::opengl, Convention::vulkan, Convention::d3d});
  state.fill_rule = random.pick({FillRule::top_left, FillRule::bottom_left});
  state.cull = random.pick({Cull::none, Cull::none, Cull::none, Cull::back, Cull::front});
  state.depth_clamp = random.one_in(3);
  state.depth_test = random.one_in(4) ? DepthTest::always : DepthTest::less;
  state.precision = random.pick({Precision::float64, Precision::float32});
  const ViewportKind kind = random.pick(
      {ViewportKind::plain, ViewportKind::plain, ViewportKind::on_a_grid, ViewportKind::mirrored});
  state.viewport = random_viewport(random, kind, size);
  // In about half of the states all attributes are smooth, because separate kernels draw these.
  const bool is_mixed = random.one_in(2);
  using I = Interpolation;
  for (int i = random.between(0, 5); i > 0; --i) {
    const I any = random.pick({I::smooth, I::noperspective, I::flat});
    state.attributes.push_back({is_mixed ? any : I::smooth, Location::sample});
  }
  if (random.one_in(3)) {
    constexpr int kLeastKernelBits = 4;
    state.snapping = Snapping{random.between(kLeastKernelBits, kMostKernelBits)};
    state.basis = Basis::snapped;
  }
  return state;
}

/// A triangle with this `extent` in NDC; its numbers are multiples of `grain`, or any numbers if
/// `grain` is 0.
std::array<glm::vec4, 3> random_triangle(Random& random, float extent, float grain) {
  const auto held = [grain](float x) { return grain > 0 ? std::round(x / grain) * grain : x; };
  const auto within = [&random](float size) {
    return static_cast<float>(random.between(-1'000, 1'000)) / 1'000 * size;
  };
  const glm::vec2 middle{within(1.1F), within(1.1F)};
  const float w = random.one_in(2) ? 1 : 0.5F + std::abs(within(4));
  std::array<glm::vec4, 3> p;
  for (glm::vec4& q : p) {
    const float own_w = random.one_in(2) ? w : 0.5F + std::abs(within(4));
    q = {held(middle.x + within(extent)) * own_w, held(middle.y + within(extent)) * own_w,
         std::abs(within(1)) * own_w, own_w};
  }
  return p;
}

/// Moves a vertex behind the eye or beyond a depth plane.
void disturb(Random& random, std::array<glm::vec4, 3>& p) {
  glm::vec4& q = p[static_cast<std::size_t>(random.between(0, 2))];
  switch (random.between(0, 3)) {
    case 0:
      q.w = -q.w;
      break;
    case 1:
      q.z = -q.w;
      break;
    case 2:
      q.z = 2 * q.w;
      break;
    default:
      q.w = 0;
  }
}

SmallMesh random_kernel_mesh(Random& random, const State& state, const TargetSize& size) {
  SmallMesh mesh;
  const int count = random.between(1, 40);
  for (int i = 0; i < count; ++i) {
    // From less than a pixel to the whole target; often with corners at the corners or centres of
    // pixels.
    const float extent =
        random.pick({0.5F, 2.0F, 6.0F, 20.0F, 300.0F}) / static_cast<float>(size.width);
    const float grain = random.one_in(2) ? 0 : 1 / static_cast<float>(size.width);
    std::array<glm::vec4, 3> p = random_triangle(random, extent, grain);
    if (random.one_in(8)) disturb(random, p);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  for (std::size_t i = 0; i < mesh.positions.size() * state.attributes.size(); ++i) {
    mesh.attributes.push_back(random.one_in(16) ? random.any_real() : random.real(-2, 2));
  }
  if (random.one_in(4)) std::fill(mesh.attributes.begin(), mesh.attributes.end(), -0.0F);
  return mesh;
}

class FrameKernels : public testing::TestWithParam<std::int64_t> {};
INSTANTIATE_TEST_SUITE_P(AllTargets, FrameKernels, testing::ValuesIn(all_targets()), target_name);

// Kills: a lane's values in another lane; samples on a box's border; interpolation at a vertex's
// sample; ties on the wrong side; depth planes or horizons left out; grid points rounded in the
// wrong direction.
TEST_P(FrameKernels, LeaveWhatFragmentsLeave) {
  const OnTarget on_target(GetParam());
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    TargetSize size{random.pick({64, 80, 128, 100}), random.pick({64, 33, 70}), 1};
    if (random.one_in(3)) size.samples = random.pick({2, 4, 8});
    const State state = random_kernel_state(random, size);
    const SmallMesh mesh = random_kernel_mesh(random, state, size);
    const DrawSetting setting(state, size);
    if (size.samples == 1) {
      ASSERT_TRUE(kernel_setting(setting, 2));
    }
    expect_kept(state, mesh.mesh(), size);
    if (HasFatalFailure()) return;
  }
}

/// Right triangles with legs along the axes, all at one depth; triangle i has the attribute i + 1.
SmallMesh right_triangles(const State& state, const std::vector<std::array<float, 3>>& all) {
  SmallMesh mesh;
  for (const auto& [u, v, leg] : all) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec2& p : {glm::vec2{u, v}, {u + leg, v}, {u, v + leg}}) {
      mesh.positions.push_back(at(state, p.x, p.y, 1, 0.5F));
      mesh.attributes.push_back(static_cast<float>(mesh.triangles.size() + 1));
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

// Kills: all fragments of small triangles put before, or after, those of larger ones.
TEST(FrameKernels, KeepTheOrderOfSmallAndLarge) {
  State state = small_state(64, 64);
  state.attributes.resize(1);
  for (const DepthTest test : {DepthTest::always, DepthTest::less}) {
    for (const int samples : {1, 2, 4, 16}) {
      SCOPED_TRACE(samples);
      state.depth_test = test;
      const SmallMesh mesh = right_triangles(
          state, {{10, 10, 5}, {0, 0, 63}, {20, 20, 5}, {9, 9, 5}, {1, 1, 40}, {2, 2, 3}});
      expect_kept(state, mesh.mesh(), {64, 64, samples});
      if (HasFatalFailure()) return;
    }
  }
}

// Kills: a greatest depth that is wrong because of a NaN.
TEST(FrameKernels, SeePastNaNs) {
  const State state = [] {
    State made = small_state(64, 64);
    made.depth_test = DepthTest::less;
    made.attributes.resize(1);
    return made;
  }();
  const SmallMesh mesh = right_triangles(state, {{0, 0, 63}, {-70, -70, 300}});
  Picture framebuffer;
  ASSERT_FALSE(clear(framebuffer, {64, 64, 1}, 1, 0.1F));
  framebuffer.depth[0] = 1;
  for (const std::size_t i : {8U, 16U, 32U, 48U}) {
    framebuffer.depth[i] = std::numeric_limits<float>::quiet_NaN();
  }
  const Picture expected = kept(state, mesh.mesh(), framebuffer);
  ASSERT_FALSE(draw(state, mesh.mesh(), framebuffer).error);
  expect_equal(framebuffer, expected);
  EXPECT_EQ(framebuffer.depth[0], 0.5F);
}

// Kills: values converted to another format and back; a zero whose sign depends on the processor.
TEST(FrameKernels, CopyBitsAndKeepZeros) {
  State state = small_state(64, 64);
  state.attributes = {{Interpolation::flat, Location::sample}};
  state.viewport.min_depth = -0.0F;
  for (const std::uint32_t bits : {0x7f800001U, 0xff800001U, 0x7f800000U, 0x80000000U, 1U}) {
    SmallMesh mesh = right_triangles(state, {{10.5F, 10.5F, 50}, {3.5F, 3.5F, 4}});
    for (glm::vec4& p : mesh.positions) p.z = 0;
    for (float& value : mesh.attributes) value = std::bit_cast<float>(bits);
    expect_kept(state, mesh.mesh(), {64, 64, 1});
  }
}

// Kills: kernels used for states that they do not support.
TEST(FrameKernels, DrawWhatTheyAreMadeFor) {
  const auto is_drawn = [](const State& state, const TargetSize& size) {
    return kernel_setting(DrawSetting(state, size), 1).has_value();
  };
  const State plain = small_state(8, 8);
  EXPECT_TRUE(is_drawn(plain, {8, 8, 1}));
  EXPECT_TRUE(is_drawn(plain, {8, 8, 16}));
  State state = plain;
  state.clip_distance_count = 1;
  EXPECT_FALSE(is_drawn(state, {8, 8, 1}));
  state = plain;
  state.viewport.origin.x = 0.1F;
  EXPECT_FALSE(is_drawn(state, {8, 8, 1}));
  state = plain;
  state.viewport.size.x = 7.5F;  // cuts through pixels
  EXPECT_TRUE(is_drawn(state, {8, 8, 1}));
  EXPECT_FALSE(is_drawn(state, {8, 8, 4}));
  state = plain;
  state.attributes = {{Interpolation::smooth, Location::centroid}};
  EXPECT_TRUE(is_drawn(state, {8, 8, 1}));
  EXPECT_FALSE(is_drawn(state, {8, 8, 4}));
  state = plain;
  state.snapping = Snapping{8};
  EXPECT_FALSE(is_drawn(state, {8, 8, 1}));
  state.basis = Basis::snapped;
  EXPECT_TRUE(is_drawn(state, {8, 8, 1}));
  state.snapping = Snapping{kMostKernelBits + 1};
  EXPECT_FALSE(is_drawn(state, {8, 8, 1}));
  state.snapping = Snapping{3};
  EXPECT_FALSE(is_drawn(state, {8, 8, 1}));
  state.snapping = Snapping{8, Rounding::half_up};
  EXPECT_FALSE(is_drawn(state, {8, 8, 1}));
}

}  // namespace
}  // namespace rastercheck::rasterizer::frame_kernels_test
