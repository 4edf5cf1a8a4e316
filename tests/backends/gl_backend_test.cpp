// Tests the backend `gl` with the drivers that this machine has: the drawing must be what the case
// asks for, shown by fragments that are known by hand. Campaigns find out how precise a driver is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "tests/backends/assembled_cases.h"
#include "tests/backends/drivers.h"
#include "tests/backends/lines_and_points.h"
#include "tests/backends/stored_depth.h"
#include "tests/backends/ways.h"
#include "tests/backends/window_cases.h"

// LeakSanitizer's tracer sometimes crashes, because Mesa's threads end while it inspects them.
extern "C" int __lsan_is_turned_off() { return 1; }

namespace rastercheck::backends::gl_backend_test {
namespace {

using cases::Interpolation;
using cases::Location;
using testing::HasSubstr;

/// Attributes have values up to 16 here. The errors of planes in float32 stay far below this
/// tolerance, while a wrong corner, row or qualifier causes a larger difference.
constexpr float kTolerance = 0x1p-10F;

using Pixels = std::set<std::pair<int, int>>;
Pixels pixels_where(const std::function<bool(int, int)>& is_there) {
  Pixels pixels;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      if (is_there(x, y)) pixels.insert({x, y});
    }
  }
  return pixels;
}

class GlBackend : public DriverTest {
 protected:
  cases::Fragments draw(const cases::Case& c) const {
    Result<cases::Fragments> drawn = fragments_of(backend().draw(c));
    EXPECT_TRUE(drawn) << to_string(drawn.error());
    return drawn.value_or(cases::Fragments());
  }
  /// The pixels of the fragments. Expects at most one fragment per pixel.
  static Pixels pixels(const cases::Fragments& drawn) {
    Pixels all;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      EXPECT_TRUE(all.insert({drawn.x[i], drawn.y[i]}).second);
    }
    return all;
  }
  bool is_es() const { return std::string(GetParam()).find("gles") != std::string::npos; }
  bool is_softpipe() const { return std::string(GetParam()).find("softpipe") != std::string::npos; }
  void expect_unsupported(const cases::Case& c, const std::string& what) const {
    const auto drawn = backend().draw(c);
    ASSERT_FALSE(drawn) << what;
    EXPECT_EQ(drawn.error().failure, Failure::unsupported);
    EXPECT_THAT(drawn.error().reason, HasSubstr(what));
  }
};

TEST_P(GlBackend, SaysWhatDraws) {
  const std::string name = is_softpipe() ? "softpipe" : "llvmpipe";
  EXPECT_THAT(backend().about().description, testing::StartsWith(name));
  ASSERT_TRUE(backend().about().driver);
  EXPECT_EQ(backend().about().driver->name, name);
  EXPECT_THAT(backend().about().driver->version, testing::StartsWith("Mesa "));
  EXPECT_TRUE(backend().about().has_limits);
  EXPECT_TRUE(backend().contract(empty_case()).coverage);
}

TEST_P(GlBackend, DrawsWhatATriangleCovers) {
  for (const auto rules : {cases::Rules::opengl, cases::Rules::vulkan}) {
    cases::Case c = empty_case(rules);
    add(c, everything());
    add(c, left_of(5));
    // Above a horizontal line, as OpenGL displays it. With both rules, these are the rows of
    // greater y.
    add(c, {at(-24, 11), at(40, 11), at(8, 100)});
    const cases::Fragments drawn = draw(c);
    std::array<Pixels, 3> covered;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      covered.at(drawn.triangle[i]).insert({drawn.x[i], drawn.y[i]});
      EXPECT_EQ(drawn.sample[i], 0);
    }
    EXPECT_EQ(covered[0].size(), 256U);
    EXPECT_EQ(covered[1], pixels_where([](int x, int) { return x < 5; }));
    EXPECT_EQ(covered[2], pixels_where([](int, int y) { return y >= 11; }));
    EXPECT_EQ(drawn.size(), 256U + 80 + 80);
  }
}

TEST_P(GlBackend, DrawsNothingOfNothing) {
  cases::Case c = empty_case();
  EXPECT_EQ(draw(c).size(), 0U);
  add(c, {at(2, 2), at(2, 2), at(2, 2)});
  EXPECT_EQ(draw(c).size(), 0U);
}

