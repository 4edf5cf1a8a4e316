// Draws into framebuffers with all depth functions, blends and formats, and with shaders. Each
// sample must be what its fragments, in order, leave there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "rasterizer/shading.h"
#include "rasterizer/texture.h"
#include "tests/rasterizer/exact.h"
#include "tests/rasterizer/failing_allocator.h"
#include "tests/rasterizer/kept_frame.h"
#include "tests/rasterizer/random_draw.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer::shaded_frame_test {
namespace {

/// Sets any depth function, depth write and blend.
void set_output(Random& random, State& state) {
  state.depth_test = random.pick({DepthTest::always, DepthTest::never, DepthTest::less,
                                  DepthTest::equal, DepthTest::less_or_equal, DepthTest::greater,
                                  DepthTest::not_equal, DepthTest::greater_or_equal});
  state.depth_write = !random.one_in(3);
  state.blend = random.pick({Blend::off, Blend::over, Blend::additive});
  if (state.blend == Blend::over && state.attributes.size() != 4) state.blend = Blend::additive;
}

/// A multiple of 1/256 from `low` to `high`.
float between(Random& random, int low, int high) {
  return static_cast<float>(random.between(256 * low, 256 * high)) / 256;
}

/// Triangles whose depths are often equal, with values in and around [0, 1].
SmallMesh flat_triangles(Random& random, const State& state, int count) {
  SmallMesh mesh;
  int extent = 0;
  glm::vec2 corner(0, 0);
  for (int i = 0; i < 3 * count; ++i) {
    const float depth = random.pick({0.25F, 0.5F, 0.5F, 0.75F});
    if (i % 3 == 0) {
      // Some triangles are small, some lie over a tile's corner, and some have corners at samples.
      extent = random.pick({180, 180, 9, 3});
      corner = {between(random, -5, 130), between(random, -5, 130)};
      if (random.one_in(3)) corner = {60, 61};
      if (extent > 9) corner = {-20, -20};
    }
    glm::vec2 p = corner + glm::vec2(between(random, 0, extent), between(random, 0, extent));
    if (random.one_in(3)) p = {std::floor(p.x) + 0.5F, std::floor(p.y) + 0.5F};
    mesh.positions.push_back(at(state, p.x, p.y, random.pick({1.0F, 1.0F, 0.5F, 3.0F}), depth));
    for (std::size_t a = 0; a < state.attributes.size(); ++a) {
      mesh.attributes.push_back(random.one_in(4) ? random.real(-70, 2) : between(random, 0, 1));
    }
    if (i % 3 == 0) {
      const auto first = static_cast<std::uint32_t>(i);
      mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
  }
  return mesh;
}

class ShadeOnTarget : public testing::TestWithParam<std::int64_t> {};
INSTANTIATE_TEST_SUITE_P(AllTargets, ShadeOnTarget, testing::ValuesIn(all_targets()), target_name);

// Kills: a depth function confused with another; colours blended in the wrong order or with the
// wrong alpha; one rounding after several blends; helper lanes that are drawn; cells that overlap
// at a tile's right border.
TEST_P(ShadeOnTarget, LeavesWhatFragmentsLeaveByEveryFunction) {
  const OnTarget on_target(GetParam());
  Random random(11);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const TargetSize size{random.pick({1, 63, 64, 64, 64, 100, 129}),
                          random.pick({2, 64, 64, 64, 65, 100}), random.pick({1, 1, 2, 4})};
    State state =
        small_state(size.width, size.height,
                    random.pick({Convention::opengl, Convention::vulkan, Convention::d3d}));
    state.attributes.resize(static_cast<std::size_t>(random.pick({1, 2, 4, 4, 4})));
    set_output(random, state);
    const bool has_bytes = state.attributes.size() == 4 && random.one_in(2);
    const auto format = has_bytes ? ColorFormat::rgba8 : ColorFormat::float32;
    expect_kept(state, flat_triangles(random, state, 40).mesh(), size, format);
    if (HasFatalFailure()) return;
  }
}

// Kills: lanes evaluated differently from fragments; rows drawn by the row kernels although the
// lanes draw them too.
TEST_P(ShadeOnTarget, LeavesWhatFragmentsLeaveOfAnyDraw) {
  const OnTarget on_target(GetParam());
  Random random(12);
  for (int i = 0; i < 120; ++i) {
    SCOPED_TRACE(i);
    RandomDraw draw = random_draw(random);
    set_output(random, draw.state);
    expect_kept(draw.state, draw.mesh.mesh(), draw.size);
    if (HasFatalFailure()) return;
  }
}

// Kills: the value of a plane at a sample that lies at a vertex of a small triangle, and must have
// the vertex's values.
TEST_P(ShadeOnTarget, SamplesAtCornersHaveTheValuesOfVertices) {
  const OnTarget on_target(GetParam());
  Random random(15);
  State state = small_state(64, 64);
  state.attributes.resize(2);
  state.depth_test = DepthTest::always;
  SmallMesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const glm::vec2 first(random.between(0, 56), random.between(0, 56));
    for (int corner = 0; corner < 3; ++corner) {
      mesh.positions.push_back(at(state, first.x + static_cast<float>(random.between(0, 7)) + 0.5F,
                                  first.y + static_cast<float>(random.between(0, 7)) + 0.5F,
                                  random.pick({1.0F, 0.5F, 0.7F, 3.0F})));
      for (int a = 0; a < 2; ++a) mesh.attributes.push_back(random.real(-70, 2));
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  expect_kept(state, mesh.mesh(), {64, 64, 1});
}

/// A colour at or next to a point where the rounding to bytes changes.
float hard_color(Random& random) {
  const auto byte = static_cast<float>(random.between(0, 255));
  const float middle = (byte + 0.5F) / 255;
  const float infinity = std::numeric_limits<float>::infinity();
  return random.pick({0.0F, -0.0F, 1.0F, 0.5F, 0.5F, 0.25F, std::nextafter(0.5F, 0.0F),
                      std::nextafter(0.5F, 1.0F), byte / 255, byte / 256, middle,
                      std::nextafter(middle, 0.0F), std::nextafter(middle, 1.0F), -1.0F, 2.0F,
                      infinity, -infinity, std::numeric_limits<float>::quiet_NaN(),
                      std::numeric_limits<float>::denorm_min()});
}

// Kills: bytes rounded twice; halves rounded up; sums of bytes that are not clamped to 255; float32
// used where it cannot tell two bytes apart.
TEST_P(ShadeOnTarget, RoundsHardColorsToTheNearestByte) {
  const OnTarget on_target(GetParam());
  Random random(13);
  for (const Blend blend : {Blend::off, Blend::additive, Blend::over}) {
    State state = small_state(64, 64);
    state.blend = blend;
    state.depth_test = DepthTest::always;
    state.attributes.resize(4, {Interpolation::flat});
    for (int i = 0; i < 150; ++i) {
      SmallMesh mesh = flat_triangles(random, state, random.between(1, 8));  // more: all 255
      for (float& value : mesh.attributes) value = hard_color(random);
      expect_kept(state, mesh.mesh(), {64, 64, 1}, ColorFormat::rgba8);
      if (HasFatalFailure()) return;
    }
  }
}

/// A shader that does not say whether it discards.
struct SilentShader {
  TexturedShader shader;
  std::size_t outputs() const { return shader.outputs(); }
  bool uses_derivatives() const { return shader.uses_derivatives(); }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const { shader(in, out); }
};

// Kills: a shaded triangle that is not the visible one at a sample; marks of one sample or tile
// used for another; derivatives of another triangle.
TEST_P(ShadeOnTarget, ShadingOnlyWhatIsSeenChangesNothing) {
  const OnTarget on_target(GetParam());
  Random random(14);
  std::vector<std::uint8_t> texels(std::size_t{32} * 32 * 4);
  for (std::uint8_t& byte : texels) byte = static_cast<std::uint8_t>(random.between(0, 255));
  Texture texture;
  ASSERT_EQ(Texture::make(32, 32, texels, texture), std::nullopt);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const TargetSize size{random.pick({63, 64, 100}), random.pick({64, 65}), random.pick({1, 4})};
    State state = small_state(size.width, size.height);
    state.attributes.resize(2);
    set_output(random, state);
    state.blend = Blend::off;
    const SmallMesh mesh = flat_triangles(random, state, 30);
    const Filter filter = random.pick({Filter::nearest, Filter::trilinear});
    const TexturedShader shader{.texture = &texture, .sampler = {.filter = filter}};
    Picture seen;
    Picture all;
    seen.format = all.format = random.pick({ColorFormat::rgba8, ColorFormat::float32});
    const float depth = random.pick({0.5F, 0.6F});
    ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), shader, size, depth, seen).error);
    ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), SilentShader{shader}, size, depth, all).error);
    expect_equal(seen, all);
    if (HasFatalFailure()) return;
  }
}

