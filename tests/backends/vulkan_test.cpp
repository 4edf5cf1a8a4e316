// Draws cases whose fragments are known by hand, with the validation layer on. Any message from
// that layer fails the case.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cases/sample_pattern.h"
#include "tests/backends/assembled_cases.h"
#include "tests/backends/drivers.h"
#include "tests/backends/lines_and_points.h"
#include "tests/backends/stored_depth.h"
#include "tests/backends/ways.h"

namespace rastercheck::backends::vulkan_test {
namespace {

using cases::Interpolation;
using cases::Location;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int kSize = 8;
constexpr float kHalf = kSize * 0.5F;
/// The length, in pixels, of the legs of the shared triangle, whose right angle is at window (0,
/// 0). With this length, no centre, and none of four samples, is within 1/12 pixel of the
/// hypotenuse.
constexpr float kLeg = 7.625F;
constexpr std::size_t kFragments = 28;

/// The NDC coordinate of a window coordinate.
float ndc(float window) { return window / kHalf - 1; }

/// A vertex at a window position.
cases::ClipVertex at(float x, float y, float z = 0.25F) { return {ndc(x), ndc(y), z, 1}; }

/// A triangle that covers the pixels whose centre has x + y < kLeg: the 28 pixels with i + j <= 6.
cases::Case corner() {
  cases::Case c;
  c.framebuffer = {kSize, kSize, 1};
  c.viewport = {0, 0, kSize, kSize, 0, 1};
  c.positions = {at(0, 0), at(kLeg, 0), at(0, kLeg)};
  c.triangles = {{0, 1, 2}};
  return c;
}

/// An attribute with these values at the vertices.
void add_attribute(cases::Case& c, const cases::Attribute& attribute,
                   const std::vector<float>& values) {
  const std::size_t count = c.attributes.size();
  std::vector<float> all;
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    const auto before = c.attribute_values.begin() + static_cast<std::ptrdiff_t>(v * count);
    all.insert(all.end(), before, before + static_cast<std::ptrdiff_t>(count));
    all.push_back(values[v]);
  }
  c.attributes.push_back(attribute);
  c.attribute_values = all;
}

using Pixel = std::pair<int, int>;

std::set<Pixel> pixels_of(const cases::Fragments& drawn) {
  std::set<Pixel> pixels;
  for (std::size_t i = 0; i < drawn.size(); ++i) pixels.emplace(drawn.x[i], drawn.y[i]);
  EXPECT_EQ(pixels.size(), drawn.size());
  return pixels;
}

std::set<Pixel> pixels_where(const std::function<bool(int, int)>& is_inside) {
  std::set<Pixel> pixels;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (is_inside(x, y)) pixels.emplace(x, y);
    }
  }
  return pixels;
}

bool is_in_corner(int x, int y) { return x + y <= 6; }

class Vulkan : public DriverTest {
 protected:
  cases::Fragments draw(const cases::Case& c) const {
    Result<cases::Fragments> drawn = fragments_of(backend().draw(c));
    EXPECT_TRUE(drawn) << to_string(drawn.error());
    return drawn ? *std::move(drawn) : cases::Fragments();
  }
  std::set<Pixel> pixels(const cases::Case& c) const { return pixels_of(draw(c)); }
  /// The reason why a case is not drawn, which must not be a fault.
  std::string refusal(const cases::Case& c) const {
    const Result<cases::Fragments> drawn = fragments_of(backend().draw(c));
    if (drawn) return "drawn";
    EXPECT_EQ(drawn.error().failure, Failure::unsupported) << to_string(drawn.error());
    return drawn.error().reason;
  }
  static bool is_lavapipe() {
    return std::string(GetParam()).find("lavapipe") != std::string::npos;
  }
};

INSTANTIATE_TEST_SUITE_P(Drivers, Vulkan,
                         testing::Values("vulkan:lavapipe,validate", "vulkan:swiftshader,validate"),
                         test_name);

