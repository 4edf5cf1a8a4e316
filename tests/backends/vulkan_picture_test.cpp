// Draws pictures that are known by hand, with the validation layer on. Any message from that layer
// fails the picture.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/backends/drivers.h"

namespace rastercheck::backends::vulkan_picture_test {
namespace {

using cases::Blend;
using cases::ColorFormat;
using cases::DepthFunction;
using cases::Filter;
using cases::Interpolation;
using cases::Shading;
using cases::Wrap;
using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

constexpr int kWidth = 8;
constexpr int kHeight = 4;
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;

/// A triangle parallel to the screen, which covers all pixels or those left of window x = `right`.
struct Sheet {
  float z = 0.5F;
  std::vector<float> values;  ///< of flat attributes
  float right = 2 * kWidth;
};

cases::Case case_of(const std::vector<Sheet>& sheets) {
  cases::Case c;
  c.framebuffer = {kWidth, kHeight, 1};
  c.viewport = {0, 0, kWidth, kHeight, 0, 1};
  for (std::size_t k = 0; k < sheets.front().values.size(); ++k) {
    c.attributes.push_back({"a", Interpolation::flat});
  }
  for (const Sheet& sheet : sheets) {
    const auto first = static_cast<std::uint32_t>(c.positions.size());
    const float right = sheet.right * 2 / kWidth - 1;
    c.positions.insert(
        c.positions.end(),
        {{right, -16, sheet.z, 1}, {right, 16, sheet.z, 1}, {right - 16, 0, sheet.z, 1}});
    for (int v = 0; v < 3; ++v) {
      c.attribute_values.insert(c.attribute_values.end(), sheet.values.begin(), sheet.values.end());
    }
    c.triangles.push_back({first, first + 1, first + 2});
  }
  return c;
}

/// A triangle over all pixels whose attributes are linear in window x and y: a + b x + c y.
cases::Case plane(const std::vector<std::array<float, 3>>& coefficients) {
  cases::Case c = case_of({{0.5F, std::vector<float>(coefficients.size(), 0.0F)}});
  c.positions = {{-1, -1, 0.5F, 1}, {3, -1, 0.5F, 1}, {-1, 3, 0.5F, 1}};
  c.attribute_values.clear();
  for (const auto& [x, y] :
       {std::array{0.0F, 0.0F}, {2.0F * kWidth, 0.0F}, {0.0F, 2.0F * kHeight}}) {
    for (const auto& [a, b, slope_y] : coefficients) {
      c.attribute_values.push_back(a + b * x + slope_y * y);
    }
  }
  for (cases::Attribute& a : c.attributes) a.interpolation = Interpolation::smooth;
  return c;
}

class VulkanPictures : public DriverTest {
 protected:
  Result<cases::Picture> try_draw(const cases::Case& c, const cases::Pipeline& pipeline) const {
    PictureDrawer* const drawer = backend().picture_drawer();
    if (drawer == nullptr) return tl::unexpected(Error{"", "", "draws no pictures"});
    return drawer->draw_picture(c, pipeline);
  }
  cases::Picture draw(const cases::Case& c, const cases::Pipeline& pipeline) const {
    Result<cases::Picture> drawn = try_draw(c, pipeline);
    EXPECT_TRUE(drawn) << to_string(drawn.error());
    return drawn ? *std::move(drawn) : cases::Picture();
  }
  /// The reason why a picture is not drawn.
  std::string refusal(const cases::Case& c, const cases::Pipeline& pipeline,
                      Failure failure = Failure::refused) const {
    const Result<cases::Picture> drawn = try_draw(c, pipeline);
    if (drawn) return "drawn";
    EXPECT_EQ(drawn.error().failure, failure) << to_string(drawn.error());
    return drawn.error().reason;
  }
};

/// The colour of a pixel's sample, as many floats as the picture has channels.
std::vector<float> color_at(const cases::Picture& picture, int x, int y, int sample = 0) {
  const int at = (y * picture.size.width + x) * picture.size.samples + sample;
  const auto begin = picture.color.begin() + static_cast<std::ptrdiff_t>(picture.channels) *
                                                 static_cast<std::ptrdiff_t>(at);
  return {begin, begin + static_cast<std::ptrdiff_t>(picture.channels)};
}

float depth_at(const cases::Picture& picture, int x, int y, int sample = 0) {
  return picture.depth[static_cast<std::size_t>(
      (y * picture.size.width + x) * picture.size.samples + sample)];
}

INSTANTIATE_TEST_SUITE_P(Drivers, VulkanPictures,
                         testing::Values("vulkan:lavapipe,validate", "vulkan:swiftshader,validate"),
                         test_name);

TEST_P(VulkanPictures, ShowClearValuesWhereNothingIsDrawn) {
  cases::Pipeline pipeline;
  pipeline.clear_depth = 0.75F;
  const cases::Picture picture = draw(case_of({{0.5F, {1, 2}, 3}}), pipeline);
  EXPECT_EQ(picture.size, (cases::FramebufferSize{kWidth, kHeight, 1}));
  EXPECT_EQ(picture.channels, 2);
  ASSERT_EQ(picture.color.size(), 2 * kPixels);
  ASSERT_EQ(picture.depth.size(), kPixels);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(color_at(picture, x, y),
                x < 3 ? (std::vector<float>{1, 2}) : (std::vector<float>{0, 0}));
      EXPECT_EQ(depth_at(picture, x, y), x < 3 ? 0.5F : 0.75F);
    }
  }
  cases::Case none = case_of({{0.5F, {1, 2}}});
  none.triangles.clear();
  EXPECT_THAT(draw(none, pipeline).depth, Each(0.75F));
  EXPECT_THAT(draw(none, pipeline).color, Each(0.0F));
}

