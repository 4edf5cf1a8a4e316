#include "tests/rasterizer/kept_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace rastercheck::rasterizer {
namespace {

std::vector<std::uint32_t> bits_of(std::span<const float> values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

}  // namespace

Framebuffer kept(const State& state, const Mesh& mesh, Framebuffer framebuffer) {
  State plain = state;
  plain.derivatives = false;
  plain.precision = Precision::float64;
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

}  // namespace rastercheck::rasterizer