/// A shader that discards everything, and says that it discards only if `says_so`.
struct WrongShader {
  bool says_so = false;
  std::size_t outputs() const { return 1; }
  bool discards() const { return says_so; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const {
    std::fill_n(out.color[0], in.lanes, 1.0F);
    for (std::size_t lane = 0; lane < in.lanes; ++lane) out.discard(lane);
  }
};

TEST(Shade, DiscardingByAShaderThatDoesNotHasNoEffect) {
  State state = small_state(8, 8);
  state.attributes.clear();
  const SmallMesh mesh = rectangle(state, {0, 0}, {8, 8});
  for (const Blend blend : {Blend::off, Blend::additive}) {
    state.blend = blend;
    for (const bool says_so : {false, true}) {
      Picture drawn;
      ASSERT_FALSE(
          clear_and_draw(state, mesh.mesh(), WrongShader{says_so}, {8, 8, 1}, 1, drawn).error);
      EXPECT_EQ(drawn.attributes[9], says_so ? 0.0F : 1.0F);
      EXPECT_EQ(drawn.depth[9], says_so ? 1.0F : 0.0F);
    }
  }
}

/// Keeps the lanes whose first value is at least `least`, and paints their positions.
struct PlacePainter {
  double least = 0;
  std::size_t outputs() const { return 2; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const {
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      const FragmentBatch::Cell& cell = in.cells[lane / FragmentBatch::kCellLanes];
      out.color[0][lane] = static_cast<float>(cell.x + lane % 8);
      out.color[1][lane] = static_cast<float>(cell.y + lane / 8 % 2);
      if (in.values[0][lane] < least) out.discard(lane);
    }
  }
};

TEST(Shade, DiscardsAndSaysWhereLanesAre) {
  State state = small_state(100, 70);
  state.attributes.resize(1);
  SmallMesh mesh = rectangle(state, {3, 5}, {95, 61});
  for (const glm::vec4& p : mesh.positions) mesh.attributes.push_back((p.x + 1) * 50);
  Picture framebuffer;
  ASSERT_FALSE(
      clear_and_draw(state, mesh.mesh(), PlacePainter{40}, {100, 70, 1}, 1, framebuffer).error);
  for (std::size_t y = 0; y < 70; ++y) {
    for (std::size_t x = 0; x < 100; ++x) {
      const bool is_drawn = y >= 5 && y < 61 && x >= 40 && x < 95;
      const std::size_t place = 100 * y + x;
      EXPECT_EQ(framebuffer.depth[place], is_drawn ? 0.0F : 1.0F);
      EXPECT_EQ(framebuffer.attributes[2 * place], is_drawn ? static_cast<float>(x) : 0);
      EXPECT_EQ(framebuffer.attributes[2 * place + 1], is_drawn ? static_cast<float>(y) : 0);
    }
  }
}

/// Paints facing, depth, 1/w, and the first value.
struct AskingPainter {
  std::size_t outputs() const { return 4; }
  bool discards() const { return false; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const {
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      const FragmentBatch::Cell& cell = in.cells[lane / FragmentBatch::kCellLanes];
      if ((cell.covered >> lane % FragmentBatch::kCellLanes & 1) == 0) continue;
      out.color[0][lane] = in.exact->is_front(lane) ? 1 : -1;
      out.color[1][lane] = in.exact->depth(lane);
      out.color[2][lane] = static_cast<float>(in.exact->reciprocal_w(lane));
      out.color[3][lane] = static_cast<float>(in.values[0][lane]);
    }
  }
};

// Kills: facing, depth or 1/w of another triangle or lane; w in place of 1/w; facing that is not
// the one that culling goes by.
TEST(Shade, TellsFacingDepthAndReciprocalW) {
  Random random(17);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const TargetSize size{random.pick({40, 100}), random.pick({30, 70}), random.pick({1, 4})};
    State state = small_state(size.width, size.height);
    state.attributes = {{.interpolation = Interpolation::noperspective}};
    state.cull = random.pick({Cull::back, Cull::front});
    state.front_face = random.pick({FrontFace::ccw, FrontFace::cw});
    if (random.one_in(3)) state.snapping = Snapping{};
    SmallMesh mesh;
    for (std::uint32_t v = 0; v < 30; ++v) {
      const float w = random.pick({0.5F, 1.0F, 2.0F, 4.0F});
      mesh.positions.push_back(at(state, between(random, 0, size.width),
                                  between(random, 0, size.height), w, between(random, 0, 1)));
      mesh.attributes.push_back(1 / w);
      if (v % 3 == 0) mesh.triangles.emplace_back(v, v + 1, v + 2);
    }
    Picture drawn;
    ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), AskingPainter(), size, 2, drawn).error);
    for (std::size_t at_sample = 0; at_sample < drawn.depth.size(); ++at_sample) {
      if (drawn.depth[at_sample] == 2) continue;
      const float* const shown = &drawn.attributes[4 * at_sample];
      EXPECT_EQ(shown[0], state.cull == Cull::back ? 1 : -1);
      EXPECT_EQ(shown[1], drawn.depth[at_sample]);
      EXPECT_NEAR(shown[2], shown[3], 0x1p-20F * std::max(1.0F, std::abs(shown[3])));
    }
  }
}

