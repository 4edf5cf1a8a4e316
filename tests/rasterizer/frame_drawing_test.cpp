// Draws into framebuffers, tile by tile: each sample is what its fragments, in order, leave there.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "rasterizer/rasterizer.h"
#include "tests/rasterizer/random_draw.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer {
namespace {

/// The same bits, signs of zeros and NaN included.
std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

/// What the fragments leave, one by one.
Framebuffer kept(const State& state, const Mesh& mesh, Framebuffer framebuffer) {
  State plain = state;
  plain.derivatives = false;
  Fragments fragments;
  EXPECT_FALSE(draw_fragments(plain, mesh, framebuffer.size, fragments).error);
  const TargetSize& size = framebuffer.size;
  const std::size_t attributes = framebuffer.attribute_count;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const std::size_t pixel =
        std::size_t{fragments.y[i]} * static_cast<std::size_t>(size.width) + fragments.x[i];
    const std::size_t place = pixel * static_cast<std::size_t>(size.samples) + fragments.sample[i];
    const bool is_nearer = fragments.depth[i] < framebuffer.depth[place];
    if (state.depth_test == DepthTest::less && !is_nearer) continue;
    framebuffer.depth[place] = fragments.depth[i];
    std::copy_n(fragments.attributes.data() + i * attributes, attributes,
                framebuffer.attributes.data() + place * attributes);
  }
  return framebuffer;
}

void expect_equal(const Framebuffer& a, const Framebuffer& b) {
  ASSERT_EQ(bits_of(a.depth), bits_of(b.depth));
  ASSERT_EQ(bits_of(a.attributes), bits_of(b.attributes));
}

/// Draws on one to three threads; all give what the fragments leave.
void expect_kept(const State& state, const Mesh& mesh, const TargetSize& size) {
  Framebuffer cleared;
  ASSERT_FALSE(clear(cleared, size, state.attributes.size(), 1));
  for (std::size_t i = 0; i < cleared.attributes.size(); ++i) {
    cleared.attributes[i] = static_cast<float>(i);  // what is not drawn comes back
  }
  const Framebuffer expected = kept(state, mesh, cleared);
  for (const unsigned threads : {1U, 2U, 3U}) {
    Framebuffer drawn = cleared;
    ASSERT_FALSE(draw(state, mesh, drawn, threads).error);
    expect_equal(drawn, expected);
  }
}

/// A mesh of many triangles of all sizes, some of which share vertices.
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

/// Width and height on either side of one and two tiles.
TargetSize random_size(Random& random, int samples) {
  const auto side = [&random] { return random.pick({1, 7, 63, 64, 65, 100, 128, 129, 150}); };
  const int width = side();
  const int height = side();
  return {width, height, samples};
}

class DrawOnTarget : public testing::TestWithParam<std::int64_t> {};
INSTANTIATE_TEST_SUITE_P(AllTargets, DrawOnTarget, testing::ValuesIn(all_targets()), target_name);

// Kills: a tile's border that is off by one; the last lane; a race; values that depend on the tile.
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
    draw.state.depth_test = i % 3 == 0 ? DepthTest::none : DepthTest::less;
    draw.mesh = many_triangles(random, draw.state, 12);
    expect_kept(draw.state, draw.mesh.mesh(), draw.size);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer
