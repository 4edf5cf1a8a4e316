// Tests the plumbing of backends/gl with Mesa's llvmpipe: the draw is the one that was requested,
// and the result is the one that was drawn. These tests do not check the driver's precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "backends/gl/context.h"
#include "tests/bench/gl/draw.h"
#include "tests/bench/gl/target.h"
#include "tests/bench/gl/texture.h"

// LeakSanitizer's tracer sometimes crashes, because Mesa's threads end while it inspects them.
extern "C" int __lsan_is_turned_off() { return 1; }

namespace rastercheck::backends::gl::bench::gl_test {
namespace {

using cases::ColorFormat;

constexpr int kSize = 16;

/// llvmpipe evaluates planes in float32, as sums of a few terms that stay below 16 for a target of
/// 16 × 16 pixels and values up to 1. So errors are about 2^-20. A tolerance of 2^-16 is generous,
/// and far below the effect of a swapped attribute, an inverted row or a viewport moved by a pixel.
constexpr float kTolerance = 0x1p-16F;

/// A right triangle with legs along window x and y, from (2, 2) to 14, with the same depth and w at
/// all vertices. Attribute 0 is (u − 2)/12, attribute 1 is (v − 2)/12, depth is 1/4.
struct OneTriangle {
  static constexpr float kLow = 2.0F * 2 / kSize - 1;
  static constexpr float kHigh = 2.0F * 14 / kSize - 1;
  std::array<cases::ClipVertex, 3> positions = {{{kLow * 2, kLow * 2, 0.5F, 2},
                                                 {kHigh * 2, kLow * 2, 0.5F, 2},
                                                 {kLow * 2, kHigh * 2, 0.5F, 2}}};
  std::array<float, 6> attributes = {0, 0, 1, 0, 0, 1};
  std::array<cases::Triangle, 1> triangles = {{{0, 1, 2}}};

  MeshView view() const { return {positions, attributes, triangles}; }
};

/// One llvmpipe context for all tests, without threads of its own.
class Gl : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    ::setenv("LP_NUM_THREADS", "0", 1);
    Result<Context> made = Context::create();
    if (made) {
      context_.emplace(*std::move(made));
    } else {
      reason_ = to_string(made.error());
    }
  }
  static void TearDownTestSuite() { context_.reset(); }

  void SetUp() override {
    if (!context_) GTEST_SKIP() << reason_;
    if (!context_->renderer().starts_with("llvmpipe")) {
      GTEST_SKIP() << "not llvmpipe but " << context_->renderer();
    }
  }

  /// The content of a target of this shape after a frame of the mesh.
  static Picture draw(const MeshView& view, const TargetShape& shape, const DrawState& state = {}) {
    const Target target = Target::create(*context_, shape).value();
    const Program program = Program::build(*context_, state).value();
    const Mesh mesh = Mesh::upload(*context_, view).value();
    return program.draw_frame(mesh, target).and_then([&] { return target.read(); }).value();
  }

  static std::optional<Context> context_;
  static std::string reason_;
};
std::optional<Context> Gl::context_;
std::string Gl::reason_;

/// Compares every sample's colour and depth with the plane. Samples within a pixel's diagonal of
/// the triangle's edges may be drawn or not.
void expect_one_triangle(const Picture& picture, float color_tolerance) {
  const int samples = picture.shape.samples;
  std::size_t i = 0;
  int inside = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      // For samples away from the centre, the attributes differ by up to half a pixel, 1/24.
      const float reach = samples == 1 ? 0 : 1.0F / 24;
      const float u = (static_cast<float>(x) + 0.5F - 2) / 12;
      const float v = (static_cast<float>(y) + 0.5F - 2) / 12;
      const float least = std::min({u, v, 1 - u - v});
      for (int s = 0; s < samples; ++s, ++i) {
        const Color& color = picture.color[i];
        if (least > 0.12F) {
          ++inside;
          EXPECT_NEAR(color[0], u, color_tolerance + reach) << x << ", " << y;
          EXPECT_NEAR(color[1], v, color_tolerance + reach) << x << ", " << y;
          EXPECT_EQ(color[2], 0);
          EXPECT_EQ(color[3], 1);
          EXPECT_NEAR(picture.depth[i], 0.25F, kTolerance);
        } else if (least < -0.12F) {
          EXPECT_EQ(color, (Color{})) << x << ", " << y;
          EXPECT_EQ(picture.depth[i], 1);
        }
      }
    }
  }
  EXPECT_GT(inside, 20 * samples);
}