// Kills: another compare operation; ignoring the write mask; drawing in another order.
TEST_P(VulkanPictures, HeedTheDepthFunctionAndTheWriteMask) {
  const cases::Case c = case_of({{0.5F, {1}}, {0.25F, {2}}, {0.75F, {3}}, {0.5F, {4}}});
  struct Expected {
    DepthFunction function;
    float color;            ///< with depth writes
    float depth;            ///< likewise
    float color_unwritten;  ///< without depth writes; the depth is then the clear depth, 0.5
  };
  for (const Expected& e : {Expected{DepthFunction::always, 4, 0.5F, 4},
                            {DepthFunction::never, 0, 0.5F, 0},
                            {DepthFunction::less, 2, 0.25F, 2},
                            {DepthFunction::equal, 4, 0.5F, 4},
                            {DepthFunction::less_or_equal, 2, 0.25F, 4},
                            {DepthFunction::greater, 3, 0.75F, 3},
                            {DepthFunction::not_equal, 4, 0.5F, 3},
                            {DepthFunction::greater_or_equal, 3, 0.75F, 4}}) {
    SCOPED_TRACE(static_cast<int>(e.function));
    cases::Pipeline pipeline;
    pipeline.depth_function = e.function;
    pipeline.clear_depth = 0.5F;
    const cases::Picture written = draw(c, pipeline);
    EXPECT_THAT(written.color, Each(e.color));
    EXPECT_THAT(written.depth, Each(e.depth));
    pipeline.writes_depth = false;
    const cases::Picture unwritten = draw(c, pipeline);
    EXPECT_THAT(unwritten.color, Each(e.color_unwritten));
    EXPECT_THAT(unwritten.depth, Each(0.5F));
  }
}

TEST_P(VulkanPictures, IgnoreTheDepthTestOfTheCase) {
  cases::Case c = case_of({{0.25F, {1}}, {0.5F, {2}}});
  c.depth_test = cases::DepthTest::less;
  c.depth_clear = 0.125F;
  cases::Pipeline pipeline;
  pipeline.depth_function = DepthFunction::always;
  EXPECT_THAT(draw(c, pipeline).color, Each(2.0F));
}

