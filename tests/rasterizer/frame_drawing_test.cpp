// Draws into framebuffers, tile by tile: each sample ends up as its fragments, in order, leave it.

#include "rasterizer/internal/frame_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/kept_frame.h"
#include "tests/rasterizer/random_draw.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer::frame_drawing_test {
namespace {

/// A mesh of many triangles of all sizes; some share vertices.
SmallMesh many_triangles(Random& random, const State& state, int count) {
  SmallMesh mesh;
  for (int i = 0; i < count; ++i) {
    const SmallMesh one = random_mesh(random, state);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), one.positions.begin(), one.positions.end());
    mesh.attributes.insert(mesh.attributes.end(), one.attributes.begin(), one.attributes.end());
    mesh.clip_distances.insert(mesh.clip_distances.end(), one.clip_distances.begin(),
                               one.clip_distances.end());
    for (const glm::uvec3& t : one.triangles) mesh.triangles.push_back(t + first);
  }
  return mesh;
}

/// A state for which frames have their own kernels: all attributes smooth, or a few of each kind.
State frame_state(Random& random, const TargetSize& size) {
  State state = small_state(size.width, size.height,
                            random.pick({Convention::opengl, Convention::vulkan, Convention::d3d}));
  state.depth_test = random.one_in(3) ? DepthTest::always : DepthTest::less;
  state.attributes.resize(static_cast<std::size_t>(random.pick({0, 1, 2, 2, 3, 4})));
  if (random.one_in(2)) return state;
  for (Qualifier& qualifier : state.attributes) {
    qualifier.interpolation =
        random.pick({Interpolation::smooth, Interpolation::noperspective, Interpolation::flat});
  }
  return state;
}

/// Triangles with these corners, and values of all sizes.
SmallMesh with_values(Random& random, const State& state, std::vector<glm::vec4> positions) {
  SmallMesh mesh;
  mesh.positions = std::move(positions);
  for (std::uint32_t i = 0; i < mesh.positions.size(); i += 3) {
    mesh.triangles.emplace_back(i, i + 1, i + 2);
  }
  for (std::size_t i = 0; i < mesh.positions.size() * state.attributes.size(); ++i) {
    mesh.attributes.push_back(random.one_in(8) ? random.any_real() : random.real(-2, 2));
  }
  return mesh;
}

/// Widths and heights just below and above one and two tiles.
TargetSize random_size(Random& random, int samples) {
  const auto side = [&random] { return random.pick({1, 7, 63, 64, 65, 100, 128, 129, 150}); };
  const int width = side();
  const int height = side();
  return {width, height, samples};
}

class DrawOnTarget : public testing::TestWithParam<std::int64_t> {};
INSTANTIATE_TEST_SUITE_P(AllTargets, DrawOnTarget, testing::ValuesIn(all_targets()), target_name);

// Kills: a tile's border that is off by one; a lost last lane; a race; values that depend on the
// tile.
TEST_P(DrawOnTarget, LeavesWhatItsFragmentsLeave) {
  const OnTarget on_target(GetParam());
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    SCOPED_TRACE(i);
    RandomDraw draw = random_draw(random);
    draw.size = random_size(random, draw.size.samples);
    draw.state.scissor = {{0, 0}, {kMaxSize, kMaxSize}};
    draw.state.viewport =
        random_viewport(random, i % 2 == 0 ? ViewportKind::plain : ViewportKind::any, draw.size);
    draw.state.depth_test = i % 3 == 0 ? DepthTest::always : DepthTest::less;
    draw.mesh = many_triangles(random, draw.state, 12);
    expect_kept(draw.state, draw.mesh.mesh(), draw.size);
    if (HasFatalFailure()) return;
  }
}

/// A corner on the grid of half pixels, at samples, between samples or on borders of tiles; within
/// `reach` half pixels of `near`, or anywhere.
glm::vec4 grid_corner(Random& random, const State& state, const TargetSize& size, glm::vec2 near,
                      int reach) {
  const auto coordinate = [&](float from, int side) {
    if (random.one_in(16)) return random.pick({0.0F, 64.0F, 63.5F, 64.5F, 128.0F});
    if (reach == 0) return static_cast<float>(random.between(-8, 2 * side + 8)) / 2;
    return from + static_cast<float>(random.between(-reach, reach)) / 2;
  };
  const float u = coordinate(near.x, size.width);
  const float v = coordinate(near.y, size.height);
  return at(state, u, v, random.pick({1.0F, 1.0F, 0.5F, 4.0F}),
            static_cast<float>(random.between(0, 8)) / 8);
}

