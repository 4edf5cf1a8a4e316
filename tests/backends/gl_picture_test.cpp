// Tests the pictures of the backend `gl` by pictures that are known by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/backends/drivers.h"
#include "tests/backends/window_cases.h"

namespace rastercheck::backends::gl_picture_test {
namespace {

using cases::Blend;
using cases::ColorFormat;
using cases::DepthFunction;
using cases::Filter;
using cases::Interpolation;
using cases::Location;
using cases::Picture;
using cases::Pipeline;
using cases::Shading;
using cases::Wrap;
using testing::HasSubstr;

using Color = std::vector<float>;

/// Attributes have values up to 16 here; errors of planes in float32 stay far below this.
constexpr float kTolerance = 0x1p-10F;

/// A case of as many flat attributes.
cases::Case flat_case(std::size_t attributes = 4, cases::FramebufferSize size = {16, 16, 1}) {
  cases::Case c = empty_case();
  c.framebuffer = size;
  for (std::size_t i = 0; i < attributes; ++i) {
    c.attributes.push_back({"a" + std::to_string(i), Interpolation::flat, Location::sample});
  }
  return c;
}

/// A case of smooth attributes.
cases::Case smooth_case(std::size_t attributes) {
  cases::Case c = flat_case(attributes);
  for (cases::Attribute& attribute : c.attributes) attribute.interpolation = Interpolation::smooth;
  return c;
}

/// Adds a triangle whose vertices have the same attributes.
void add_flat(cases::Case& c, const std::vector<cases::ClipVertex>& corners, const Color& color) {
  std::vector<float> values;
  for (int corner = 0; corner < 3; ++corner) {
    values.insert(values.end(), color.begin(), color.end());
  }
  add(c, corners, values);
}

/// A triangle over all of the window, parallel to the screen, at a window depth.
std::vector<cases::ClipVertex> at_depth(float depth) { return everything(2 * depth - 1); }

std::size_t index_of(const Picture& picture, int x, int y, int sample = 0) {
  const cases::FramebufferSize& size = picture.size;
  return static_cast<std::size_t>((y * size.width + x) * size.samples + sample);
}

Color color_at(const Picture& picture, int x, int y, int sample = 0) {
  const auto first =
      picture.color.begin() +
      static_cast<std::ptrdiff_t>(index_of(picture, x, y, sample) * picture.channels);
  return {first, first + static_cast<std::ptrdiff_t>(picture.channels)};
}

float depth_at(const Picture& picture, int x, int y, int sample = 0) {
  return picture.depth[index_of(picture, x, y, sample)];
}

/// The colour of bytes, as a picture has it.
Color of_bytes(const std::array<int, 4>& bytes) {
  Color color;
  for (const int byte : bytes) color.push_back(static_cast<float>(byte) / 255);
  return color;
}

/// A 2 × 2 texture whose texels are, in order, 1 to 4 in all channels but alpha.
cases::Texturing four_texels(std::array<std::uint8_t, 4> alphas = {255, 255, 255, 255}) {
  cases::Texturing texturing;
  texturing.texture = {2, 2, {}};
  for (std::uint8_t i = 0; i < 4; ++i) {
    const auto byte = static_cast<std::uint8_t>(i + 1);
    for (const std::uint8_t value : {byte, byte, byte, alphas.at(i)}) {
      texturing.texture.texels.push_back(value);
    }
  }
  return texturing;
}

class GlPicture : public DriverTest {
 protected:
  Picture draw(const cases::Case& c, const Pipeline& pipeline) const {
    EXPECT_NE(backend().picture_drawer(), nullptr);
    Result<Picture> drawn = backend().picture_drawer()->draw_picture(c, pipeline);
    EXPECT_TRUE(drawn) << to_string(drawn.error());
    if (!drawn) return {};
    const auto samples =
        static_cast<std::size_t>(drawn->size.width * drawn->size.height * drawn->size.samples);
    EXPECT_EQ(drawn->depth.size(), samples);
    EXPECT_EQ(drawn->color.size(), samples * drawn->channels);
    return *std::move(drawn);
  }
  void expect_refused(const cases::Case& c, const Pipeline& pipeline, const std::string& what,
                      Failure failure = Failure::unsupported) const {
    const auto drawn = backend().picture_drawer()->draw_picture(c, pipeline);
    ASSERT_FALSE(drawn) << what;
    EXPECT_EQ(drawn.error().failure, failure) << to_string(drawn.error());
    EXPECT_THAT(drawn.error().reason, HasSubstr(what));
  }
  bool is_es() const { return std::string(GetParam()).find("gles") != std::string::npos; }
  bool is_softpipe() const { return std::string(GetParam()).find("softpipe") != std::string::npos; }
};

TEST_P(GlPicture, IsAnnounced) { EXPECT_TRUE(backend().about().draws_pictures); }

TEST_P(GlPicture, IsClearWhereNothingIsDrawn) {
  cases::Case c = flat_case();
  add_flat(c, left_of(6), {0.5F, 2, -3, 0.25F});
  for (const float clear : {0.0F, 0.75F, 1.0F, 2.0F, std::numeric_limits<float>::infinity()}) {
    Pipeline pipeline;
    pipeline.clear_depth = clear;
    pipeline.depth_function = DepthFunction::always;
    const Picture picture = draw(c, pipeline);
    EXPECT_EQ(picture.channels, 4U);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        EXPECT_EQ(color_at(picture, x, y), x < 6 ? Color({0.5F, 2, -3, 0.25F}) : Color(4));
        EXPECT_EQ(depth_at(picture, x, y), x < 6 ? 0.5F : clear);
      }
    }
  }
  c.triangles.clear();
  EXPECT_EQ(draw(c, {}).depth, std::vector<float>(256, 1));
}