/// Paints the differences within quads and the derivatives, both along x.
struct SlopePainter {
  std::size_t outputs() const { return 2; }
  bool uses_derivatives() const { return true; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const {
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      const double difference = in.values[0][lane | 1] - in.values[0][lane & ~std::size_t{1}];
      out.color[0][lane] = static_cast<float>(difference);
      out.color[1][lane] = static_cast<float>(in.along_u[0][lane]);
    }
  }
};

// For a plane, differences and derivatives are equal everywhere, also where helpers lie beyond the
// triangle's edges.
TEST(Shade, QuadsHaveTheValuesOfHelpers) {
  State state = small_state(64, 64);
  state.attributes = {{Interpolation::noperspective}};
  SmallMesh mesh = triangle(state, {3.3F, 5.1F}, {50.7F, 9.2F}, {20.4F, 60.9F});
  mesh.attributes = {0, 6, 1};
  Picture framebuffer;
  ASSERT_FALSE(
      clear_and_draw(state, mesh.mesh(), SlopePainter(), {64, 64, 1}, 1, framebuffer).error);
  std::size_t drawn = 0;
  for (std::size_t place = 0; place < framebuffer.depth.size(); ++place) {
    if (framebuffer.depth[place] == 1) continue;
    ++drawn;
    EXPECT_NEAR(framebuffer.attributes[2 * place], framebuffer.attributes[2 * place + 1], 1e-6);
    EXPECT_NE(framebuffer.attributes[2 * place], 0);
  }
  EXPECT_GT(drawn, 1000U);
}