// Kills: vertex values that are interpolated; ties lost or taken by one of the kernels; small
// triangles drawn after large ones of the same depth.
TEST_P(DrawOnTarget, LeavesOnTheGridWhatItsFragmentsLeave) {
  const OnTarget on_target(GetParam());
  Random random(8);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const TargetSize size{random.pick({64, 128}), random.pick({64, 128}), 1};
    const State state = frame_state(random, size);
    std::vector<glm::vec4> corners;
    for (int triangle = 0; triangle < 150; ++triangle) {
      const int reach = random.pick({0, 4, 7, 12});
      const glm::vec2 near{random.between(0, size.width), random.between(0, size.height)};
      const bool is_level = random.one_in(2);
      for (int corner = 0; corner < 3; ++corner) {
        corners.push_back(grid_corner(random, state, size, near, reach));
        if (is_level) corners.back().z = corners.back().w / 2;
      }
    }
    expect_kept(state, with_values(random, state, corners).mesh(), size);
    if (HasFatalFailure()) return;
  }
}

// Kills: a depth plane that is ignored; triangles through the eye that are limited to a box; values
// at the horizon computed from rounded weights.
TEST_P(DrawOnTarget, LeavesBeforeAndBehindTheEyeWhatItsFragmentsLeave) {
  const OnTarget on_target(GetParam());
  Random random(9);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const TargetSize size = random_size(random, 1);
    const State state = frame_state(random, size);
    std::vector<glm::vec4> corners;
    for (int triangle = 0; triangle < 12; ++triangle) {
      const bool is_on_grid = random.one_in(4);
      for (int corner = 0; corner < 3; ++corner) {
        // Some triangles have w > 0 and z on both sides of the planes; more have w of both signs.
        const float w = corner > 0 && random.one_in(2) ? -random.real(-3, 1) : random.real(-3, 1);
        corners.emplace_back(random.real(-1, 3), random.real(-1, 3), w * random.real(-2, 1), w);
        if (!is_on_grid) continue;
        for (int k = 0; k < 4; ++k) corners.back()[k] = std::round(corners.back()[k] * 4) / 4;
      }
    }
    expect_kept(state, with_values(random, state, corners).mesh(), size);
    if (HasFatalFailure()) return;
  }
}

/// Any bias and format, and any way to cover samples and to clamp that changes depths.
void store_depths(Random& random, State& state) {
  using F = DepthFormat;
  state.depth_format = random.pick({F::float32, F::float32, F::unorm16, F::unorm24});
  state.depth_bias.constant = random.pick({0.0F, 1.0F, -64.0F, 0x1p18F, random.any_real()});
  state.depth_bias.slope = random.pick({0.0F, 1.0F, -0.5F, random.real(-4, 4), random.any_real()});
  state.depth_bias.clamp = random.pick({0.0F, 0.0F, 0.0F, 0x1p-7F, -0x1p-7F});
  state.depth_clamp = random.one_in(3);
  if (random.one_in(2)) {
    state.viewport.min_depth = random.pick({0.0F, 1.0F, 0.25F});
    state.viewport.max_depth = random.pick({0.0F, 0.5F, 0.3F});
  }
  if (random.one_in(3)) {
    state.snapping = {8, Rounding::nearest_even};
    state.basis = random.pick({Basis::snapped, Basis::snapped, Basis::ideal});
  } else if (random.one_in(4)) {
    state.conservative = random.pick({Conservative::outer, Conservative::inner});
  }
}