// There are more triangles than layers, and they come in order.
TEST_P(GlBackend, NumbersManyTriangles) {
  cases::Case c = empty_case();
  c.attributes = {{"number", Interpolation::flat, Location::sample}};
  for (int t = 0; t < 256; ++t) {
    const auto x = static_cast<float>(t % 16);
    const auto y = static_cast<float>(t / 16);
    const auto value = static_cast<float>(t);
    add(c, {at(x + 0.25F, y + 0.25F), at(x + 1, y + 0.25F), at(x + 0.25F, y + 1)},
        {value, value, value});
  }
  const cases::Fragments drawn = draw(c);
  ASSERT_EQ(drawn.size(), 256U);
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_EQ(drawn.triangle[i], i);
    EXPECT_EQ(drawn.x[i], i % 16);
    EXPECT_EQ(drawn.y[i], i / 16);
    EXPECT_EQ(drawn.attributes[i], static_cast<float>(i));
  }
}

TEST_P(GlBackend, CopiesFlatValuesToTheBit) {
  // Without subnormal values, which drivers may flush.
  const std::vector<float> first = {-0.0F, FLT_MAX, 0.1F, -0x1p-126F, 1};
  const std::vector<float> last = {0x1.fffffep-1F, -FLT_MAX, 1e-30F, 7, -1e30F};
  for (const auto rules : {cases::Rules::opengl, cases::Rules::vulkan}) {
    cases::Case c = empty_case(rules);
    for (int i = 0; i < 5; ++i) {
      c.attributes.push_back({"a", Interpolation::flat, Location::sample});
    }
    std::vector<float> values = first;
    values.insert(values.end(), 5, 3);
    values.insert(values.end(), last.begin(), last.end());
    add(c, everything(), values);
    if (is_es() && rules == cases::Rules::vulkan) {
      expect_unsupported(c, "flat values from the last vertex");
      continue;
    }
    const cases::Fragments drawn = draw(c);
    ASSERT_EQ(drawn.size(), 256U);
    const std::vector<float>& expected = rules == cases::Rules::opengl ? last : first;
    for (std::size_t i = 0; i < drawn.attributes.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(drawn.attributes[i]),
                std::bit_cast<std::uint32_t>(expected[i % 5]));
    }
  }
}

TEST_P(GlBackend, InterpolatesAsDeclared) {
  cases::Case c = empty_case();
  c.attributes = {{"smooth", Interpolation::smooth, Location::sample}};
  if (!is_es())
    c.attributes.push_back({"straight", Interpolation::noperspective, Location::center});
  const std::size_t count = c.attributes.size();
  std::vector<float> values(3 * count);
  for (std::size_t a = 0; a < count; ++a) values[count + a] = 1;
  add(c, {at(0, 0), at(2 * kSide, 0, 0, 3), at(0, 2 * kSide)}, values);
  const cases::Fragments drawn = draw(c);
  ASSERT_EQ(drawn.size(), 256U);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    // The second vertex, with value 1 and w = 3, has this weight in the window.
    const float weight = (static_cast<float>(drawn.x[i]) + 0.5F) / (2 * kSide);
    EXPECT_NEAR(drawn.attributes_of(i)[0], weight / (3 - 2 * weight), kTolerance);
    if (count > 1) {
      EXPECT_NEAR(drawn.attributes_of(i)[1], weight, kTolerance);
    }
  }
}

TEST_P(GlBackend, HasEveryOfManyAttributes) {
  cases::Case c = empty_case();
  std::vector<float> values;
  for (int i = 0; i < 32; ++i) {
    const auto interpolation = i % 3 == 0               ? Interpolation::flat
                               : i % 3 == 1 && !is_es() ? Interpolation::noperspective
                                                        : Interpolation::smooth;
    c.attributes.push_back({"a", interpolation, Location::sample});
  }
  for (int i = 0; i < 96; ++i) values.push_back(static_cast<float>(i % 32) / 2);
  add(c, everything(), values);
  const cases::Fragments drawn = draw(c);
  ASSERT_EQ(drawn.size(), 256U);
  for (std::size_t i = 0; i < drawn.attributes.size(); ++i) {
    EXPECT_NEAR(drawn.attributes[i], static_cast<float>(i % 32) / 2, kTolerance);
  }
}