TEST_P(VulkanPictures, Blend) {
  const cases::Case c =
      case_of({{0.5F, {1, 0.5F, 0.25F, 0.5F}}, {0.25F, {0, 1, 1, 0.25F}}, {0.75F, {9, 9, 9, 1}}});
  cases::Pipeline pipeline;
  pipeline.blend = Blend::over;
  EXPECT_THAT(color_at(draw(c, pipeline), 2, 1), ElementsAre(0.375F, 0.4375F, 0.34375F, 0.625F));
  pipeline.blend = Blend::additive;
  EXPECT_THAT(color_at(draw(c, pipeline), 2, 1), ElementsAre(1, 1.5F, 1.25F, 0.75F));
  // Channels that are no colour are added as well, and nothing is clamped.
  cases::Pipeline always = pipeline;
  always.depth_function = DepthFunction::always;
  EXPECT_THAT(
      color_at(draw(case_of({{0.5F, {-1, 2, 3, 4, 5}}, {0.5F, {-1, 2, 3, 4, 5}}}), always), 2, 1),
      ElementsAre(-2, 4, 6, 8, 10));
}

TEST_P(VulkanPictures, HaveBytes) {
  cases::Pipeline pipeline;
  pipeline.format = ColorFormat::rgba8;
  constexpr float kByte = 51.0F / 255;
  const cases::Case c = case_of({{0.5F, {-1, kByte, 2, 0}}, {0.5F, {0.25F, 3 * kByte, 2, 1}}});
  EXPECT_THAT(color_at(draw(c, pipeline), 0, 0), ElementsAre(0, kByte, 1, 0));
  pipeline.depth_function = DepthFunction::always;
  pipeline.blend = Blend::additive;
  // 1/4 is between the bytes 63 and 64.
  EXPECT_THAT(color_at(draw(c, pipeline), 0, 0),
              ElementsAre(FloatNear(0.25F, 0.75F / 255), 204.0F / 255, 1, 1));
  pipeline.blend = Blend::over;
  const cases::Case opaque = case_of({{0.5F, {1, 0, kByte, 1}}, {0.5F, {0, kByte, 1, 0}}});
  EXPECT_THAT(color_at(draw(opaque, pipeline), 0, 0), ElementsAre(1, 0, kByte, 1));
}

// Of the four standard samples, those with indices 0 and 2 are left of the pixel's centre.
TEST_P(VulkanPictures, HaveSamplesAndTheirMean) {
  for (const ColorFormat format : {ColorFormat::float32, ColorFormat::rgba8}) {
    cases::Pipeline pipeline;
    pipeline.format = format;
    constexpr float kStep = 51.0F / 255;
    cases::Case c = case_of({{0.5F, {2 * kStep, 4 * kStep, 0, 2 * kStep}, 1.5F}});
    c.framebuffer.samples = 4;
    const cases::Picture samples = draw(c, pipeline);
    EXPECT_EQ(samples.size.samples, 4);
    ASSERT_EQ(samples.depth.size(), 4 * kPixels);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int s = 0; s < 4; ++s) {
          const bool is_drawn = x == 0 || (x == 1 && s % 2 == 0);
          EXPECT_EQ(color_at(samples, x, y, s)[1], is_drawn ? 4 * kStep : 0) << x << " " << s;
          EXPECT_EQ(depth_at(samples, x, y, s), is_drawn ? 0.5F : 1);
        }
      }
    }
    pipeline.resolves = true;
    const cases::Picture resolved = draw(c, pipeline);
    EXPECT_EQ(resolved.size, (cases::FramebufferSize{kWidth, kHeight, 1}));
    ASSERT_EQ(resolved.color.size(), 4 * kPixels);
    ASSERT_EQ(resolved.depth.size(), kPixels);
    for (int y = 0; y < kHeight; ++y) {
      EXPECT_THAT(color_at(resolved, 0, y), ElementsAre(2 * kStep, 4 * kStep, 0, 2 * kStep));
      EXPECT_THAT(color_at(resolved, 1, y), ElementsAre(kStep, 2 * kStep, 0, kStep));
      EXPECT_THAT(color_at(resolved, 2, y), Each(0.0F));
      EXPECT_EQ(depth_at(resolved, 1, y), 0.5F);
      EXPECT_EQ(depth_at(resolved, 2, y), 1);
    }
  }
}