TEST_P(GlPicture, TestsDepths) {
  // Whether a fragment that is nearer, as near and farther than what is there is drawn.
  const std::vector<std::pair<DepthFunction, std::array<bool, 3>>> expected = {
      {DepthFunction::always, {true, true, true}},
      {DepthFunction::never, {false, false, false}},
      {DepthFunction::less, {true, false, false}},
      {DepthFunction::equal, {false, true, false}},
      {DepthFunction::less_or_equal, {true, true, false}},
      {DepthFunction::greater, {false, false, true}},
      {DepthFunction::not_equal, {true, false, true}},
      {DepthFunction::greater_or_equal, {false, true, true}}};
  for (const auto& [function, is_drawn] : expected) {
    Pipeline pipeline;
    pipeline.clear_depth = 0.5F;
    pipeline.depth_function = function;
    for (const bool writes : {true, false}) {
      pipeline.writes_depth = writes;
      for (std::size_t i = 0; i < 3; ++i) {
        const float depth = static_cast<float>(i + 1) / 4;
        cases::Case c = flat_case();
        add_flat(c, at_depth(depth), {1, 1, 1, 1});
        const Picture picture = draw(c, pipeline);
        EXPECT_EQ(picture.color, Color(1024, is_drawn.at(i) ? 1.0F : 0.0F));
        EXPECT_EQ(picture.depth, Color(256, is_drawn.at(i) && writes ? depth : 0.5F));
      }
    }
  }
}

// Kills: a case's own depth test, and any order but that of submission.
TEST_P(GlPicture, DrawsInOrderWithThePipelinesTest) {
  cases::Case c = flat_case();
  c.depth_test = cases::DepthTest::less;
  add_flat(c, at_depth(0.5F), {1, 0, 0, 1});
  add_flat(c, at_depth(0.75F), {2, 0, 0, 1});
  add_flat(c, at_depth(0.25F), {3, 0, 0, 1});
  Pipeline pipeline;
  pipeline.writes_depth = false;
  EXPECT_EQ(color_at(draw(c, pipeline), 3, 3)[0], 3);
  std::swap(c.triangles[1], c.triangles[2]);
  EXPECT_EQ(color_at(draw(c, pipeline), 3, 3)[0], 2);
  pipeline.writes_depth = true;
  EXPECT_EQ(color_at(draw(c, pipeline), 3, 3)[0], 3);
}