// Kills: kernels whose offsets have other roundings, or are trusted where those of fragments are
// not; kernels that store or clamp otherwise; hierarchical depth of depths that are not stored.
TEST_P(DrawOnTarget, LeavesOfStoredDepthsWhatItsFragmentsLeave) {
  const OnTarget on_target(GetParam());
  Random random(17);
  for (int i = 0; i < 80; ++i) {
    SCOPED_TRACE(i);
    const TargetSize size{random.pick({63, 64, 70}), random.pick({20, 65}), random.pick({1, 1, 4})};
    State state = frame_state(random, size);
    if (random.one_in(6)) state.depth_test = DepthTest::greater;
    store_depths(random, state);
    std::vector<glm::vec4> corners;
    for (int triangle = 0; triangle < 40; ++triangle) {
      const int reach = random.pick({0, 4, 7, 12});
      const glm::vec2 near{random.between(0, size.width), random.between(0, size.height)};
      const bool is_on_grid = random.one_in(2);
      const bool is_level = random.one_in(4);
      for (int corner = 0; corner < 3; ++corner) {
        corners.push_back(grid_corner(random, state, size, near, reach));
        glm::vec4& p = corners.back();
        if (is_on_grid) continue;
        p.x += p.w * random.real(-9, -5);
        p.y += p.w * random.real(-9, -5);
        p.z = p.w * (is_level ? 0.3F : std::abs(random.real(-6, -1)));
        if (random.one_in(12)) p.w = -p.w;
      }
    }
    expect_kept(state, with_values(random, state, corners).mesh(), size);
    if (HasFatalFailure()) return;
  }
}

// Triangles on one plane, whose slope 2^22 times the constant all but cancels, or of one depth near
// 2^23, which it all but cancels with depth clamp. Kills: kernels that trust offsets in double.
TEST_P(DrawOnTarget, LeavesOfBiasesThatCancelWhatItsFragmentsLeave) {
  const OnTarget on_target(GetParam());
  Random random(18);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const TargetSize size{70, 61, 1};
    State state = small_state(size.width, size.height, Convention::vulkan);
    state.depth_test = DepthTest::less;
    state.depth_format = DepthFormat::unorm24;
    const bool is_level = i % 2 == 0;
    state.depth_clamp = is_level;
    // z/w = 1/2 + x/w/4: for each of 70 pixels 1/140 more
    constexpr float kSlope = 140 * 0x1p22F;
    const float level = 0x1p23F - 1;
    state.depth_bias =
        is_level ? DepthBias{-level * 0x1p24F, 0, 0} : DepthBias{-0x1p46F - 0x1p22F, kSlope, 0};
    std::vector<glm::vec4> corners;
    for (int triangle = 0; triangle < 200; ++triangle) {
      const float x = random.real(-3, -1);
      const float y = random.real(-3, -1);
      const float reach = random.pick({0.05F, 0.3F});
      for (int corner = 0; corner < 3; ++corner) {
        const float w =
            is_level && corner > 0 ? corners.back().w : 1 + std::abs(random.real(-3, -1));
        glm::vec4 p{w * (x + reach * random.real(-3, 0)), w * (y + reach * random.real(-3, 0)), 0,
                    w};
        p.z = is_level ? w * level : w / 2 + p.x / 4;
        corners.push_back(p);
      }
    }
    expect_kept(state, with_values(random, state, corners).mesh(), size);
    if (HasFatalFailure()) return;
  }
}

/// Three corners within a few units in the last place of a diagonal through the middle of the
/// viewport. Edges through the middle have small constants, so that double decides the triangle's
/// orientation with certainty, but not its values.
std::array<glm::vec4, 3> middle_sliver(Random& random) {
  const float reach = random.pick({0.0625F, 1.5F});  // in a small box or a large one
  const float start = reach < 1 ? static_cast<float>(random.between(-15, 14)) / 16 : 0;
  const float slope = random.pick({1.0F, -1.0F});
  const bool is_level = random.one_in(2);
  std::array<glm::vec4, 3> corners;
  for (glm::vec4& p : corners) {
    const float w = random.one_in(2) ? 1.0F : std::abs(random.real(-8, 7)) + 0x1p-10F;
    const float x = w * (start + reach * random.real(-3, -1));
    const float y = slope * x * (1 + static_cast<float>(random.between(-8, 8)) * 0x1p-23F);
    p = {x, y, is_level ? w / 4 : w * std::abs(random.real(-12, -1)), w};
  }
  return corners;
}

// Kills: slivers whose depths, values or orientation are taken from double without a check,
// wherever they are drawn.
TEST_P(DrawOnTarget, LeavesOfSliversWhatTheirFragmentsLeave) {
  const OnTarget on_target(GetParam());
  Random random(12);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const int side = random.pick({7, 64, 65, 129});
    const TargetSize size{side, side, 1};  // samples lie on the diagonals
    const State state = frame_state(random, size);
    std::vector<glm::vec4> corners;
    for (int triangle = 0; triangle < 100; ++triangle) {
      const std::array<glm::vec4, 3> sliver = middle_sliver(random);
      corners.insert(corners.end(), sliver.begin(), sliver.end());
    }
    expect_kept(state, with_values(random, state, corners).mesh(), size);
    if (HasFatalFailure()) return;
  }
}

