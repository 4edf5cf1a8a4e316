// The plumbing of backends/gl through Mesa's llvmpipe: that what is asked for is what is drawn and
// read back. How precise the driver is, is not asked here.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "backends/gl/context.h"
#include "backends/gl/draw.h"
#include "backends/gl/target.h"

namespace rastercheck::backends::gl {
namespace {

constexpr int kSize = 16;

/// llvmpipe evaluates planes in float32, as sums of a few terms that on a target of 16 × 16 with
/// values up to 1 stay below 16: errors of some 2^-20. 2^-16 is generous to that, and far below
/// what a swapped attribute, a row turned over or a pixel's shift of the viewport make.
constexpr float kTolerance = 0x1p-16F;

/// A right triangle, legs along window x and y from (2, 2) to 14, with depth and w the same at all
/// vertices: attribute 0 is (u − 2)/12, attribute 1 is (v − 2)/12, depth 1/4.
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

/// One context for all tests, of llvmpipe without threads of its own.
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

  /// What a target of that kind holds after a frame of the mesh.
  static Picture draw(const MeshView& view, const TargetShape& shape) {
    const Target target = Target::create(*context_, shape).value();
    const Program program = Program::build(*context_).value();
    const Mesh mesh = Mesh::upload(*context_, view).value();
    return program.draw_frame(mesh, target).and_then([&] { return target.read(); }).value();
  }

  static std::optional<Context> context_;
  static std::string reason_;
};
std::optional<Context> Gl::context_;
std::string Gl::reason_;

/// Every sample's colour and depth against the plane, for samples further than a pixel's diagonal
/// from the triangle's edges; the others may be either.
void expect_one_triangle(const Picture& picture, float color_tolerance) {
  const int samples = picture.shape.samples;
  std::size_t i = 0;
  int inside = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      // Of samples beside the centre the attributes are off by half a pixel, 1/24, at most.
      const float reach = samples == 1 ? 0 : 1.0F / 24;
      const float u = (static_cast<float>(x) + 0.5F - 2) / 12;
      const float v = (static_cast<float>(y) + 0.5F - 2) / 12;
      const float least = std::min({u, v, 1 - u - v});
      for (int s = 0; s < samples; ++s, ++i) {
        const std::array<float, 4>& color = picture.color[i];
        if (least > 0.12F) {
          ++inside;
          EXPECT_NEAR(color[0], u, color_tolerance + reach) << x << ", " << y;
          EXPECT_NEAR(color[1], v, color_tolerance + reach) << x << ", " << y;
          EXPECT_EQ(color[2], 0);
          EXPECT_EQ(color[3], 1);
          EXPECT_NEAR(picture.depth[i], 0.25F, kTolerance);
        } else if (least < -0.12F) {
          EXPECT_EQ(color, (std::array<float, 4>{})) << x << ", " << y;
          EXPECT_EQ(picture.depth[i], 1);
        }
      }
    }
  }
  EXPECT_GT(inside, 20 * samples);
}

TEST_F(Gl, DrawsATriangle) {
  expect_one_triangle(draw(OneTriangle().view(), {kSize, kSize, 1, ColorFormat::rgba32f}),
                      kTolerance);
}

TEST_F(Gl, DrawsATriangleInBytes) {
  // A byte rounds to the nearest of 256 values; where it may not, to one beside it.
  expect_one_triangle(draw(OneTriangle().view(), {kSize, kSize, 1, ColorFormat::rgba8}),
                      1.0F / 255);
}

TEST_F(Gl, ReadsEverySample) {
  const Picture picture = draw(OneTriangle().view(), {kSize, kSize, 4, ColorFormat::rgba32f});
  expect_one_triangle(picture, kTolerance);
  // Along an edge some pixels have samples on both sides.
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
        draw({positions, attributes, triangles}, {4, 4, samples, ColorFormat::rgba32f});
    for (const std::array<float, 4>& color : picture.color) {
      EXPECT_NEAR(color[0], -5, 8 * kTolerance);
      EXPECT_NEAR(color[1], 7, 8 * kTolerance);
    }
  }
}

TEST_F(Gl, ClearsTheTarget) {
  const Picture picture = draw({}, {3, 2, 1, ColorFormat::rgba32f});
  EXPECT_EQ(picture.color, std::vector(6, std::array<float, 4>{}));
  EXPECT_EQ(picture.depth, std::vector(6, 1.0F));
}

TEST_F(Gl, RefusesWhatItCannotDraw) {
  EXPECT_FALSE(Target::create(*context_, {0, 4, 1}));
  EXPECT_FALSE(Target::create(*context_, {1 << 20, 4, 1}));
  EXPECT_FALSE(Target::create(*context_, {4, 4, 3}));
  OneTriangle triangle;
  triangle.triangles[0][1] = 3;
  EXPECT_FALSE(Mesh::upload(*context_, triangle.view()));
  EXPECT_FALSE(Mesh::upload(*context_, {triangle.positions, {}, triangle.triangles}));
  // A refusal leaves nothing behind that the next call would take for its own.
  expect_one_triangle(draw(OneTriangle().view(), {kSize, kSize, 1}), kTolerance);
}

}  // namespace
}  // namespace rastercheck::backends::gl