TEST_P(GlPicture, BlendsFloats) {
  cases::Case c = flat_case();
  add_flat(c, everything(), {0.5F, 1, 4, 0.5F});
  add_flat(c, everything(), {1, -2, 0.5F, 0.25F});
  Pipeline pipeline;
  pipeline.depth_function = DepthFunction::always;
  EXPECT_EQ(color_at(draw(c, pipeline), 5, 7), Color({1, -2, 0.5F, 0.25F}));
  pipeline.blend = Blend::additive;
  if (is_es() && !backend().picture_drawer()->draw_picture(c, pipeline)) {
    return expect_refused(c, pipeline, "GL_EXT_float_blend");
  }
  EXPECT_EQ(color_at(draw(c, pipeline), 5, 7), Color({1.5F, -1, 4.5F, 0.75F}));
  pipeline.blend = Blend::over;
  // First half of {0.5, 1, 4}, then a quarter of the second and three quarters of that.
  EXPECT_EQ(color_at(draw(c, pipeline), 5, 7), Color({0.4375F, -0.125F, 1.625F, 0.625F}));
}

TEST_P(GlPicture, StoresBytes) {
  cases::Case c = flat_case();
  add_flat(c, everything(), {0.2F, 1.5F, -1, 100.0F / 255});
  Pipeline pipeline;
  pipeline.depth_function = DepthFunction::always;
  pipeline.format = ColorFormat::rgba8;
  EXPECT_EQ(color_at(draw(c, pipeline), 9, 2), of_bytes({51, 255, 0, 100}));
  add_flat(c, left_of(8), {0.4F, 0.2F, 0.2F, 1});
  pipeline.blend = Blend::additive;
  EXPECT_EQ(color_at(draw(c, pipeline), 3, 2), of_bytes({153, 255, 51, 255}));
  EXPECT_EQ(color_at(draw(c, pipeline), 9, 2), of_bytes({51, 255, 0, 100}));
  // Alpha 1 covers what is there.
  pipeline.blend = Blend::over;
  EXPECT_EQ(color_at(draw(c, pipeline), 3, 2), of_bytes({102, 51, 51, 255}));
}

TEST_P(GlPicture, HasEverySample) {
  cases::Case c = flat_case(4, {16, 16, 4});
  // The triangle ends at x = 8.5; samples 0 and 2 of the pixels there lie within it.
  add_flat(c, left_of(8.5F), {1, 0.5F, 0.25F, 1});
  for (const auto format : {ColorFormat::float32, ColorFormat::rgba8}) {
    Pipeline pipeline;
    pipeline.format = format;
    if (is_softpipe()) return expect_refused(c, pipeline, "samples");
    const Picture picture = draw(c, pipeline);
    const Color stored =
        format == ColorFormat::rgba8 ? color_at(picture, 0, 0) : Color({1, 0.5F, 0.25F, 1});
    EXPECT_NEAR(stored[1], 0.5F, 1.0F / 255);
    EXPECT_EQ(picture.size, (cases::FramebufferSize{16, 16, 4}));
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        for (int s = 0; s < 4; ++s) {
          const bool is_drawn = x < 8 || (x == 8 && s % 2 == 0);
          EXPECT_EQ(color_at(picture, x, y, s), is_drawn ? stored : Color(4));
          EXPECT_EQ(depth_at(picture, x, y, s), is_drawn ? 0.5F : 1.0F);
        }
      }
    }
  }
}

TEST_P(GlPicture, InterpolatesAtSamplesAndCentres) {
  cases::Case c = smooth_case(2);
  c.framebuffer.samples = 4;
  c.attributes[1].location = Location::center;
  // Both are window x.
  add(c, left_of(8.5F), {8.5F, 8.5F, 8.5F, 8.5F, -100, -100});
  if (is_softpipe()) return expect_refused(c, {}, "samples");
  const Picture picture = draw(c, {});
  constexpr std::array<float, 4> kPlaces = {6, 14, 2, 10};
  for (int x = 0; x < 8; ++x) {
    for (int s = 0; s < 4; ++s) {
      const Color color = color_at(picture, x, 11, s);
      const auto place = static_cast<std::size_t>(s);
      EXPECT_NEAR(color[0], static_cast<float>(x) + kPlaces.at(place) / 16, 16 * kTolerance);
      EXPECT_NEAR(color[1], static_cast<float>(x) + 0.5F, 16 * kTolerance);
    }
  }
}