TEST_P(VulkanPictures, AreUnchangedByResolvingOneSample) {
  cases::Pipeline pipeline;
  const cases::Case c = case_of({{0.5F, {1, 2, 3, 4}, 3}});
  const cases::Picture picture = draw(c, pipeline);
  pipeline.resolves = true;
  EXPECT_EQ(draw(c, pipeline).color, picture.color);
}

// Kills: a channel that takes another attribute; groups of channels with different coverage.
TEST_P(VulkanPictures, HaveAChannelForEachAttribute) {
  constexpr std::array kKinds{Interpolation::smooth, Interpolation::noperspective,
                              Interpolation::flat};
  constexpr std::array kPlaces{cases::Location::sample, cases::Location::center,
                               cases::Location::centroid};
  for (const int samples : {1, 4}) {
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{6}, std::size_t{9}, cases::kMaxAttributes}) {
      std::vector<float> values;
      for (std::size_t k = 0; k < count; ++k) values.push_back(static_cast<float>(k + 1));
      cases::Case c = case_of({{0.75F, std::vector<float>(count, 9.0F)}, {0.5F, values}});
      c.framebuffer.samples = samples;
      for (std::size_t k = 0; k < count; ++k) {
        c.attributes[k].interpolation = kKinds[k % 3];
        c.attributes[k].location = kPlaces[k / 3 % 3];
      }
      const cases::Picture picture = draw(c, cases::Pipeline());
      EXPECT_EQ(picture.channels, count);
      EXPECT_EQ(picture.color.size(), count * kPixels * static_cast<std::size_t>(samples));
      EXPECT_THAT(picture.depth, Each(0.5F));
      for (std::size_t i = 0; i < picture.color.size(); ++i) {
        EXPECT_NEAR(picture.color[i], static_cast<float>(i % count + 1), 1e-4);
      }
    }
  }
}

TEST_P(VulkanPictures, ShowVertexColors) {
  cases::Pipeline pipeline;
  pipeline.shading = Shading::vertex_colors;
  const cases::Picture opaque = draw(case_of({{0.5F, {0.5F, 0.25F, 2}}}), pipeline);
  EXPECT_EQ(opaque.channels, 4);
  EXPECT_THAT(color_at(opaque, 1, 1), ElementsAre(0.5F, 0.25F, 2, 1));
  const cases::Picture first = draw(case_of({{0.5F, {0.5F, 0.25F, 2, 3, 4}}}), pipeline);
  EXPECT_THAT(color_at(first, 1, 1), ElementsAre(0.5F, 0.25F, 2, 3));
}

TEST_P(VulkanPictures, ShowDifferences) {
  cases::Case c = plane({{1, 2, 0}, {-5, 0, 3}, {7, 1, -4}});
  cases::Pipeline pipeline;
  for (const int samples : {1, 4}) {
    c.framebuffer.samples = samples;
    pipeline.shading = Shading::differences_along_x;
    const cases::Picture along_x = draw(c, pipeline);
    pipeline.shading = Shading::differences_along_y;
    const cases::Picture along_y = draw(c, pipeline);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        EXPECT_THAT(color_at(along_x, x, y),
                    ElementsAre(FloatNear(2, 1e-4F), FloatNear(0, 1e-4F), FloatNear(1, 1e-4F)));
        EXPECT_THAT(color_at(along_y, x, y),
                    ElementsAre(FloatNear(0, 1e-4F), FloatNear(3, 1e-4F), FloatNear(-4, 1e-4F)));
      }
    }
  }
  // With perspective, each pair of pixels has its own difference.
  c.framebuffer.samples = 1;
  c.positions[1] = {12, -4, 2, 4};
  pipeline.shading = Shading::differences_along_x;
  const cases::Picture differences = draw(c, pipeline);
  pipeline.shading = Shading::attributes;
  const cases::Picture values = draw(c, pipeline);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; x += 2) {
      const float difference = color_at(values, x + 1, y)[0] - color_at(values, x, y)[0];
      EXPECT_NEAR(color_at(differences, x, y)[0], difference, 1e-4);
      EXPECT_NEAR(color_at(differences, x + 1, y)[0], difference, 1e-4);
    }
  }
}