TEST_P(Vulkan, SaysWhoDraws) {
  const std::optional<Driver> driver = backend().about().driver;
  ASSERT_TRUE(driver);
  EXPECT_EQ(driver->name, is_lavapipe() ? "lavapipe" : "swiftshader");
  EXPECT_THAT(driver->version, testing::MatchesRegex(is_lavapipe() ? "Mesa [0-9.]+.*" : "[0-9.]+"));
  EXPECT_THAT(backend().about().description, HasSubstr(driver->name + " " + driver->version));
  EXPECT_TRUE(backend().about().has_limits);
}

TEST_P(Vulkan, DrawsATriangle) {
  cases::Case c = corner();
  c.positions = {at(0, 0, 0), at(kLeg, 0, 1), at(0, kLeg, 0)};
  add_attribute(c, {"x"}, {0, kLeg, 0});
  add_attribute(c, {"y"}, {0, 0, kLeg});
  const cases::Fragments drawn = draw(c);
  EXPECT_EQ(pixels_of(drawn), pixels_where(is_in_corner));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const float x = static_cast<float>(drawn.x[i]) + 0.5F;
    const float y = static_cast<float>(drawn.y[i]) + 0.5F;
    EXPECT_EQ(drawn.triangle[i], 0);
    EXPECT_EQ(drawn.sample[i], 0);
    EXPECT_NEAR(drawn.attributes_of(i)[0], x, 1e-5);
    EXPECT_NEAR(drawn.attributes_of(i)[1], y, 1e-5);
    EXPECT_NEAR(drawn.depth[i], x / kLeg, 1e-6);
  }
  EXPECT_TRUE(std::is_sorted(drawn.y.begin(), drawn.y.end()));
}

TEST_P(Vulkan, DrawsNothingOfNothing) {
  cases::Case c = corner();
  c.triangles.clear();
  EXPECT_EQ(draw(c).size(), 0);
}

TEST_P(Vulkan, DividesByWUnlessAskedNotTo) {
  // 1/w goes linearly from 1 to 1/4 along window x.
  cases::Case c = corner();
  c.positions[1] = {4 * ndc(kLeg), -4, 1, 4};
  add_attribute(c, {"smooth"}, {0, 1, 0});
  add_attribute(c, {"linear", Interpolation::noperspective}, {0, 1, 0});
  const cases::Fragments drawn = draw(c);
  EXPECT_EQ(drawn.size(), kFragments);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const float b = (static_cast<float>(drawn.x[i]) + 0.5F) / kLeg;
    EXPECT_NEAR(drawn.attributes_of(i)[0], b / 4 / (1 - b + b / 4), 1e-5);
    EXPECT_NEAR(drawn.attributes_of(i)[1], b, 1e-5);
  }
}

TEST_P(Vulkan, CopiesFlatValuesToTheBit) {
  constexpr std::array kFirst{0.1F, -0.0F, 0x1.fffffep127F, -0x1p-126F, 0x1.000002p0F};
  for (const cases::Rules rules : {cases::Rules::vulkan, cases::Rules::opengl}) {
    cases::Case c = corner();
    c.rules = rules;
    // Vulkan takes flat values from the first vertex, OpenGL from the last.
    const std::size_t provoking = rules == cases::Rules::vulkan ? 0 : 2;
    for (const float value : kFirst) {
      std::vector<float> values(3, 7.0F);
      values[provoking] = value;
      add_attribute(c, {"f", Interpolation::flat}, values);
    }
    const cases::Fragments drawn = draw(c);
    EXPECT_EQ(drawn.size(), kFragments);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      for (std::size_t k = 0; k < kFirst.size(); ++k) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(drawn.attributes_of(i)[k]),
                  std::bit_cast<std::uint32_t>(kFirst[k]));
      }
    }
  }
}