/// A framebuffer of random size with old content.
Picture used_framebuffer(Random& random) {
  Picture framebuffer;
  framebuffer.size = random_size(random, random.pick({1, 2, 4}));
  framebuffer.attribute_count = static_cast<std::size_t>(random.between(0, 4));
  const auto samples = static_cast<std::size_t>(framebuffer.size.width) *
                       static_cast<std::size_t>(framebuffer.size.height) *
                       static_cast<std::size_t>(framebuffer.size.samples);
  framebuffer.depth.assign(samples, random.pick({0.0F, 0.5F, -1.0F}));
  framebuffer.attributes.assign(samples * framebuffer.attribute_count, 7);
  return framebuffer;
}

// Kills: tiles that no triangle touches and that are not cleared; old content that remains.
TEST(ClearAndDraw, LeavesWhatClearingAndDrawingLeave) {
  Random random(10);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    RandomDraw draw = random_draw(random);
    draw.size = random_size(random, draw.size.samples);
    draw.state.viewport = random_viewport(random, ViewportKind::plain, draw.size);
    draw.state.depth_test = i % 3 == 0 ? DepthTest::always : DepthTest::less;
    draw.mesh = many_triangles(random, draw.state, random.between(0, 3));
    const float depth = random.pick({1.0F, 0.5F, 0.0F});
    Picture expected;
    ASSERT_FALSE(clear(expected, draw.size, draw.state.attributes.size(), depth));
    const DrawResult result = rasterizer::draw(draw.state, draw.mesh.mesh(), expected);
    ASSERT_FALSE(result.error);
    for (const unsigned threads : {1U, 3U}) {
      Picture drawn = random.one_in(4) ? expected : used_framebuffer(random);
      const DrawResult at_once =
          clear_and_draw(draw.state, draw.mesh.mesh(), draw.size, depth, drawn, threads);
      ASSERT_FALSE(at_once.error);
      EXPECT_EQ(at_once.counts, result.counts);
      EXPECT_EQ(drawn.size.width, draw.size.width);
      EXPECT_EQ(drawn.size.height, draw.size.height);
      EXPECT_EQ(drawn.size.samples, draw.size.samples);
      EXPECT_EQ(drawn.attribute_count, draw.state.attributes.size());
      expect_equal(drawn, expected);
      if (HasFatalFailure()) return;
    }
  }
}

// If a framebuffer is larger than the caches, stores to it bypass the caches. Kills: numbers across
// the border of two cache lines left out; lines written that belong to another row.
TEST_P(DrawOnTarget, LeavesTheSameWhereFramebuffersAreLarge) {
  const OnTarget target(GetParam());
  Random random(16);
  for (const int attributes : {1, 2, 3, 4}) {
    SCOPED_TRACE(attributes);
    constexpr int kWidth = 1101;  // rows begin anywhere within a cache line
    constexpr int kNumbers = 2'200'000;
    const TargetSize size{kWidth, kNumbers / (kWidth * (1 + attributes)), 1};
    State state = small_state(size.width, size.height, Convention::vulkan);
    state.depth_test = DepthTest::less;
    state.attributes.resize(static_cast<std::size_t>(attributes));
    const SmallMesh mesh = many_triangles(random, state, 3);
    Picture expected;
    ASSERT_FALSE(clear(expected, size, state.attributes.size(), 1));
    ASSERT_FALSE(rasterizer::draw(state, mesh.mesh(), expected).error);
    Picture drawn;
    ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), size, 1, drawn, 2).error);
    expect_equal(drawn, expected);
    if (HasFatalFailure()) return;
  }
}