TEST_P(GlPicture, ResolvesSamples) {
  cases::Case c = flat_case(4, {16, 16, 4});
  std::vector<cases::ClipVertex> left = left_of(8.5F);
  add_flat(c, left, {1, 0.5F, 0.25F, 1});
  Pipeline pipeline;
  pipeline.resolves = true;
  if (is_softpipe()) return expect_refused(c, pipeline, "samples");
  const Picture floats = draw(c, pipeline);
  EXPECT_EQ(floats.size, (cases::FramebufferSize{16, 16, 1}));
  pipeline.format = ColorFormat::rgba8;
  const Picture bytes = draw(c, pipeline);
  for (int x = 0; x < 16; ++x) {
    const float share = x < 8 ? 1.0F : x == 8 ? 0.5F : 0.0F;
    EXPECT_EQ(color_at(floats, x, 4), Color({share, share / 2, share / 4, share}));
    // Sample 0 of pixel 8 lies within the triangle.
    for (const Picture& picture : {floats, bytes}) {
      EXPECT_EQ(depth_at(picture, x, 4), x <= 8 ? 0.5F : 1.0F);
    }
    EXPECT_NEAR(color_at(bytes, x, 4)[0] * 255, share * 255, 0.5F + kTolerance);
  }
}

// A resolved picture of one sample is the picture itself. Kills: a second read of cleared targets.
TEST_P(GlPicture, ResolvesASingleSample) {
  cases::Case c = flat_case();
  add_flat(c, left_of(5), {1, 2, 3, 4});
  Pipeline pipeline;
  const Picture plain = draw(c, pipeline);
  pipeline.resolves = true;
  const Picture resolved = draw(c, pipeline);
  EXPECT_EQ(resolved.size, c.framebuffer);
  EXPECT_EQ(resolved.color, plain.color);
  EXPECT_EQ(resolved.depth, plain.depth);
}

TEST_P(GlPicture, HasEveryOfManyAttributes) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{6}, std::size_t{9}}) {
    cases::Case c = flat_case(count);
    Color values;
    for (std::size_t i = 0; i < count; ++i) {
      values.push_back(static_cast<float>(i) / 2 + 1);
      if (i % 3 == 1) c.attributes[i].interpolation = Interpolation::smooth;
      if (i % 3 == 2 && !is_es()) c.attributes[i].interpolation = Interpolation::noperspective;
    }
    add_flat(c, left_of(7), values);
    const Picture picture = draw(c, {});
    EXPECT_EQ(picture.channels, count);
    EXPECT_EQ(color_at(picture, 8, 0), Color(count));
    EXPECT_EQ(depth_at(picture, 6, 0), 0.5F);
    EXPECT_EQ(depth_at(picture, 8, 0), 1);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(color_at(picture, 6, 0)[i], values[i], kTolerance);
    }
  }
}

TEST_P(GlPicture, HasVertexColors) {
  Pipeline pipeline;
  pipeline.shading = Shading::vertex_colors;
  cases::Case c = flat_case(3);
  add_flat(c, left_of(5), {0.5F, 0.25F, 2});
  EXPECT_EQ(color_at(draw(c, pipeline), 2, 2), Color({0.5F, 0.25F, 2, 1}));
  EXPECT_EQ(color_at(draw(c, pipeline), 5, 2), Color(4));
  c = flat_case(5);
  add_flat(c, left_of(5), {0.5F, 0.25F, 2, 3, 4});
  EXPECT_EQ(color_at(draw(c, pipeline), 2, 2), Color({0.5F, 0.25F, 2, 3}));
}

// Kills: the wrong sign, coarse derivatives, and one sample or row in place of another.
TEST_P(GlPicture, HasDifferencesAcrossQuads) {
  cases::Case c = smooth_case(3);
  c.attributes[2].interpolation = Interpolation::flat;
  add(c, {at(0, 0), at(2 * kSide, 0, 0, 3), at(0, 2 * kSide, 0, 2)}, {0, 1, 5, 9, 2, 6, 1, 12, 7});
  const Picture values = draw(c, {});
  for (const bool is_along_x : {true, false}) {
    Pipeline pipeline;
    pipeline.shading = is_along_x ? Shading::differences_along_x : Shading::differences_along_y;
    if (is_es()) {
      expect_refused(c, pipeline, "GL_ARB_derivative_control");
      continue;
    }
    const Picture differences = draw(c, pipeline);
    EXPECT_EQ(differences.channels, 3U);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const Color odd = color_at(values, is_along_x ? x | 1 : x, is_along_x ? y : y | 1);
        const Color even = color_at(values, is_along_x ? x & ~1 : x, is_along_x ? y : y & ~1);
        const Color difference = color_at(differences, x, y);
        for (std::size_t i = 0; i < 2; ++i) {
          EXPECT_NEAR(difference[i], odd[i] - even[i], 0x1p-18F) << x << " " << y;
        }
        EXPECT_EQ(difference[2], 0);
      }
    }
  }
}