// More attributes than one draw has targets for, with all qualifiers. Each value must be the right
// one.
TEST_P(Vulkan, DrawsThirtyTwoAttributes) {
  constexpr std::array kKinds{Interpolation::smooth, Interpolation::noperspective,
                              Interpolation::flat};
  constexpr std::array kPlaces{Location::sample, Location::center, Location::centroid};
  cases::Case c = corner();
  c.framebuffer.samples = 4;
  for (std::size_t k = 0; k < cases::kMaxAttributes; ++k) {
    add_attribute(c, {"a", kKinds[k % 3], kPlaces[k / 3 % 3]},
                  std::vector(3, static_cast<float>(k + 1)));
  }
  const cases::Fragments drawn = draw(c);
  EXPECT_GT(drawn.size(), 4 * kFragments - 20);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    for (std::size_t k = 0; k < cases::kMaxAttributes; ++k) {
      EXPECT_NEAR(drawn.attributes_of(i)[k], static_cast<float>(k + 1), 1e-4);
    }
  }
}

TEST_P(Vulkan, CoversSamples) {
  cases::Case c = corner();
  c.framebuffer.samples = 4;
  const cases::Fragments drawn = draw(c);
  std::set<std::array<int, 3>> covered;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    covered.insert({drawn.x[i], drawn.y[i], drawn.sample[i]});
  }
  EXPECT_EQ(covered.size(), drawn.size());
  const auto pattern = cases::standard_pattern(4);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      for (int s = 0; s < 4; ++s) {
        const auto& p = pattern[static_cast<std::size_t>(s)];
        const int sixteenths = 16 * (x + y) + p.x + p.y;
        EXPECT_EQ(covered.contains({x, y, s}), sixteenths < 122) << x << " " << y << " " << s;
      }
    }
  }
}

TEST_P(Vulkan, EvaluatesAttributesWhereAsked) {
  // The triangle covers everything, so centroids may be anywhere in the pixel.
  cases::Case c = corner();
  c.framebuffer.samples = 4;
  c.positions = {at(0, 0), at(2 * kSize, 0), at(0, 2 * kSize)};
  const std::vector<float> x{0, 2 * kSize, 0};
  add_attribute(c, {"sample", Interpolation::smooth, Location::sample}, x);
  add_attribute(c, {"center", Interpolation::smooth, Location::center}, x);
  add_attribute(c, {"centroid", Interpolation::smooth, Location::centroid}, x);
  add_attribute(c, {"linear", Interpolation::noperspective, Location::sample}, x);
  const cases::Fragments drawn = draw(c);
  ASSERT_EQ(drawn.size(), kSize * kSize * 4);
  const auto pattern = cases::standard_pattern(4);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto column = static_cast<float>(drawn.x[i]);
    const float sample = column + static_cast<float>(pattern[drawn.sample[i]].x) / 16;
    EXPECT_NEAR(drawn.attributes_of(i)[0], sample, 1e-4);
    EXPECT_NEAR(drawn.attributes_of(i)[1], column + 0.5F, 1e-4);
    EXPECT_NEAR(drawn.attributes_of(i)[2], column + 0.5F, 0.5F + 1e-4);
    EXPECT_NEAR(drawn.attributes_of(i)[3], sample, 1e-4);
  }
}

TEST_P(Vulkan, CullsWhatIsDisplayedTheOtherWay) {
  // Window y points down with Vulkan's rules and up with OpenGL's. So the same numbers are
  // displayed clockwise with Vulkan's rules and counter-clockwise with OpenGL's.
  for (const cases::Rules rules : {cases::Rules::vulkan, cases::Rules::opengl}) {
    for (const cases::FrontFace front : {cases::FrontFace::ccw, cases::FrontFace::cw}) {
      for (const cases::Cull cull : {cases::Cull::none, cases::Cull::back, cases::Cull::front}) {
        cases::Case c = corner();
        c.rules = rules;
        c.front_face = front;
        c.cull = cull;
        const bool is_ccw = rules == cases::Rules::opengl;
        const bool is_front = is_ccw == (front == cases::FrontFace::ccw);
        const bool is_drawn = cull == cases::Cull::none || (cull == cases::Cull::back) == is_front;
        EXPECT_EQ(draw(c).size(), is_drawn ? kFragments : 0);
      }
    }
  }
}