TEST_F(Gl, DrawsATriangle) {
  expect_one_triangle(draw(OneTriangle().view(), {kSize, kSize, 1, ColorFormat::float32}),
                      kTolerance);
}

TEST_F(Gl, DrawsATriangleInBytes) {
  // A byte rounds to the nearest of 256 values, or to the one beside it.
  expect_one_triangle(draw(OneTriangle().view(), {kSize, kSize, 1, ColorFormat::rgba8}),
                      1.0F / 255);
}

TEST_F(Gl, ReadsEverySample) {
  const Picture picture = draw(OneTriangle().view(), {kSize, kSize, 4, ColorFormat::float32});
  expect_one_triangle(picture, kTolerance);
  // Along an edge, some pixels have samples on both sides.
  int split = 0;
  for (std::size_t i = 0; i < picture.depth.size(); i += 4) {
    const auto covered = std::count_if(&picture.depth[i], &picture.depth[i] + 4,
                                       [](float depth) { return depth < 1; });
    split += covered > 0 && covered < 4 ? 1 : 0;
  }
  EXPECT_GE(split, 6);
}

TEST_F(Gl, KeepsTheNearestFragment) {
  // Two triangles over the whole target, the nearer one first.
  const std::array<cases::ClipVertex, 6> positions = {{{-1, -1, 0.25F, 1},
                                                       {3, -1, 0.25F, 1},
                                                       {-1, 3, 0.25F, 1},
                                                       {-1, -1, 0.75F, 1},
                                                       {-1, 3, 0.75F, 1},
                                                       {3, -1, 0.75F, 1}}};
  const std::array<float, 12> attributes = {1, 0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 1};
  const std::array<cases::Triangle, 2> triangles = {{{0, 1, 2}, {3, 4, 5}}};
  const Picture picture = draw({positions, attributes, triangles}, {8, 4, 1});
  ASSERT_EQ(picture.color.size(), 32U);
  for (std::size_t i = 0; i < picture.color.size(); ++i) {
    EXPECT_NEAR(picture.color[i][0], 1, kTolerance);
    EXPECT_NEAR(picture.color[i][1], 0, kTolerance);
    EXPECT_NEAR(picture.depth[i], 0.25F, kTolerance);
  }
}

TEST_F(Gl, KeepsFloatsBeyondOne) {
  const std::array<cases::ClipVertex, 3> positions = {
      {{-1, -1, 0.5F, 1}, {3, -1, 0.5F, 1}, {-1, 3, 0.5F, 1}}};
  const std::array<float, 6> attributes = {-5, 7, -5, 7, -5, 7};
  const std::array<cases::Triangle, 1> triangles = {{{0, 1, 2}}};
  for (const int samples : {1, 4}) {
    const Picture picture =
        draw({positions, attributes, triangles}, {4, 4, samples, ColorFormat::float32});
    for (const Color& color : picture.color) {
      EXPECT_NEAR(color[0], -5, 8 * kTolerance);
      EXPECT_NEAR(color[1], 7, 8 * kTolerance);
    }
  }
}

TEST_F(Gl, ClearsTheTarget) {
  const Picture picture = draw({}, {3, 2, 1, ColorFormat::float32});
  EXPECT_EQ(picture.color, std::vector(6, Color{}));
  EXPECT_EQ(picture.depth, std::vector(6, 1.0F));
}

/// A square over the whole target for each of the depths, in that order. Attributes are (s, t) ·
/// `texture_size` or, without a texture, (1/4, 1/2).
struct Layers {
  explicit Layers(std::initializer_list<float> depths, float texture_size = 0) {
    for (const float depth : depths) {
      const auto first = static_cast<std::uint32_t>(positions.size());
      for (const auto& [s, t] : {std::pair{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 1.0F}}) {
        positions.push_back({2 * s - 1, 2 * t - 1, depth, 1});
        attributes.push_back(texture_size == 0 ? 0.25F : s * texture_size);
        attributes.push_back(texture_size == 0 ? 0.5F : t * texture_size);
      }
      triangles.push_back({first, first + 1, first + 2});
      triangles.push_back({first + 2, first + 1, first + 3});
    }
  }
  MeshView view() const { return {positions, attributes, triangles}; }

  std::vector<cases::ClipVertex> positions;
  std::vector<float> attributes;
  std::vector<cases::Triangle> triangles;
};

void expect_color(const Color& color, const Color& expected, float tolerance) {
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(color[i], expected[i], tolerance) << i;
}