TEST_P(GlPicture, HasFacingAndWindowCoordinates) {
  cases::Case c = flat_case(0);
  // w is 2 and 1/w is 1/2; the second triangle is seen from behind.
  add(c, {at(0, 0, 0, 2), at(kSide, 0, 0, 2), at(0, kSide, 0, 2)}, {});
  add(c, {at(kSide, kSide, 0, 2), at(0, kSide, 0, 2), at(kSide, 0, 0, 2)}, {});
  std::swap(c.triangles[1][1], c.triangles[1][2]);
  Pipeline pipeline;
  pipeline.shading = Shading::facing;
  const Picture facing = draw(c, pipeline);
  pipeline.shading = Shading::window_coordinates;
  const Picture coordinates = draw(c, pipeline);
  for (const auto& [x, y] : {std::array{2, 3}, {3, 0}, {12, 10}, {15, 14}}) {
    EXPECT_EQ(color_at(facing, x, y), x + y < 15 ? Color({1, 1, 1, 1}) : Color({0, 0, 0, 1}));
    const Color place = color_at(coordinates, x, y);
    EXPECT_EQ(place[0], static_cast<float>(x) + 0.5F);
    EXPECT_EQ(place[1], static_cast<float>(y) + 0.5F);
    EXPECT_NEAR(place[2], depth_at(coordinates, x, y), 0x1p-20F);
    EXPECT_NEAR(place[3], 0.5F, 0x1p-20F);
  }
}

// Kills: another attribute than the last, and differences that are taken after discarding.
TEST_P(GlPicture, DiscardsByTheLastAttribute) {
  cases::Case c = smooth_case(3);
  add(c, everything(),
      {0, 0, 0, 32, 0, 2, 0, 32, 0});  // x, y, and x/16 as the window has 16 pixels
  Pipeline pipeline;
  pipeline.discard_below = 0.4375F;  // 7/16, between two centres
  const Picture values = draw(c, pipeline);
  for (int x = 0; x < 16; ++x) {
    EXPECT_EQ(depth_at(values, x, 5), x < 7 ? 1.0F : 0.5F) << x;
    EXPECT_NEAR(color_at(values, x, 5)[0], x < 7 ? 0 : static_cast<float>(x) + 0.5F, kTolerance);
  }
  pipeline.shading = Shading::differences_along_x;
  if (is_es()) return expect_refused(c, pipeline, "GL_ARB_derivative_control");
  const Picture differences = draw(c, pipeline);
  for (int x = 0; x < 16; ++x) {
    EXPECT_NEAR(color_at(differences, x, 5)[0], x < 7 ? 0 : 1, kTolerance) << x;
  }
  c.attributes.clear();
  c.attribute_values.clear();
  expect_refused(c, pipeline, "discarding needs a texture or an attribute", Failure::refused);
}

/// Texture coordinates from −1 to 3 along both axes of the window: at pixel i, texel ⌊i/2⌋ − 2 of
/// two.
cases::Case textured_case() {
  cases::Case c = smooth_case(2);
  add(c, everything(), {-1, -1, 7, -1, -1, 7});
  return c;
}

int wrapped(int texel, Wrap wrap) {
  if (wrap == Wrap::clamp) return texel < 1 ? 0 : 1;
  const int turned = (texel + 8) % (wrap == Wrap::repeat ? 2 : 4);
  return turned < 2 ? turned : 3 - turned;
}