TEST_P(Vulkan, MovesAndTurnsViewports) {
  cases::Case c = corner();
  c.viewport = {0, kSize, kSize, -kSize};
  EXPECT_EQ(pixels(c), pixels_where([](int x, int y) { return is_in_corner(x, 7 - y); }));
  // The triangle that was displayed clockwise no longer is.
  c.cull = cases::Cull::back;
  EXPECT_EQ(draw(c).size(), kFragments);
  c = corner();
  c.viewport = {-2, 3, kSize, kSize};
  EXPECT_EQ(pixels(c),
            pixels_where([](int x, int y) { return y >= 3 && is_in_corner(x + 2, y - 3); }));
}

TEST_P(Vulkan, MapsDepth) {
  cases::Case c = corner();
  for (const auto& [near, far, depth] :
       {std::array{0.0F, 1.0F, 0.25F}, {1.0F, 0.0F, 0.75F}, {0.5F, 0.75F, 0.5625F}}) {
    c.viewport.min_depth = near;
    c.viewport.max_depth = far;
    c.rules = cases::Rules::vulkan;
    for (const float drawn : draw(c).depth) EXPECT_NEAR(drawn, depth, 1e-6);
    // In the range from −1 to 1, 1/4 is at 5/8 of the way.
    c.rules = cases::Rules::opengl;
    for (const float drawn : draw(c).depth) EXPECT_NEAR(drawn, near + 0.625F * (far - near), 1e-6);
  }
}

TEST_P(Vulkan, ClipsDepthUnlessItClamps) {
  // z goes from −1 to 2 along x. It is 0 and 1 at a third and two thirds of kLeg, which are 2.54
  // and 5.08. Centres at 2.5 are too near to 2.54 to be tested.
  cases::Case c = corner();
  c.positions = {at(0, 0, -1), at(kLeg, 0, 2), at(0, kLeg, -1)};
  std::set<Pixel> clipped = pixels(c);
  std::erase_if(clipped, [](const Pixel& p) { return p.first == 2; });
  EXPECT_EQ(clipped,
            pixels_where([](int x, int y) { return x > 2 && x < 5 && is_in_corner(x, y); }));
  c.depth_clamp = true;
  const cases::Fragments clamped = draw(c);
  EXPECT_EQ(pixels_of(clamped), pixels_where(is_in_corner));
  for (std::size_t i = 0; i < clamped.size(); ++i) {
    const float z = -1 + 3 * (static_cast<float>(clamped.x[i]) + 0.5F) / kLeg;
    EXPECT_NEAR(clamped.depth[i], std::clamp(z, 0.0F, 1.0F), 1e-6);
  }
  c.depth_clamp = false;
  c.rules = cases::Rules::opengl;
  EXPECT_EQ(pixels(c), pixels_where([](int x, int y) { return x < 5 && is_in_corner(x, y); }));
}

TEST_P(Vulkan, HeedsScissors) {
  cases::Case c = corner();
  c.scissor = {1, 2, 3, 2};
  EXPECT_EQ(pixels(c),
            pixels_where([](int x, int y) { return x >= 1 && x < 4 && y >= 2 && y < 4; }));
  c.scissor = {-5, 3, 7, 100};
  EXPECT_EQ(pixels(c),
            pixels_where([](int x, int y) { return x < 2 && y >= 3 && is_in_corner(x, y); }));
  for (const cases::Scissor& empty : {cases::Scissor{9, 0, 4, 4}, {0, 0, 0, 4}, {-9, 0, 4, 4}}) {
    c.scissor = empty;
    EXPECT_EQ(draw(c).size(), 0);
  }
}

TEST_P(Vulkan, ClipsByDistances) {
  // The first of one or eight distances, or the last of five, keeps x >= 2. The last of eight keeps
  // y <= 3.
  for (const std::size_t count : {std::size_t{1}, std::size_t{5}, std::size_t{8}}) {
    cases::Case c = corner();
    c.clip_distance_count = count;
    for (const auto& [x, y] : {std::pair{0.0F, 0.0F}, {kLeg, 0.0F}, {0.0F, kLeg}}) {
      std::vector<float> distances(count, 1.0F);
      if (count == 8) distances[7] = 3 - y;
      distances[count == 5 ? 4 : 0] = x - 2;
      c.clip_distances.insert(c.clip_distances.end(), distances.begin(), distances.end());
    }
    EXPECT_EQ(pixels(c), pixels_where([count](int x, int y) {
                return x >= 2 && (count < 8 || y < 3) && is_in_corner(x, y);
              }))
        << count;
  }
}