/// Paints ⌊8 r⌋ by exact arithmetic and by double alone.
struct FloorPainter {
  std::size_t outputs() const { return 2; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const {
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      const auto bit = lane % FragmentBatch::kCellLanes;
      const std::uint32_t covered = in.cells[lane / FragmentBatch::kCellLanes].covered;
      const bool is_covered = (covered >> bit & 1) != 0;
      out.color[0][lane] = is_covered ? static_cast<float>(in.exact->floor(
                                            0, lane, 8, std::numeric_limits<double>::infinity()))
                                      : 0;
      out.color[1][lane] = static_cast<float>(std::floor(8 * in.values[0][lane]));
    }
  }
};

// Triangles with r = k / 64 at column k, whose weights double cannot hold.
TEST(Shade, FloorsAreExact) {
  State state = small_state(64, 64);
  state.attributes = {{Interpolation::noperspective}};
  Random random(3);
  std::size_t differ = 0;
  for (int i = 0; i < 100; ++i) {
    SmallMesh mesh;
    for (int corner = 0; corner < 3; ++corner) {
      const int column = random.between(0, 60);
      mesh.positions.push_back(at(state, static_cast<float>(column) + 0.5F,
                                  static_cast<float>(random.between(0, 64)),
                                  static_cast<float>(random.between(1, 9))));
      mesh.attributes.push_back(static_cast<float>(column) / 64);
    }
    mesh.triangles = {{0, 1, 2}};
    Picture framebuffer;
    ASSERT_FALSE(
        clear_and_draw(state, mesh.mesh(), FloorPainter(), {64, 64, 1}, 1, framebuffer).error);
    for (std::size_t place = 0; place < framebuffer.depth.size(); ++place) {
      if (framebuffer.depth[place] == 1) continue;
      EXPECT_EQ(framebuffer.attributes[2 * place], static_cast<float>(place % 64 / 8));
      if (framebuffer.attributes[2 * place] != framebuffer.attributes[2 * place + 1]) ++differ;
    }
  }
  EXPECT_GT(differ, 0U);  // otherwise the test shows nothing
}

