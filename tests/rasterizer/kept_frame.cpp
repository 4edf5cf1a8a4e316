#include "tests/rasterizer/kept_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {
namespace {

std::vector<std::uint32_t> bits_of(std::span<const float> values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

/// The picture with signalling NaNs made quiet, as a conversion to double makes them.
Picture quieted(Picture framebuffer) {
  constexpr std::uint32_t kQuiet = 0x00400000;
  for (float& value : framebuffer.attributes) {
    if (!std::isnan(value)) continue;
    value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) | kQuiet);
  }
  return framebuffer;
}

bool passes(DepthTest test, float depth, float old) {
  switch (test) {
    case DepthTest::always:
      return true;
    case DepthTest::never:
      return false;
    case DepthTest::less:
      return depth < old;
    case DepthTest::equal:
      return depth == old;
    case DepthTest::less_or_equal:
      return depth <= old;
    case DepthTest::greater:
      return depth > old;
    case DepthTest::not_equal:
      return depth != old;
    case DepthTest::greater_or_equal:
      return depth >= old;
  }
  return false;
}

double held(double value) { return value > 0 ? std::min(value, 1.0) : 0; }

/// A channel's value after blending, before it is rounded.
double blended(Blend blend, std::size_t channel, double alpha, double color, double old) {
  if (blend == Blend::off) return color;
  if (blend == Blend::additive) return color + old;
  return (channel == 3 ? color : alpha * color) + (1 - alpha) * old;
}

/// Blends a colour into a sample.
void put(const State& state, std::span<const float> color, std::size_t place,
         Picture& framebuffer) {
  const bool is_rgba8 = framebuffer.format == ColorFormat::rgba8;
  const auto incoming = [&](std::size_t k) { return is_rgba8 ? held(color[k]) : double{color[k]}; };
  const double alpha = state.blend == Blend::over ? incoming(3) : 0;
  for (std::size_t k = 0; k < color.size(); ++k) {
    const std::size_t at = place * color.size() + k;
    if (is_rgba8) {
      const double value = blended(state.blend, k, alpha, 255 * incoming(k), framebuffer.bytes[at]);
      framebuffer.bytes[at] = static_cast<std::uint8_t>(std::nearbyint(std::min(value, 255.0)));
    } else if (state.blend == Blend::off) {
      framebuffer.attributes[at] = color[k];  // also the bits of a NaN
    } else {
      framebuffer.attributes[at] = static_cast<float>(
          blended(state.blend, k, alpha, incoming(k), framebuffer.attributes[at]));
    }
  }
}

}  // namespace

Picture kept(const State& state, const Mesh& mesh, Picture framebuffer) {
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
    if (!passes(state.depth_test, fragments.depth[i], framebuffer.depth[place])) continue;
    if (state.depth_write) framebuffer.depth[place] = fragments.depth[i];
    put(state, std::span(fragments.attributes).subspan(i * attributes, attributes), place,
        framebuffer);
  }
  return framebuffer;
}

void expect_equal(const Picture& a, const Picture& b) {
  ASSERT_EQ(bits_of(a.depth), bits_of(b.depth));
  ASSERT_EQ(bits_of(a.attributes), bits_of(b.attributes));
  ASSERT_EQ(a.bytes, b.bytes);
}

void expect_kept(const State& state, const Mesh& mesh, const TargetSize& size, ColorFormat format) {
  Picture cleared;
  cleared.format = format;
  const std::size_t attributes = state.attributes.size();
  ASSERT_FALSE(clear(cleared, size, attributes, 1));
  for (std::size_t i = 0; i < cleared.attributes.size(); ++i) {
    cleared.attributes[i] = static_cast<float>(i);  // kept where nothing is drawn
  }
  for (std::size_t i = 0; i < cleared.bytes.size(); ++i) {
    cleared.bytes[i] = static_cast<std::uint8_t>(i % 256);
  }
  const Picture expected = kept(state, mesh, cleared);
  for (const unsigned threads : {1U, 2U, 3U}) {
    Picture drawn = cleared;
    ASSERT_FALSE(draw(state, mesh, drawn, threads).error);
    expect_equal(drawn, expected);
  }
  Picture shaded = cleared;
  ASSERT_FALSE(draw(state, mesh, AttributesShader{attributes}, shaded).error);
  expect_equal(quieted(shaded), quieted(expected));
}

}  // namespace rastercheck::rasterizer