TEST_P(GlPicture, LooksUpTexels) {
  const cases::Case c = textured_case();
  for (const Wrap wrap_s : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    for (const Wrap wrap_t : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
      Pipeline pipeline;
      pipeline.format = ColorFormat::rgba8;
      pipeline.texturing = four_texels();
      pipeline.texturing->wrap_s = wrap_s;
      pipeline.texturing->wrap_t = wrap_t;
      const Picture picture = draw(c, pipeline);
      for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
          const int texel = 2 * wrapped(y / 2 - 2, wrap_t) + wrapped(x / 2 - 2, wrap_s);
          const int byte = texel + 1;
          EXPECT_EQ(color_at(picture, x, y), of_bytes({byte, byte, byte, 255})) << x << " " << y;
        }
      }
    }
  }
}

TEST_P(GlPicture, DiscardsBelow) {
  const cases::Case c = textured_case();
  Pipeline pipeline;
  pipeline.texturing = four_texels({0, 100, 200, 255});
  pipeline.discard_below = 0.5F;
  const Picture picture = draw(c, pipeline);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      // The upper row of texels is opaque enough.
      const bool is_drawn = y / 2 % 2 == 1;
      EXPECT_EQ(color_at(picture, x, y)[3] > 0.5F, is_drawn);
      EXPECT_EQ(color_at(picture, x, y)[0] > 0, is_drawn);
      EXPECT_EQ(depth_at(picture, x, y), is_drawn ? 0.5F : 1.0F);
    }
  }
}

TEST_P(GlPicture, FiltersTextures) {
  cases::Case c = smooth_case(2);
  // Along x, coordinate s is that of the texture's width; t is constant.
  add(c, everything(), {0, 0.5F, 2, 0.5F, 0, 0.5F});
  Pipeline pipeline;
  pipeline.texturing = cases::Texturing{};
  pipeline.texturing->texture = {2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  pipeline.texturing->wrap_s = Wrap::clamp;
  pipeline.texturing->filter = Filter::bilinear;
  const Picture picture = draw(c, pipeline);
  for (int x = 0; x < 16; ++x) {
    // The texels' centres are at 1/4 and 3/4 of the window.
    const float share = std::clamp((static_cast<float>(x) + 0.5F - 4) / 8, 0.0F, 1.0F);
    // Weights of eight bits, and a rounding of the result to as many.
    EXPECT_NEAR(color_at(picture, x, 8)[0], share, 0x1p-7F);
  }
}

// With 64 texels on 16 pixels, λ is 2. Level 2 has 16 texels, each the mean of four stripes.
TEST_P(GlPicture, FiltersLevels) {
  cases::Case c = smooth_case(2);
  add(c, everything(), {0, 0, 2, 0, 0, 2});
  Pipeline pipeline;
  pipeline.texturing = cases::Texturing{};
  pipeline.texturing->texture = {64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    const auto byte = static_cast<std::uint8_t>(i % 4 == 0 ? 200 : 0);
    for (const std::uint8_t value : {byte, std::uint8_t{80}, byte, std::uint8_t{255}}) {
      pipeline.texturing->texture.texels.push_back(value);
    }
  }
  pipeline.texturing->filter = Filter::trilinear;
  const Picture picture = draw(c, pipeline);
  for (int x = 0; x < 16; ++x) {
    EXPECT_NEAR(color_at(picture, x, 8)[0], 50.0F / 255, 0x1p-7F) << x;
    EXPECT_NEAR(color_at(picture, x, 8)[1], 80.0F / 255, 0x1p-7F) << x;
  }
}

// With several samples, llvmpipe draws beside scissors (docs/findings.md).
TEST_P(GlPicture, HasOddSizesAndScissors) {
  cases::Case c = flat_case(4, {13, 7, 1});
  c.viewport = {-1, -2, 12, 7, 0, 1};
  add_flat(c, everything(), {1, 2, 3, 4});
  for (const int samples : is_softpipe() ? std::vector{1} : std::vector{1, 4}) {
    c.framebuffer.samples = samples;
    if (samples == 1) c.scissor = cases::Scissor{1, 2, 11, 3};
    if (samples > 1) c.scissor.reset();
    for (const bool resolves : {false, true}) {
      Pipeline pipeline;
      pipeline.resolves = resolves;
      pipeline.clear_depth = 0.75F;
      const Picture picture = draw(c, pipeline);
      for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 13; ++x) {
          const bool is_drawn = x < 11 && y < 5 && (!c.scissor || (x >= 1 && y >= 2));
          for (int s = 0; s < picture.size.samples; ++s) {
            EXPECT_EQ(color_at(picture, x, y, s), is_drawn ? Color({1, 2, 3, 4}) : Color(4));
            EXPECT_EQ(depth_at(picture, x, y, s), is_drawn ? 0.5F : 0.75F);
          }
        }
      }
    }
  }
}