TEST_P(Vulkan, KeepsTheNearestAndTheFirst) {
  // Triangles over one another, at depths 0.5, 0.25, and 0.25 again.
  cases::Case c = corner();
  c.depth_test = cases::DepthTest::less;
  c.positions.clear();
  c.triangles.clear();
  for (const float z : {0.5F, 0.25F, 0.25F}) {
    const auto first = static_cast<std::uint32_t>(c.positions.size());
    for (const auto& v : {at(0, 0, z), at(kLeg, 0, z), at(0, kLeg, z)}) c.positions.push_back(v);
    c.triangles.push_back({first, first + 1, first + 2});
  }
  std::vector<float> values;
  for (const float f : {1.0F, 2.0F, 3.0F}) values.insert(values.end(), 3, f);
  add_attribute(c, {"f", Interpolation::flat}, values);
  cases::Fragments drawn = draw(c);
  EXPECT_EQ(pixels_of(drawn), pixels_where(is_in_corner));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_EQ(drawn.triangle[i], 1);
    EXPECT_EQ(drawn.attributes_of(i)[0], 2);
    EXPECT_EQ(drawn.depth[i], 0.25F);
  }
  // If triangles lie side by side, fragments come by triangle, in whatever order they were drawn.
  for (std::size_t i = 6; i < 9; ++i) c.positions[i].x += 0.5F;
  drawn = draw(c);
  EXPECT_TRUE(std::is_sorted(drawn.triangle.begin(), drawn.triangle.end()));
  EXPECT_EQ(std::count(drawn.triangle.begin(), drawn.triangle.end(), 1U), kFragments);
  EXPECT_EQ(std::count(drawn.triangle.begin(), drawn.triangle.end(), 2U), 6 + 6);
}

// Kills: clearing the target to a depth that is nearer than a fragment.
TEST_P(Vulkan, KeepsWhatIsFarthest) {
  cases::Case c = corner();
  c.depth_test = cases::DepthTest::less;
  c.positions = {at(0, 0, 1), at(kLeg, 0, 1), at(0, kLeg, 1)};
  EXPECT_EQ(draw(c).size(), kFragments);
}

TEST_P(Vulkan, DrawsEachTriangleAlone) {
  // More triangles than are drawn together. They overlap, and each also covers one pixel of its
  // own.
  constexpr std::uint32_t kCount = 200;
  cases::Case c = corner();
  c.positions.clear();
  c.triangles.clear();
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const auto x = static_cast<float>(i % 8);
    const auto y = static_cast<float>(i / 8 % 8);
    c.positions.insert(c.positions.end(), {at(x, y), at(x + 1.4F, y), at(x, y + 1.4F)});
    c.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const cases::Fragments drawn = draw(c);
  ASSERT_EQ(drawn.size(), kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(drawn.triangle[i], i);
    EXPECT_EQ(drawn.x[i], i % 8);
    EXPECT_EQ(drawn.y[i], i / 8 % 8);
  }
}

TEST_P(Vulkan, DrawsCasesOfChangingShapes) {
  // Targets and pipelines are kept from one case to the next.
  for (int i = 0; i < 2; ++i) {
    for (const int samples : {1, 4}) {
      for (const std::size_t attributes : {std::size_t{0}, std::size_t{3}, std::size_t{5}}) {
        cases::Case c = corner();
        c.framebuffer.samples = samples;
        for (std::size_t k = 0; k < attributes; ++k) {
          add_attribute(c, {"a"}, std::vector(3, static_cast<float>(k)));
        }
        const cases::Fragments drawn = draw(c);
        EXPECT_GE(drawn.size(), kFragments);
        EXPECT_EQ(drawn.attributes.size(), drawn.size() * attributes);
      }
    }
  }
}

TEST_P(Vulkan, DrawsTheSameInEachWay) { expect_ways_alike(backend(), cases::Rules::vulkan); }