TEST_P(GlBackend, MapsDepth) {
  // In OpenGL, z = 0 is half way; in Vulkan, it is at the near plane.
  for (const auto& [rules, near, far, depth] :
       {std::tuple{cases::Rules::opengl, 0.0F, 1.0F, 0.625F},
        {cases::Rules::opengl, 0.75F, 0.25F, 0.4375F},
        {cases::Rules::vulkan, 0.0F, 1.0F, 0.25F},
        {cases::Rules::vulkan, 1.0F, 0.5F, 0.875F}}) {
    cases::Case c = empty_case(rules);
    c.viewport.min_depth = near;
    c.viewport.max_depth = far;
    add(c, everything(0.25F));
    for (const float z : draw(c).depth) EXPECT_NEAR(z, depth, kTolerance);
  }
}

TEST_P(GlBackend, ClampsDepthWhereAsked) {
  cases::Case c = empty_case();
  add(c, everything(1.5F));
  EXPECT_EQ(draw(c).size(), 0U);
  c.depth_clamp = true;
  const cases::Fragments drawn = draw(c);
  ASSERT_EQ(drawn.size(), 256U);
  for (const float z : drawn.depth) EXPECT_EQ(z, 1);
}

TEST_P(GlBackend, KeepsTheNearestFragment) {
  cases::Case c = empty_case();
  c.attributes = {{"number", Interpolation::flat, Location::sample}};
  c.depth_test = cases::DepthTest::less;
  add(c, everything(1), {0, 0, 0});  // drawn where nothing is nearer, at depth 1
  add(c, everything(1), {1, 1, 1});  // not nearer
  std::vector<cases::ClipVertex> left = left_of(6);
  for (cases::ClipVertex& corner : left) corner.z = 0.5F;
  add(c, left, {2, 2, 2});
  const cases::Fragments drawn = draw(c);
  ASSERT_EQ(drawn.size(), 256U);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    // Ordered by triangle, then row by row.
    const bool is_first = i < 160;
    EXPECT_EQ(drawn.triangle[i], is_first ? 0U : 2U);
    EXPECT_EQ(drawn.x[i], is_first ? 6 + i % 10 : (i - 160) % 6);
    EXPECT_EQ(drawn.y[i], is_first ? i / 10 : (i - 160) / 6);
    EXPECT_EQ(drawn.attributes[i], is_first ? 0 : 2);
    EXPECT_NEAR(drawn.depth[i], is_first ? 1 : 0.75F, kTolerance);
  }
}

TEST_P(GlBackend, CullsByWhatIsDisplayed) {
  // This triangle is counter-clockwise as OpenGL displays it, with y up, and clockwise as Vulkan
  // does.
  for (const auto rules : {cases::Rules::opengl, cases::Rules::vulkan}) {
    for (const auto front : {cases::FrontFace::ccw, cases::FrontFace::cw}) {
      cases::Case c = empty_case(rules);
      c.front_face = front;
      add(c, everything());
      const bool is_front = (rules == cases::Rules::opengl) == (front == cases::FrontFace::ccw);
      c.cull = cases::Cull::back;
      EXPECT_EQ(draw(c).size(), is_front ? 256U : 0U);
      c.cull = cases::Cull::front;
      EXPECT_EQ(draw(c).size(), is_front ? 0U : 256U);
      c.cull = cases::Cull::none;
      EXPECT_EQ(draw(c).size(), 256U);
    }
  }
}

TEST_P(GlBackend, DrawsWithinScissorAndViewport) {
  cases::Case c = empty_case();
  add(c, everything());
  add(c, everything());  // these vertices remain unused
  c.triangles.pop_back();
  c.scissor = cases::Scissor{-2, 3, 6, 5};
  EXPECT_EQ(pixels(draw(c)), pixels_where([](int x, int y) { return x < 4 && y >= 3 && y < 8; }));
  c.scissor.reset();
  c.viewport = {2, 5, 8, 4, 0, 1};
  EXPECT_EQ(pixels(draw(c)),
            pixels_where([](int x, int y) { return x >= 2 && x < 10 && y >= 5 && y < 9; }));
}

// A negative width or height mirrors the triangle, which changes its facing; both together do not.
TEST_P(GlBackend, DrawsWithinViewportsOfNegativeSize) {
  cases::Case c = empty_case();
  add(c, everything());
  c.viewport = {10, 9, -8, -4, 0, 1};
  EXPECT_EQ(pixels(draw(c)),
            pixels_where([](int x, int y) { return x >= 2 && x < 10 && y >= 5 && y < 9; }));
  c.cull = cases::Cull::back;
  const std::size_t turned_twice = draw(c).size();
  c.viewport = {10, 5, -8, 4, 0, 1};
  const std::size_t turned_once = draw(c).size();
  EXPECT_EQ(turned_once + turned_twice, 32U);
  EXPECT_EQ(turned_once * turned_twice, 0U);
}