TEST_P(VulkanPictures, ShowFacingAndWindowCoordinates) {
  cases::Case c = plane({});
  for (cases::ClipVertex& p : c.positions) p = {2 * p.x, 2 * p.y, 2 * p.z, 2};
  cases::Pipeline pipeline;
  pipeline.shading = Shading::window_coordinates;
  const cases::Picture coordinates = draw(c, pipeline);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_THAT(color_at(coordinates, x, y),
                  ElementsAre(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F,
                              FloatNear(0.5F, 1e-6F), FloatNear(0.5F, 1e-6F)));
    }
  }
  // The vertices turn clockwise where y points down.
  pipeline.shading = Shading::facing;
  for (const bool is_clockwise : {false, true}) {
    c.front_face = is_clockwise ? cases::FrontFace::cw : cases::FrontFace::ccw;
    const float front = is_clockwise ? 1 : 0;
    EXPECT_THAT(color_at(draw(c, pipeline), 3, 2), ElementsAre(front, front, front, 1));
  }
}

// Kills: another attribute than the last; differences taken after discarding; a later group of
// channels without the attribute that discards.
TEST_P(VulkanPictures, DiscardByTheLastAttribute) {
  const cases::Case c = plane({{1, 2, 0}, {0, 0, 1}, {0, 0, 0}, {4, 0, 0}, {5, 0, 0}, {0, 1, 0}});
  cases::Pipeline pipeline;
  pipeline.discard_below = 3;
  const cases::Picture values = draw(c, pipeline);
  pipeline.shading = Shading::differences_along_x;
  const cases::Picture differences = draw(c, pipeline);
  for (int x = 0; x < kWidth; ++x) {
    const bool is_drawn = x >= 3;
    EXPECT_EQ(depth_at(values, x, 1), is_drawn ? 0.5F : 1);
    EXPECT_NEAR(color_at(values, x, 1)[4], is_drawn ? 5 : 0, 1e-4F);
    EXPECT_NEAR(color_at(differences, x, 1)[0], is_drawn ? 2 : 0, 1e-4F);
    EXPECT_NEAR(color_at(differences, x, 1)[5], is_drawn ? 1 : 0, 1e-4F);
  }
  EXPECT_THAT(refusal(plane({}), pipeline), HasSubstr("discarding needs"));
}

/// Two by two texels. Alpha is 0 in the second column.
cases::Texture small_texture() {
  return {2, 2, {10, 20, 30, 255, 40, 50, 60, 0, 70, 80, 90, 255, 100, 110, 120, 0}};
}

std::vector<float> texel(const cases::Texture& texture, int column, int row) {
  std::vector<float> color;
  for (int k = 0; k < 4; ++k) {
    color.push_back(
        static_cast<float>(
            texture.texels[static_cast<std::size_t>(4 * (row * texture.width + column) + k)]) /
        255);
  }
  return color;
}