TEST_P(Vulkan, StoresDepths) { expect_stored_depths(backend()); }
TEST_P(Vulkan, BiasesDepths) { expect_biased_depths(backend()); }
TEST_P(Vulkan, BiasesBySlope) { expect_slopes(backend()); }
TEST_P(Vulkan, ClampsTheBias) { expect_clamped_bias(backend()); }
TEST_P(Vulkan, LimitsBiasedDepths) { expect_limited_depths(backend()); }
TEST_P(Vulkan, ComparesStoredDepths) { expect_tests_of_stored_depths(backend()); }

TEST_P(Vulkan, DrawsWithinViewportsOfNegativeWidth) {
  cases::Case c = corner();
  std::set<Pixel> turned;
  for (const auto& [x, y] : pixels_of(draw(c))) turned.emplace(kSize - 1 - x, y);
  c.viewport.x = kSize;
  c.viewport.width = -kSize;
  EXPECT_EQ(pixels_of(draw(c)), turned);
}

TEST_P(Vulkan, DrawsStripsAndFans) {
  for (const auto rules : {cases::Rules::vulkan, cases::Rules::opengl}) {
    expect_strips_and_fans(backend(), rules);
    expect_strips_of_lines(backend(), rules);
  }
}

TEST_P(Vulkan, DrawsLines) {
  for (const auto mode : {cases::LineMode::rectangular, cases::LineMode::bresenham}) {
    for (const auto rules : {cases::Rules::vulkan, cases::Rules::opengl}) {
      expect_lines(backend(), rules, mode);
    }
    if (is_lavapipe()) expect_wide_lines(backend(), cases::Rules::vulkan, mode);
  }
  cases::Case c = case_of_lines(cases::Rules::vulkan, cases::LineMode::parallelogram);
  add_line(c, backends::at(2, 4.5F), backends::at(7, 4.5F));
  EXPECT_THAT(refusal(c), HasSubstr("(strictLines)"));
}

TEST_P(Vulkan, DrawsPoints) {
  for (const auto rules : {cases::Rules::vulkan, cases::Rules::opengl}) {
    expect_points(backend(), rules);
  }
}

TEST_P(Vulkan, DrawsLinesAndPointsInEachWay) {
  expect_primitives_alike(backend(), cases::Rules::vulkan, cases::LineMode::rectangular);
}

TEST_P(Vulkan, DrawsPicturesOfLinesAndPoints) {
  expect_pictures_of_primitives(backend(), cases::Rules::vulkan, cases::LineMode::rectangular);
}

TEST_P(Vulkan, RefusesSizesOutOfRange) {
  expect_sizes_refused(backend(), cases::Rules::vulkan, cases::LineMode::rectangular);
}

TEST_P(Vulkan, RefusesWhatItCannotDraw) {
  cases::Case c = corner();
  c.rules = cases::Rules::d3d;
  EXPECT_EQ(refusal(c), "it lacks the rules of D3D");
  c = corner();
  c.framebuffer.samples = 16;
  EXPECT_EQ(refusal(c), "it lacks 16 samples per pixel");
  c = corner();
  c.viewport.width = 0;
  EXPECT_EQ(refusal(c), "it lacks viewports without a positive width");
  c = corner();
  c.viewport.x = -1e6F;
  EXPECT_THAT(refusal(c), HasSubstr("(viewportBoundsRange)"));
  c = corner();
  c.framebuffer = {cases::kMaxSize, cases::kMaxSize, 1};
  EXPECT_NE(refusal(c), "drawn");
  // The device still draws after that.
  EXPECT_EQ(draw(corner()).size(), kFragments);
}

TEST(VulkanDevices, AreNamedWhereThereIsNoneOfThatName) {
  Isolation isolation;
  isolation.command = {RASTERCHECK_PROGRAM, "worker"};
  for (const std::string which : {"9999", "no such device"}) {
    const auto none = make_isolated_backend("vulkan:" + which, isolation);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().failure, Failure::unavailable);
    EXPECT_THAT(to_string(none.error()), StartsWith("vulkan:" + which + ": "));
  }
}

}  // namespace
}  // namespace rastercheck::backends::vulkan_test