/// Paints the column, 0 or 1, of the nearest texel: as sampled, by exact arithmetic and by double.
struct ColumnPainter {
  const Texture* texture = nullptr;

  std::size_t outputs() const { return 4; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const {
    sample(*texture, {Wrap::repeat, Wrap::repeat, Filter::nearest}, in, 0, 0, out.color.first<4>());
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      const auto bit = lane % FragmentBatch::kCellLanes;
      const std::uint32_t covered = in.cells[lane / FragmentBatch::kCellLanes].covered;
      if ((covered >> bit & 1) == 0) continue;
      out.color[1][lane] = static_cast<float>(std::fmod(in.exact->floor(0, lane, 2, 2), 2));
      out.color[2][lane] = static_cast<float>(std::fmod(std::floor(2 * in.values[0][lane]), 2));
    }
  }
};

/// A triangle up to six units high about a clip y. Its values are 0 at y and 3/8 more with every
/// unit; double cannot hold its weights.
SmallMesh flat_triangle(Random& random, float y, float unit) {
  SmallMesh mesh;
  for (const int side : {-1, 0, 1}) {
    const float w = random.pick({1.0F, 2.0F, 4.0F});
    const auto units = static_cast<float>(side * random.between(1, 3));
    const float x = side == 1 ? random.real(-45, -30) : static_cast<float>(2 * side + 1) * 0.9F;
    mesh.positions.emplace_back(x * w, (y + unit * units) * w, 0.0F, w);
    mesh.attributes.push_back(3 * units / 8);
  }
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// Draws these triangles, whose values are evaluated far beyond the triangles, on borders of
/// texels, and expects the exact columns.
void expect_exact_columns(const State& state, float y, float unit, int samples) {
  const std::array<std::uint8_t, 8> texels{0, 0, 0, 255, 255, 0, 0, 255};
  Texture texture;
  ASSERT_FALSE(Texture::make(2, 1, texels, texture));
  Random random(5);
  std::size_t drawn = 0;
  std::size_t differ = 0;
  for (int i = 0; i < 100; ++i) {
    const SmallMesh mesh = flat_triangle(random, y, unit);
    Picture framebuffer;
    ASSERT_FALSE(clear_and_draw(state, mesh.mesh(), ColumnPainter{&texture}, {64, 64, samples}, 1,
                                framebuffer)
                     .error);
    for (std::size_t place = 0; place < framebuffer.depth.size(); ++place) {
      if (framebuffer.depth[place] == 1) continue;
      ++drawn;
      const float* const columns = &framebuffer.attributes[4 * place];
      EXPECT_EQ(columns[0], columns[1]);
      if (columns[2] != columns[1]) ++differ;
    }
  }
  EXPECT_GT(drawn, 100U);
  EXPECT_GT(differ, 0U);  // otherwise the test shows nothing
}

// The triangles lie about a row of samples, 3/8 of a pixel from the centres. The values at the
// centres are 2^23 times those of the vertices, and so are their errors. Kills: an error estimated
// only as a share of the vertices' values.
TEST(Shade, TexelsAtCentersBeyondTheTriangleAreExact) {
  State state = small_state(64, 64);
  state.attributes = {{Interpolation::noperspective, Location::center}};
  expect_exact_columns(state, 0x1p-8F, 0x1p-31F, 4);
}

// The triangles lie between two rows of a grid of 1/16 pixel, with the centres on one of these
// rows. The values there are 2^21 times those of the vertices.
TEST(Shade, TexelsBeyondTheTriangleThatIsSnappedAreExact) {
  State state = small_state(64, 64);
  state.attributes = {{Interpolation::noperspective}};
  state.snapping = Snapping{4};
  state.basis = Basis::ideal;
  state.viewport.origin.y = 0.5F;
  expect_exact_columns(state, 0x1p-10F, 0x1p-33F, 1);
}

TEST(Shade, RefusesWhatItCannotDo) {
  State state = small_state(4, 4);
  state.attributes.resize(3);
  const SmallMesh mesh = [&state] {
    SmallMesh made = rectangle(state, {0, 0}, {4, 4});
    made.attributes.resize(made.positions.size() * 3);
    return made;
  }();
  Picture framebuffer;
  const auto draw_as = [&](const State& by, std::size_t count, ColorFormat format) {
    framebuffer.format = format;
    return clear_and_draw(by, mesh.mesh(), AttributesShader{count}, {4, 4, 1}, 1, framebuffer)
        .error;
  };
  EXPECT_EQ(draw_as(state, 3, ColorFormat::rgba8), Error::color_format);
  State over = state;
  over.blend = Blend::over;
  EXPECT_EQ(draw_as(over, 3, ColorFormat::float32), Error::color_format);
  EXPECT_EQ(draw_as(state, kMaxAttributes + 1, ColorFormat::float32), Error::output_count);
  ASSERT_EQ(clear(framebuffer, {4, 4, 1}, 2, 1), std::nullopt);
  EXPECT_EQ(draw(state, mesh.mesh(), AttributesShader{3}, framebuffer).error, Error::output_count);
  const Mesh most{mesh.positions, mesh.attributes, {}, {mesh.triangles.data(), kMaxTriangles + 1}};
  EXPECT_EQ(draw(state, most, AttributesShader{2}, framebuffer).error, Error::triangle_count);
}

TEST(Shade, RunningOutOfMemoryLosesNothingThatWasDrawn) {
  if (!kCanRunOutOfMemory) GTEST_SKIP() << "the allocator is that of ThreadSanitizer";
  State state = small_state(70, 70);
  state.attributes.resize(2);
  state.depth_test = DepthTest::less_or_equal;
  Random random(5);
  const SmallMesh first = flat_triangles(random, state, 4);
  const SmallMesh second = flat_triangles(random, state, 4);
  Picture before;
  ASSERT_EQ(clear(before, {70, 70, 1}, 2, 1), std::nullopt);
  ASSERT_FALSE(draw(state, first.mesh(), before).error);
  const Picture both = kept(state, second.mesh(), before);
  bool succeeded = false;
  int failures = 0;
  for (int allocations = 0; !succeeded && allocations < 1000; ++allocations) {
    Picture drawn = before;
    const std::optional<Error> error =
        with_allocations(allocations, [&] { return draw(state, second.mesh(), drawn).error; });
    succeeded = !error;
    failures += error == Error::out_of_memory ? 1 : 0;
    for (std::size_t i = 0; i < drawn.depth.size(); ++i) {
      EXPECT_TRUE(drawn.depth[i] == before.depth[i] || drawn.depth[i] == both.depth[i]);
    }
  }
  EXPECT_TRUE(succeeded);
  EXPECT_GT(failures, 5);
}

}  // namespace
}  // namespace rastercheck::rasterizer::shaded_frame_test