TEST_P(GlPicture, MirrorsViewportsOfNegativeSize) {
  cases::Case c = flat_case();
  add_flat(c, left_of(5), {1, 2, 3, 4});
  c.viewport = {16, 0, -16, 16, 0, 1};
  const Picture picture = draw(c, {});
  for (int x = 0; x < 16; ++x) {
    EXPECT_EQ(color_at(picture, x, 3), x >= 11 ? Color({1, 2, 3, 4}) : Color(4));
  }
}

TEST_P(GlPicture, StoresUnormDepths) {
  cases::Case c = flat_case();
  c.depth_format = cases::DepthFormat::unorm16;
  add_flat(c, left_of(5, -0.5F), {1, 2, 3, 4});
  Pipeline pipeline;
  pipeline.clear_depth = 0.5F;
  const Picture picture = draw(c, pipeline);
  for (const int x : {0, 9}) {
    const float steps = depth_at(picture, x, 0) * 65535;
    EXPECT_NEAR(steps, std::round(steps), 0.01F);
    EXPECT_NEAR(steps, (x < 5 ? 0.25F : 0.5F) * 65535, 1);
  }
}

// Kills: a blend, write mask or depth function that stays set.
TEST_P(GlPicture, LeavesNoStateBehind) {
  cases::Case c = flat_case();
  add_flat(c, everything(), {1, 2, 3, 4});
  add_flat(c, left_of(5), {5, 6, 7, 8});
  const auto before = backend().draw_unjudged(c);
  ASSERT_TRUE(before);
  Pipeline pipeline;
  pipeline.blend = is_es() ? Blend::off : Blend::over;
  pipeline.depth_function = DepthFunction::never;
  pipeline.writes_depth = false;
  pipeline.clear_depth = 0;
  draw(c, pipeline);
  const auto after = backend().draw_unjudged(c);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->attributes, before->attributes);
  EXPECT_EQ(after->depth, before->depth);
  EXPECT_EQ(draw(c, {}).depth, Color(256, 0.5F));
}

TEST_P(GlPicture, RefusesWhatItDoesNotDraw) {
  Pipeline pipeline;
  cases::Case c = flat_case(3);
  add_flat(c, everything(), {1, 2, 3});
  pipeline.format = ColorFormat::rgba8;
  expect_refused(c, pipeline, "rgba8 needs four channels; the picture has 3", Failure::refused);
  pipeline = {};
  pipeline.blend = Blend::over;
  expect_refused(c, pipeline, "`over` needs four channels", Failure::refused);
  pipeline = {};
  pipeline.texturing = four_texels();
  pipeline.texturing->texture.height = 3;
  expect_refused(c, pipeline, "a texture of 2 x 3 texels cannot have 16 bytes", Failure::refused);
  c = flat_case(1);
  add_flat(c, everything(), {1});
  pipeline.texturing = four_texels();
  expect_refused(c, pipeline, "a texture needs two attributes; the case has 1", Failure::refused);
  pipeline = {};
  pipeline.shading = Shading::vertex_colors;
  expect_refused(c, pipeline, "vertex colours need three attributes", Failure::refused);
  c.rules = cases::Rules::d3d;
  expect_refused(c, {}, "rules of d3d");
  c.rules = cases::Rules::opengl;
  c.framebuffer.samples = 16;
  expect_refused(c, {}, "samples");
  c = flat_case(32, {8, 8, 1});
  add_flat(c, everything(), Color(32, 1.0F));
  c.framebuffer.samples = 4;
  if (!is_softpipe()) expect_refused(c, {}, "at most 28 channels here; the case needs 32");
}

INSTANTIATE_TEST_SUITE_P(Driver, GlPicture,
                         testing::Values("gl:llvmpipe", "gl:softpipe", "gl:llvmpipe,gles"),
                         test_name);

}  // namespace
}  // namespace rastercheck::backends::gl_picture_test