// If the scissor test stayed on while the next layer is cleared, old content would remain.
TEST_P(GlBackend, ClearsAllOfEachLayer) {
  cases::Case c = empty_case();
  for (int i = 0; i < 70; ++i) add(c, everything());
  EXPECT_EQ(draw(c).size(), 70U * 256);
  c.scissor = cases::Scissor{0, 0, 1, 1};
  EXPECT_EQ(draw(c).size(), 70U);
  EXPECT_EQ(draw(c).size(), 70U);
}

TEST_P(GlBackend, ClipsByDistances) {
  cases::Case c = empty_case();
  add(c, everything());
  c.clip_distance_count = 5;
  // The first distance is u − 5, the last is 9 − u, at the vertices' u of 0, 32 and 0.
  c.clip_distances = {-5, 1, 1, 1, 9, 27, 1, 1, 1, -23, -5, 1, 1, 1, 9};
  EXPECT_EQ(pixels(draw(c)), pixels_where([](int x, int) { return x >= 5 && x < 9; }));
  c.clip_distance_count = 0;
  c.clip_distances.clear();
  EXPECT_EQ(draw(c).size(), 256U);
}

TEST_P(GlBackend, DrawsSamples) {
  cases::Case c = empty_case();
  c.framebuffer.samples = 4;
  c.attributes = {{"at sample", Interpolation::smooth, Location::sample},
                  {"at centre", Interpolation::smooth, Location::center},
                  {"flat", Interpolation::flat, Location::sample}};
  // Both smooth values are window x. The triangle ends at x = 8.5; of the pixels there, samples 0
  // and 2 lie within it.
  add(c, left_of(8.5F), {8.5F, 8.5F, 3, 8.5F, 8.5F, 3, -100, -100, 3});
  if (is_softpipe()) return expect_unsupported(c, "samples");
  const cases::Fragments drawn = draw(c);
  ASSERT_EQ(drawn.size(), 16U * (8 * 4 + 2));
  constexpr std::array<float, 4> kPlaces = {6, 14, 2, 10};
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const std::size_t in_row = i % 34;
    EXPECT_EQ(drawn.y[i], i / 34);
    EXPECT_EQ(drawn.x[i], in_row / 4);
    EXPECT_EQ(drawn.sample[i], in_row < 32 ? in_row % 4 : (in_row - 32) * 2);
    const auto x = static_cast<float>(drawn.x[i]);
    EXPECT_NEAR(drawn.attributes_of(i)[0], x + kPlaces.at(drawn.sample[i]) / 16, kTolerance * 16);
    EXPECT_NEAR(drawn.attributes_of(i)[1], x + 0.5F, kTolerance * 16);
    EXPECT_EQ(drawn.attributes_of(i)[2], 3);
  }
}

TEST_P(GlBackend, DrawsTheSameInEachWay) {
  if (std::string(GetParam()) == "gl:llvmpipe,gles") {
    EXPECT_EQ(backend().ways_of_drawing()->ways(), std::vector{cases::DrawBy::layers});
    return;
  }
  expect_ways_alike(backend(), cases::Rules::opengl);
}

TEST_P(GlBackend, StoresDepths) { expect_stored_depths(backend()); }
TEST_P(GlBackend, BiasesDepths) { expect_biased_depths(backend()); }
TEST_P(GlBackend, BiasesBySlope) { expect_slopes(backend()); }
TEST_P(GlBackend, ClampsTheBias) { expect_clamped_bias(backend()); }
TEST_P(GlBackend, LimitsBiasedDepths) { expect_limited_depths(backend()); }
TEST_P(GlBackend, ComparesStoredDepths) { expect_tests_of_stored_depths(backend()); }

TEST_P(GlBackend, DrawsStripsAndFans) {
  if (!is_es()) {
    for (const auto rules : {cases::Rules::opengl, cases::Rules::vulkan}) {
      expect_strips_and_fans(backend(), rules);
      expect_strips_of_lines(backend(), rules);
    }
    return;
  }
  // OpenGL ES cannot append fragments, nor choose the provoking vertex.
  const cases::Case c = case_of_corners(cases::Rules::opengl);
  expect_strips_and_fans_of(backend(), with_depth_test(c));
  const cases::Case of_vulkan = with_depth_test(case_of_corners(cases::Rules::vulkan));
  for (const cases::Case& refused : {c, of_vulkan}) {
    const std::vector<std::uint32_t> strip{0, 1, 2, 3};
    const auto drawn =
        backend().assembler()->draw_assembled(refused, cases::Topology::strip, strip);
    ASSERT_FALSE(drawn);
    EXPECT_EQ(drawn.error().failure, Failure::unsupported);
  }
}