// Pixel x is at the centre of texel x − 2, and pixel y at that of texel y − 1.
TEST_P(VulkanPictures, WrapTextures) {
  constexpr std::array<std::array<int, kWidth>, 3> kColumns{
      {{0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 0, 1, 1, 1, 1, 1}, {1, 0, 0, 1, 1, 0, 0, 1}}};
  constexpr std::array<std::array<int, kHeight>, 3> kRows{
      {{1, 0, 1, 0}, {0, 0, 1, 1}, {0, 0, 1, 1}}};
  const cases::Case c = plane({{-1, 0.5F, 0}, {-0.5F, 0, 0.5F}, {9, 9, 9}});
  cases::Pipeline pipeline;
  pipeline.texturing.emplace();
  pipeline.texturing->texture = small_texture();
  for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
    pipeline.texturing->filter = filter;
    for (const Wrap wrap_s : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
      for (const Wrap wrap_t : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
        pipeline.texturing->wrap_s = wrap_s;
        pipeline.texturing->wrap_t = wrap_t;
        const cases::Picture picture = draw(c, pipeline);
        EXPECT_EQ(picture.channels, 4);
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            const int column =
                kColumns[static_cast<std::size_t>(wrap_s)][static_cast<std::size_t>(x)];
            const int row = kRows[static_cast<std::size_t>(wrap_t)][static_cast<std::size_t>(y)];
            // At a texel's centre, bilinear filtering gives nearly the texel's colour.
            EXPECT_THAT(color_at(picture, x, y),
                        testing::Pointwise(FloatNear(filter == Filter::nearest ? 1e-7F : 0.002F),
                                           texel(pipeline.texturing->texture, column, row)))
                << x << " " << y;
          }
        }
      }
    }
  }
}

TEST_P(VulkanPictures, FilterTextures) {
  // Coordinates of texels go from −1/2 to 7/2 along x, and stay at 1/2 along y.
  const cases::Case c = plane({{-0.25F, 0.25F, 0}, {0.5F, 0, 0}});
  cases::Pipeline pipeline;
  cases::Texturing& texturing = pipeline.texturing.emplace();
  texturing.texture = {2, 1, {0, 255, 51, 102, 255, 0, 51, 204}};
  texturing.wrap_s = Wrap::clamp;
  texturing.filter = Filter::bilinear;
  const cases::Picture picture = draw(c, pipeline);
  for (int x = 0; x < kWidth; ++x) {
    // The fraction of the way between the centres of the texels.
    const float way = x == 0 ? 0 : x == 1 ? 0 : x == 2 ? 0.25F : x == 3 ? 0.75F : 1;
    const std::vector<float> color = color_at(picture, x, 1);
    EXPECT_NEAR(color[0], way, 0.005F);
    EXPECT_NEAR(color[1], 1 - way, 0.005F);
    EXPECT_NEAR(color[2], 0.2F, 0.001F);
    EXPECT_NEAR(color[3], 0.4F + 0.4F * way, 0.005F);
  }
}

// Three texels become one in the next level, whose centre has the whole texture's mean.
TEST_P(VulkanPictures, FilterSmallerLevels) {
  const cases::Case c = plane({{0, 4, 0}, {0.5F, 0, 0}});
  cases::Pipeline pipeline;
  cases::Texturing& texturing = pipeline.texturing.emplace();
  texturing.texture = {3, 1, {0, 0, 0, 255, 30, 3, 1, 255, 90, 6, 0, 255}};
  texturing.filter = Filter::trilinear;
  const cases::Picture picture = draw(c, pipeline);
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_THAT(
        color_at(picture, x, 2),
        testing::Pointwise(FloatNear(1e-6F), std::vector<float>{40.0F / 255, 3.0F / 255, 0, 1}));
  }
}

TEST_P(VulkanPictures, DiscardWhatIsTransparent) {
  const cases::Case c = plane({{-1, 0.5F, 0}, {-0.5F, 0, 0.5F}});
  cases::Pipeline pipeline;
  cases::Texturing& texturing = pipeline.texturing.emplace();
  texturing.texture = small_texture();
  pipeline.discard_below = 0.5F;
  const cases::Picture picture = draw(c, pipeline);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(depth_at(picture, x, y), x % 2 == 0 ? 0.5F : 1);
      EXPECT_EQ(color_at(picture, x, y)[3], x % 2 == 0 ? 1.0F : 0.0F);
    }
  }
  // An alpha equal to the limit is drawn.
  pipeline.discard_below = 0.0F;
  EXPECT_THAT(draw(c, pipeline).depth, Each(0.5F));
}