// Corners one unit in the last place apart are different corners, although double does not show
// that their triangle has an area. Kills: corners considered equal although only two of x, y, w
// are.
TEST_P(DrawOnTarget, CornersAtTheSamePointMakeNoTriangle) {
  const OnTarget target(GetParam());
  const TargetSize size{20, 20, 1};
  State state = small_state(size.width, size.height, Convention::vulkan);
  state.attributes.resize(1);
  const glm::vec4 x{0x1p-27F, 0, 0, 0};
  const glm::vec4 y{0, 0x1p-27F, 0, 0};
  const glm::vec4 z{0, 0, 0.25F, 0};
  const glm::vec4 w{0, 0, 0, 0x1p-23F};
  struct Changes {
    std::array<glm::vec4, 2> of;
    std::size_t degenerate;
  };
  for (const auto& [of, degenerate] :
       {Changes{{x, y}, 0}, Changes{{y, x}, 0}, Changes{{x, w}, 0}, Changes{{w, y}, 0},
        Changes{{x, z}, 3}, Changes{{z, w}, 3}}) {
    SCOPED_TRACE(testing::Message() << of[0].x << of[0].y << of[0].z << of[0].w);
    const glm::vec4 q{0.05F, 0.05F, 0.5F, 1};
    SmallMesh mesh;
    mesh.positions = {q, q + of[0], q + of[1]};
    mesh.triangles = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}};
    mesh.attributes = {1, 2, 3};
    Fragments fragments;
    const DrawCounts counts = draw_fragments(state, mesh.mesh(), size, fragments).counts;
    EXPECT_EQ(counts.discarded_degenerate, degenerate);
    Picture drawn;
    EXPECT_EQ(clear_and_draw(state, mesh.mesh(), size, 1, drawn).counts, counts);
  }
}

// Kills: triangles that are left out but not counted; triangles counted once for each tile or
// worker.
TEST(Draw, CountsWhatFragmentsCount) {
  Random random(13);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const TargetSize size = random_size(random, 1);
    const State state = frame_state(random, size);
    std::vector<glm::vec4> corners;
    for (int corner = 0; corner < 300; ++corner) {
      corners.push_back(grid_corner(random, state, size, {size.width / 2, size.height / 2}, 3));
      if (random.one_in(50)) corners.back().z = std::numeric_limits<float>::infinity();
    }
    const SmallMesh mesh = with_values(random, state, corners);
    Fragments fragments;
    const DrawCounts counts = draw_fragments(state, mesh.mesh(), size, fragments).counts;
    EXPECT_GT(counts.discarded_not_finite, 0U);
    EXPECT_GT(counts.discarded_degenerate, 0U);
    for (const unsigned threads : {1U, 3U}) {
      Picture drawn;
      EXPECT_EQ(clear_and_draw(state, mesh.mesh(), size, 1, drawn, threads).counts, counts);
    }
  }
}

// Kills: a round of chunks that starts over or is left out; tiles cleared again in a later round.
TEST(Draw, GoesOnWhereBinsOutgrowTheirMemory) {
  constexpr std::uint32_t kRound = 65'536;  // triangles between two checks of memory
  const TargetSize size{70, 10, 1};
  State state = small_state(size.width, size.height);
  state.attributes.assign(6, {Interpolation::flat, Location::sample});
  Random random(11);
  std::vector<glm::vec4> corners;
  for (int i = 0; i < 100; ++i) {
    const float u = static_cast<float>(random.between(0, 62)) + 0.25F;
    const float v = static_cast<float>(random.between(0, 2)) + 0.25F;
    corners.insert(corners.end(), {at(state, u, v), at(state, u + 8, v), at(state, u + 1, v + 8)});
  }
  SmallMesh mesh = with_values(random, state, corners);
  const std::vector<glm::uvec3> some = mesh.triangles;
  for (std::uint32_t i = 1; mesh.triangles.size() < kRound + 3000; ++i) {
    mesh.triangles.push_back(some[i * i % some.size()]);
  }
  Picture cleared;
  ASSERT_FALSE(clear(cleared, size, state.attributes.size(), 1));
  const Picture expected = kept(state, mesh.mesh(), cleared);
  Picture drawn;
  ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), size, 1, drawn, 2).error);
  expect_equal(drawn, expected);

  const Fragments fragments = fragments_of(state, mesh, size);
  const auto first_round = std::count_if(fragments.triangle.begin(), fragments.triangle.end(),
                                         [](std::uint32_t triangle) { return triangle < kRound; });
  const std::size_t of_fragment = (2 + state.attributes.size()) * sizeof(float);
  EXPECT_GT(static_cast<std::size_t>(first_round) * of_fragment, kBinMemory);
}

}  // namespace
}  // namespace rastercheck::rasterizer::frame_drawing_test