TEST_F(Gl, BlendsInSubmissionOrder) {
  // A byte is rounded after each of the two layers.
  for (const auto& [format, tolerance] :
       {std::pair{ColorFormat::float32, kTolerance}, {ColorFormat::rgba8, 2.0F / 255}}) {
    DrawState state;
    state.depth_function = cases::DepthFunction::always;
    state.writes_depth = false;
    state.alpha = 0.5F;
    Layers layers({0.25F, 0.75F});
    // The second layer, which lies behind the first, has another colour.
    for (std::size_t i = 8; i < 16; i += 2) layers.attributes[i] = 0.75F;
    state.blend = cases::Blend::over;
    const Picture over = draw(layers.view(), {4, 4, 1, format}, state);
    state.blend = cases::Blend::additive;
    const Picture sum = draw(layers.view(), {4, 4, 1, format}, state);
    for (std::size_t i = 0; i < over.color.size(); ++i) {
      expect_color(over.color[i], {0.4375F, 0.375F, 0, 0.75F}, tolerance);
      expect_color(sum.color[i], {1, 1, 0, 1}, tolerance);
      EXPECT_EQ(over.depth[i], 1);
    }
  }
}

TEST_F(Gl, ComparesDepthsAsAsked) {
  // The depth that remains of 0.5, 0.25, 0.75 and again 0.75, cleared to 0.5.
  using enum cases::DepthFunction;
  const Layers layers({0.5F, 0.25F, 0.75F, 0.75F});
  for (const auto& [function, depth] : {std::pair{always, 0.75F},
                                        {never, 0.5F},
                                        {less, 0.25F},
                                        {equal, 0.5F},
                                        {less_or_equal, 0.25F},
                                        {greater, 0.75F},
                                        {not_equal, 0.75F},
                                        {greater_or_equal, 0.75F}}) {
    DrawState state;
    state.depth_function = function;
    state.clear_depth = 0.5F;
    const Picture picture = draw(layers.view(), {2, 2, 1}, state);
    EXPECT_NEAR(picture.depth[0], depth, kTolerance) << static_cast<int>(function);
    EXPECT_EQ(picture.color[0][3], function == never ? 0 : 1) << static_cast<int>(function);
    state.writes_depth = false;
    EXPECT_EQ(draw(layers.view(), {2, 2, 1}, state).depth[0], 0.5F) << static_cast<int>(function);
  }
}

TEST_F(Gl, KeepsTheFirstOfEqualDepthsUnlessAsked) {
  Layers layers({0.5F, 0.5F});
  for (std::size_t i = 8; i < 16; i += 2) layers.attributes[i] = 0.75F;
  DrawState state;
  EXPECT_NEAR(draw(layers.view(), {2, 2, 1}, state).color[0][0], 0.25F, kTolerance);
  state.depth_function = cases::DepthFunction::less_or_equal;
  EXPECT_NEAR(draw(layers.view(), {2, 2, 1}, state).color[0][0], 0.75F, kTolerance);
}

/// A texture of 4 × 2 texels, where texel k has red k/8 and alpha (k mod 2). Its smaller levels are
/// green.
class GlTexture : public Gl {
 protected:
  static constexpr std::uint32_t kGreen = 0xff00ff00;

  void SetUp() override {
    Gl::SetUp();
    if (IsSkipped()) return;
    std::array<std::uint32_t, 8> texels{};
    for (std::uint32_t k = 0; k < 8; ++k) texels[k] = (k % 2) * 0xff000000 + 32 * k;
    constexpr std::array<std::uint32_t, 2> kMiddle = {kGreen, kGreen};
    const std::array<TextureLevel, 3> levels = {
        {{4, 2, texels}, {2, 1, kMiddle}, {1, 1, std::span(kMiddle).first(1)}}};
    texture_.emplace(Texture::upload(*context_, levels).value());
  }
  void TearDown() override { texture_.reset(); }

  static DrawState state(const Texturing& texturing) {
    DrawState all;
    all.texturing = texturing;
    return all;
  }
  /// The red of texel k.
  static float red(int k) { return static_cast<float>(32 * k) / 255; }

  std::optional<Texture> texture_;
};