TEST_P(GlBackend, DrawsLines) {
  expect_lines(backend(), cases::Rules::opengl, cases::LineMode::bresenham);
  if (!is_es()) expect_lines(backend(), cases::Rules::vulkan, cases::LineMode::bresenham);
  expect_wide_lines(backend(), cases::Rules::opengl, cases::LineMode::bresenham);
}

// The line ends between samples 0 and 2 of pixel 7, at 6/16 and 2/16, and its sides are between
// samples too.
TEST_P(GlBackend, DrawsLinesOfSamples) {
  if (is_softpipe()) return;
  cases::Case c = case_of_lines(cases::Rules::opengl, cases::LineMode::rectangular, 4);
  add_line(c, at(2, 4.5F), at(7.25F, 4.5F));
  const cases::Fragments drawn = draw(c);
  EXPECT_EQ(drawn.size(), 21U);
  EXPECT_EQ(pixels_of_primitive(drawn, 0), box_of_pixels(2, 7, 4, 4));
  c.line_mode = cases::LineMode::bresenham;
  expect_unsupported(c, "OpenGL's lines are rectangular with several samples");
  c.framebuffer.samples = 1;
  c.line_mode = cases::LineMode::parallelogram;
  expect_unsupported(c, "OpenGL's lines are bresenham with one sample");
}

TEST_P(GlBackend, DrawsPoints) {
  expect_points(backend(), cases::Rules::opengl);
  expect_points(backend(), cases::Rules::vulkan);
}

TEST_P(GlBackend, DrawsLinesAndPointsInEachWay) {
  if (is_es() || is_softpipe())
    return;  // GlBackend.DrawsTheSameInEachWay says which ways there are
  expect_primitives_alike(backend(), cases::Rules::opengl, cases::LineMode::bresenham);
}

TEST_P(GlBackend, DrawsPicturesOfLinesAndPoints) {
  expect_pictures_of_primitives(backend(), cases::Rules::opengl, cases::LineMode::bresenham);
}

TEST_P(GlBackend, RefusesSizesOutOfRange) {
  expect_sizes_refused(backend(), cases::Rules::opengl, cases::LineMode::bresenham);
}

TEST_P(GlBackend, RefusesWhatItDoesNotDraw) {
  cases::Case c = empty_case(cases::Rules::d3d);
  add(c, everything());
  expect_unsupported(c, "rules of d3d");
  c.rules = cases::Rules::opengl;
  // Float32 cannot hold the position of its other side, 2^-30 − 16.
  c.viewport.y = 0x1p-30F;
  c.viewport.height = -kSide;
  expect_unsupported(c, "negative size");
  c.viewport.y = 0;
  c.viewport.height = kSide;
  c.framebuffer.samples = 16;
  expect_unsupported(c, "samples");
  c.framebuffer.samples = 1;
  EXPECT_EQ(draw(c).size(), 256U);
}

// The check for leaks runs now and then. It must not count programs that a driver compiles while it
// draws.
TEST_P(GlBackend, DrawsTheSameAgainAndAgain) {
  for (int i = 0; i < 40; ++i) {
    cases::Case c = empty_case();
    const int side = 3 + i % 14;
    c.framebuffer = {side, 16, 1};
    c.depth_test = i % 3 == 0 ? cases::DepthTest::less : cases::DepthTest::none;
    add(c, everything());
    EXPECT_EQ(draw(c).size(), 16U * static_cast<unsigned>(side));
  }
}

INSTANTIATE_TEST_SUITE_P(Driver, GlBackend,
                         testing::Values("gl:llvmpipe", "gl:softpipe", "gl:llvmpipe,gles"),
                         test_name);

TEST(GlBackendOptions, RefuseUnknownOptions) {
  Isolation isolation;
  isolation.command = {RASTERCHECK_PROGRAM, "worker"};
  const auto made = make_isolated_backend("gl:magic", isolation);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().failure, Failure::refused);
  EXPECT_EQ(to_string(made.error()),
            "gl:magic: unknown option 'magic'; options: llvmpipe, softpipe, gles");
}

}  // namespace
}  // namespace rastercheck::backends::gl_backend_test