TEST_P(VulkanPictures, HeedTheStateOfTheCase) {
  cases::Case c = case_of({{0.5F, {1}, 3}});
  c.scissor = {1, 1, 5, 2};
  // A viewport of negative width shows the triangle at the other side.
  for (const bool is_turned : {false, true}) {
    if (is_turned) c.viewport = {kWidth, 0, -kWidth, kHeight, 0, 1};
    const cases::Picture picture = draw(c, cases::Pipeline());
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool is_inside = x >= 1 && x < 6 && y >= 1 && y < 3 && (is_turned ? x >= 5 : x < 3);
        EXPECT_EQ(color_at(picture, x, y)[0], is_inside ? 1 : 0) << x << " " << y;
      }
    }
  }
  c.cull = cases::Cull::front;
  const bool front_is_drawn = draw(c, cases::Pipeline()).color != std::vector<float>(kPixels);
  c.cull = cases::Cull::back;
  EXPECT_NE(front_is_drawn, draw(c, cases::Pipeline()).color != std::vector<float>(kPixels));
}

TEST_P(VulkanPictures, HaveDepthsAsStored) {
  for (const int samples : {1, 4}) {
    cases::Case c = case_of({{0.3F, {1}}});
    c.depth_format = cases::DepthFormat::unorm16;
    c.framebuffer.samples = samples;
    // 0.3 · 65535 is 19660.5, halfway between two numbers.
    const cases::Picture picture = draw(c, cases::Pipeline());
    EXPECT_THAT(picture.depth, Each(testing::AnyOf(19660.0F / 65535, 19661.0F / 65535)));
  }
}

TEST_P(VulkanPictures, AreRefusedWithoutMeaning) {
  cases::Pipeline bytes;
  bytes.format = ColorFormat::rgba8;
  EXPECT_EQ(refusal(case_of({{0.5F, {1, 2, 3}}}), bytes),
            "rgba8 needs four channels, the picture has 3");
  cases::Pipeline over;
  over.blend = Blend::over;
  EXPECT_EQ(refusal(case_of({{0.5F, {1, 2, 3, 4, 5}}}), over),
            "blending `over` needs four channels, the picture has 5");
  cases::Pipeline colors;
  colors.shading = Shading::vertex_colors;
  EXPECT_THAT(refusal(case_of({{0.5F, {1, 2}}}), colors), HasSubstr("three attributes"));
  cases::Pipeline textured;
  textured.texturing.emplace();
  textured.texturing->texture = small_texture();
  EXPECT_THAT(refusal(case_of({{0.5F, {1}}}), textured), HasSubstr("two attributes"));
  textured.texturing->texture.texels.pop_back();
  EXPECT_EQ(refusal(case_of({{0.5F, {1, 2}}}), textured),
            "a texture of 2 x 2 texels needs four bytes for each, it has 15");
}

TEST_P(VulkanPictures, AreRefusedIfTheDeviceCannotDrawThem) {
  cases::Case c = case_of({{0.5F, {1}}});
  c.rules = cases::Rules::d3d;
  EXPECT_EQ(refusal(c, cases::Pipeline(), Failure::unsupported), "it lacks the rules of D3D");
  c = case_of({{0.5F, {1}}});
  cases::Pipeline pipeline;
  pipeline.clear_depth = 2;
  EXPECT_EQ(refusal(c, pipeline, Failure::unsupported), "it lacks the initial depth 2: 0 to 1");
  c.framebuffer = {cases::kMaxSize, cases::kMaxSize, 1};
  EXPECT_NE(refusal(c, cases::Pipeline(), Failure::unsupported), "drawn");
  // The device still draws after that.
  EXPECT_THAT(draw(case_of({{0.5F, {1}}}), cases::Pipeline()).color, Each(1.0F));
}

}  // namespace
}  // namespace rastercheck::backends::vulkan_picture_test