TEST_F(GlTexture, ReadsTheNearestTexelWrapped) {
  // Two copies along both axes, with a pixel for each texel.
  const Layers layers({0.5F}, 2);
  for (const auto& [wrap, columns, rows] :
       {std::tuple{cases::Wrap::repeat, std::array{0, 1, 2, 3, 0, 1, 2, 3}, std::array{0, 4, 0, 4}},
        {cases::Wrap::clamp, {0, 1, 2, 3, 3, 3, 3, 3}, {0, 4, 4, 4}},
        {cases::Wrap::mirror, {0, 1, 2, 3, 3, 2, 1, 0}, {0, 4, 4, 0}}}) {
    const Picture picture =
        draw(layers.view(), {8, 4, 1}, state({&*texture_, wrap, wrap, cases::Filter::nearest, {}}));
    for (std::size_t i = 0; i < 32; ++i) {
      const int k = rows[i / 8] + columns[i % 8];
      expect_color(picture.color[i], {red(k), 0, 0, static_cast<float>(k % 2)}, kTolerance);
    }
  }
}

TEST_F(GlTexture, FiltersBetweenCentres) {
  // A driver may keep only eight bits of the position between two texels.
  constexpr float kWeight = 1.0F / 256;
  const Picture picture = draw(Layers({0.5F}, 1).view(), {8, 4, 1},
                               state({&*texture_, {}, {}, cases::Filter::bilinear, {}}));
  // Pixel (3, 2) is at s = 3.5/8, which mixes texels 1 and 2 by 3 to 1, and at t = 2.5/4, which
  // mixes rows 0 and 1 by 1 to 3.
  const float expected =
      0.25F * (0.75F * red(1) + 0.25F * red(2)) + 0.75F * (0.75F * red(5) + 0.25F * red(6));
  EXPECT_NEAR(picture.color[2 * 8 + 3][0], expected, 2 * kWeight);
  EXPECT_NEAR(picture.color[2 * 8 + 3][3], 0.75F, 2 * kWeight);
}

TEST_F(GlTexture, ReadsLevelsAsTheyWereHandedOver) {
  // A pixel is two texels wide and high, or four.
  const DrawState trilinear = state({&*texture_, {}, {}, cases::Filter::trilinear, {}});
  for (const Picture& picture : {draw(Layers({0.5F}, 1).view(), {2, 1, 1}, trilinear),
                                 draw(Layers({0.5F}, 2).view(), {2, 1, 1}, trilinear)}) {
    for (const Color& color : picture.color) expect_color(color, {0, 1, 0, 1}, 1.0F / 255);
  }
}

TEST_F(GlTexture, DiscardsWhatHasLittleAlpha) {
  const Picture picture = draw(Layers({0.5F}, 1).view(), {4, 2, 1},
                               state({&*texture_, {}, {}, cases::Filter::nearest, 0.5F}));
  for (int k = 0; k < 8; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (k % 2 == 0) {
      EXPECT_EQ(picture.color[i], Color{});
      EXPECT_EQ(picture.depth[i], 1);
    } else {
      expect_color(picture.color[i], {red(k), 0, 0, 1}, kTolerance);
      EXPECT_NEAR(picture.depth[i], 0.5F, kTolerance);
    }
  }
}

TEST_F(GlTexture, RefusesLevelsThatAreNone) {
  const std::array<std::uint32_t, 4> texels{};
  const auto upload = [&](std::initializer_list<TextureLevel> levels) {
    return Texture::upload(*context_, levels).has_value();
  };
  EXPECT_FALSE(upload({}));
  EXPECT_FALSE(upload({{0, 2, {}}}));
  EXPECT_FALSE(upload({{2, 1, texels}}));
  EXPECT_FALSE(upload({{2, 2, texels}, {2, 1, std::span(texels).first(2)}}));
  EXPECT_TRUE(upload({{2, 2, texels}, {1, 1, std::span(texels).first(1)}}));
}

TEST_F(Gl, RefusesWhatItCannotDraw) {
  EXPECT_FALSE(Target::create(*context_, {0, 4, 1}));
  EXPECT_FALSE(Target::create(*context_, {1 << 20, 4, 1}));
  EXPECT_FALSE(Target::create(*context_, {4, 4, 3}));
  OneTriangle triangle;
  triangle.triangles[0][1] = 3;
  EXPECT_FALSE(Mesh::upload(*context_, triangle.view()));
  EXPECT_FALSE(Mesh::upload(*context_, {triangle.positions, {}, triangle.triangles}));
  // A refusal leaves no error behind that the next call would report as its own.
  expect_one_triangle(draw(OneTriangle().view(), {kSize, kSize, 1}), kTolerance);
}

}  // namespace
}  // namespace rastercheck::backends::gl::bench::gl_test
