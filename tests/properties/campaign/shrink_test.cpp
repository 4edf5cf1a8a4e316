#include "properties/campaign/shrink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "properties/campaign/internal/case_size.h"
#include "properties/choices.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::shrink_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A check that fails if `is_bad` is true of the case; the violation is at this pixel of this
/// triangle.
FailsAlike where(const std::function<bool(const cases::Case&)>& is_bad, std::uint32_t triangle = 0,
                 std::uint32_t x = 0, std::uint32_t y = 0) {
  return [=](const cases::Case& c) -> std::optional<Check> {
    if (!is_bad(c)) return std::nullopt;
    Check check;
    check.violation_count = 1;
    check.violations.resize(1);
    check.violations[0].place.triangle = triangle;
    check.violations[0].place.x = x;
    check.violations[0].place.y = y;
    return check;
  };
}

Shrunk shrunk(const cases::Case& c, const FailsAlike& fails, std::uint64_t tries = 100000) {
  return shrink(c, fails(c).value(), fails, {tries, {}});
}

/// A case that uses every feature, so that there is much to remove.
cases::Case full_case() {
  cases::Case c = square();
  c.framebuffer = {64, 48, 4};
  c.viewport = {2.5F, -3.25F, 60.5F, -50, 0.25F, 0.75F};
  c.rules = cases::Rules::opengl;
  c.coverage = cases::Snapping{4, cases::Rounding::half_up, 0.25F};
  c.basis = cases::Basis::snapped;
  c.fill_rule = cases::TieRule::top_left;
  c.cull = cases::Cull::back;
  c.front_face = cases::FrontFace::cw;
  c.scissor = cases::Scissor{1, 2, 30, 40};
  c.depth_test = cases::DepthTest::less;
  c.depth_clamp = true;
  c.camera.emplace();
  c.camera->projection[5] = -1.5F;
  c.clip_distance_count = 2;
  c.clip_distances = {1, 2, 3, 4, 5, 6, 7, -8};
  c.positions = {
      {-0x1.234568p0F, 3, 0.3F, 7}, {1e10F, 1e-10F, -4, 0.1F}, {5, 5, 5, -5}, {1, 2, 3, 4}};
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  c.attributes[2].location = cases::Location::centroid;
  c.triangles = {{0, 1, 2}, {2, 1, 3}, {3, 1, 0}, {0, 2, 3}, {1, 1, 1}};
  return c;
}

// Kills: any pass that does not remove what it is there to remove.
TEST(Shrink, LeavesNothingThatIsNotNeeded) {
  const Shrunk least = shrunk(full_case(), where([](const cases::Case&) { return true; }));
  EXPECT_TRUE(least.is_least);
  const cases::Case& c = least.source;
  EXPECT_THAT(c.triangles, ElementsAre(cases::Triangle{0, 1, 2}));
  EXPECT_EQ(c.framebuffer, (cases::FramebufferSize{1, 1, 1}));
  EXPECT_EQ(c.viewport, (cases::Viewport{0, 0, 1, 1, 0, 1}));
  EXPECT_EQ(c.rules, cases::Rules::vulkan);
  EXPECT_EQ(c.coverage, std::nullopt);
  EXPECT_EQ(c.basis, cases::Basis::ideal);
  EXPECT_EQ(c.fill_rule, cases::TieRule::top_left);
  EXPECT_EQ(c.cull, cases::Cull::none);
  EXPECT_EQ(c.front_face, cases::FrontFace::ccw);
  EXPECT_EQ(c.scissor, std::nullopt);
  EXPECT_EQ(c.depth_test, cases::DepthTest::none);
  EXPECT_FALSE(c.depth_clamp);
  EXPECT_EQ(c.camera, std::nullopt);
  EXPECT_EQ(c.clip_distance_count, 0U);
  EXPECT_THAT(c.attributes, IsEmpty());
  EXPECT_THAT(c.attribute_values, IsEmpty());
  for (const cases::ClipVertex& vertex : c.positions) EXPECT_EQ(vertex.w, 1);
  // Bits of the viewport, of the depth range, of w, and of x and y. x and y have 6 bits, one for
  // each coordinate. The clip coordinate 0 would need no bits, but in a target of one pixel it is
  // the pixel's centre, which is not on the grid of whole pixels.
  EXPECT_EQ(size_of(c).bits, 2U + 1U + 3U + 6U);
  EXPECT_EQ(size_of(c).off_grid, 0U);
}

// Kills: a search that loses what makes the case fail, or that stops removing other parts because
// of it.
TEST(Shrink, KeepsWhatIsNeededAndNothingElse) {
  const auto needs = [](const std::function<bool(const cases::Case&)>& part) {
    const Shrunk least = shrunk(full_case(), where(part));
    EXPECT_TRUE(part(least.source));
    EXPECT_TRUE(least.is_least);
    return least.source;
  };
  EXPECT_EQ(needs([](const cases::Case& c) { return c.triangles.size() > 2; }).triangles.size(),
            3U);
  EXPECT_EQ(
      needs([](const cases::Case& c) { return c.framebuffer.samples > 1; }).framebuffer.samples, 2);
  EXPECT_THAT(needs([](const cases::Case& c) { return c.attributes.size() > 1; }).attribute_values,
              testing::Each(0));
  const cases::Case wide = needs([](const cases::Case& c) { return c.framebuffer.width > 12; });
  EXPECT_EQ(wide.framebuffer.width, 13);
  EXPECT_EQ(wide.framebuffer.height, 1);
  const cases::Case behind = needs([](const cases::Case& c) {
    return std::any_of(c.positions.begin(), c.positions.end(),
                       [](const cases::ClipVertex& v) { return v.w < 0; });
  });
  EXPECT_EQ(size_of(behind).other_w, 1U);
  const cases::Case snapped = needs([](const cases::Case& c) { return c.coverage.has_value(); });
  EXPECT_EQ(snapped.coverage, cases::Snapping());
  const cases::Case with_camera = needs([](const cases::Case& c) { return c.camera.has_value(); });
  EXPECT_EQ(with_camera.camera, cases::Camera());
  const cases::Case precise = needs([](const cases::Case& c) {
    return std::any_of(c.positions.begin(), c.positions.end(),
                       [](const cases::ClipVertex& v) { return significant_bits(v.x) > 5; });
  });
  EXPECT_LE(size_of(precise).bits, 24U);  // six or more for one number, one each for w and sizes
  const cases::Case large = needs([](const cases::Case& c) {
    return std::any_of(c.attribute_values.begin(), c.attribute_values.end(),
                       [](float v) { return std::abs(v) >= 8; });
  });
  EXPECT_EQ(large.attributes.size(), 1U);
}

// Kills: vertices and values that are mixed up with those of removed triangles.
TEST(Shrink, OfTrianglesKeepsTheirVertices) {
  cases::Case c = square();
  c.clip_distance_count = 1;
  c.clip_distances = {10, 11, 12, 13};
  const cases::Case both = with_triangles(c, std::array<std::size_t, 2>{1, 0});
  EXPECT_THAT(both.triangles, ElementsAre(cases::Triangle{0, 1, 2}, cases::Triangle{3, 1, 0}));
  EXPECT_THAT(both.positions,
              ElementsAre(c.positions[2], c.positions[1], c.positions[3], c.positions[0]));
  EXPECT_THAT(both.clip_distances, ElementsAre(12, 11, 13, 10));
  EXPECT_THAT(both.attribute_values, ElementsAre(0, 1, 0, 8, 1, 0, 8, 1, 0, 0, 1, 0));
}

// Kills: a search that tries thousands of triangles one after the other.
TEST(Shrink, OfManyTrianglesGoesToTheGuiltyOne) {
  cases::Case c = square();
  c.triangles.assign(1000, {0, 1, 2});
  c.triangles[777] = {2, 1, 3};
  const cases::ClipVertex guilty = c.positions[3];
  const auto has_it = [&guilty](const cases::Case& one) {
    return std::any_of(one.triangles.begin(), one.triangles.end(), [&](const cases::Triangle& t) {
      return one.positions[t[2]].x >= guilty.x && one.positions[t[2]].y >= guilty.y;
    });
  };
  const Shrunk least = shrunk(c, where(has_it, 777), 200);
  EXPECT_EQ(least.source.triangles.size(), 1U);
  const Shrunk blind = shrunk(c, where(has_it, 5), 200);
  EXPECT_EQ(blind.source.triangles.size(), 1U);
}

// Kills: choices that change with each step, or that remain although nothing depends on them.
TEST(Shrink, KeepsChoicesWhereTheCaseFailsWithNoOthers) {
  cases::Case c = full_case();
  c.choices = 77;
  const Shrunk chosen =
      shrunk(c, where([](const cases::Case& tried) { return tried.choices == 77U; }));
  EXPECT_EQ(chosen.source.choices, 77U);
  EXPECT_EQ(chosen.source.triangles.size(), 1U);
  const Shrunk unchosen = shrunk(c, where([](const cases::Case&) { return true; }));
  EXPECT_EQ(unchosen.source.choices, std::nullopt);
}

// A law that makes its first choice from all triangles chooses differently for a single triangle.
TEST(Shrink, TriesOtherChoicesOfOneTriangle) {
  cases::Case c = full_case();
  c.choices = 77;
  const Shrunk least = shrunk(c, where([](const cases::Case& tried) {
                                return tried.triangles.size() > 1 || choices_of(tried) % 16 == 3;
                              }));
  EXPECT_EQ(least.source.triangles.size(), 1U);
  EXPECT_EQ(choices_of(least.source) % 16, 3U);
}

// Kills: a framebuffer that loses the pixel that failed, or keeps hundreds that are not needed.
TEST(Shrink, CropsToThePixel) {
  cases::Case c = square();
  c.framebuffer = {640, 480, 1};
  c.viewport.width = 640;
  c.viewport.height = 480;
  const auto keeps_it = [](const cases::Case& one) {
    // The new position of pixel (300, 200).
    const double x = 300 + static_cast<double>(one.viewport.x);
    const double y = 200 + static_cast<double>(one.viewport.y);
    return one.viewport.width == 640 && one.viewport.height == 480 && x >= 0 && y >= 0 &&
           x < one.framebuffer.width && y < one.framebuffer.height;
  };
  const FailsAlike fails = [&](const cases::Case& one) -> std::optional<Check> {
    return where(keeps_it, 0, static_cast<std::uint32_t>(300 + one.viewport.x),
                 static_cast<std::uint32_t>(200 + one.viewport.y))(one);
  };
  const Shrunk least = shrunk(c, fails);
  EXPECT_LE(least.source.framebuffer.width, 8);
  EXPECT_LE(least.source.framebuffer.height, 8);
}

TEST(Shrink, StaysWithinItsLimits) {
  const FailsAlike fails = where([](const cases::Case&) { return true; });
  for (const std::uint64_t tries : {0U, 1U, 7U}) {
    const Shrunk some = shrunk(full_case(), fails, tries);
    EXPECT_EQ(some.tries, tries);
    EXPECT_FALSE(some.is_least);
    EXPECT_EQ(some.source == full_case(), tries == 0);
  }
  int asked = 0;
  const Shrunk some = shrink(full_case(), fails(full_case()).value(), fails,
                             {1000, [&asked] { return ++asked > 3; }});
  EXPECT_FALSE(some.is_least);
  EXPECT_LE(some.tries, 3U);
}

// Kills: returning a case that does not fail; returning the check of another case.
TEST(Shrink, ReturnsTheCaseIfNoSmallerOneFails) {
  const cases::Case c = full_case();
  int checks = 0;
  const FailsAlike fails = [&checks](const cases::Case&) {
    ++checks;
    return std::optional<Check>();
  };
  Check check;
  check.violation_count = 42;
  const Shrunk same = shrink(c, check, fails, {100000, {}});
  EXPECT_EQ(same.source, c);
  EXPECT_EQ(same.check.violation_count, 42U);
  EXPECT_TRUE(same.is_least);
  EXPECT_EQ(same.tries, static_cast<std::uint64_t>(checks));
}

// Kills: a candidate that no case file can hold; a larger candidate; a candidate that is checked
// twice.
TEST(Shrink, OffersCasesThatCanBeSavedAndAreSmaller) {
  std::vector<std::string> offered;
  const cases::Case start = full_case();
  const FailsAlike fails = [&](const cases::Case& c) -> std::optional<Check> {
    const std::string text = cases::to_json(c);
    offered.push_back(text);
    const auto read = cases::parse_case(text, "candidate");
    EXPECT_TRUE(read) << to_string(read.error()) << "\n" << text;
    EXPECT_EQ(read.value_or(cases::Case()), c);
    EXPECT_LT(size_of(c), size_of(start));
    // Every third candidate fails, so that the search goes many ways.
    Check check;
    check.violations.resize(1);
    return offered.size() % 3 == 0 ? std::optional(check) : std::nullopt;
  };
  shrink(start, {}, fails, {100000, {}});
  EXPECT_GT(offered.size(), 100U);
  std::sort(offered.begin(), offered.end());
  EXPECT_EQ(std::adjacent_find(offered.begin(), offered.end()), offered.end());
}

// Kills: a result that depends on anything but the case.
TEST(Shrink, EndsWithTheSameEachTime) {
  const FailsAlike fails = where([](const cases::Case& c) {
    return c.positions.size() > 2 && c.positions[2].w < 0 && c.framebuffer.width > 3;
  });
  const Shrunk once = shrunk(full_case(), fails);
  const Shrunk again = shrunk(full_case(), fails);
  EXPECT_EQ(once.source, again.source);
  EXPECT_EQ(once.tries, again.tries);
  // The least case cannot be shrunk further.
  const Shrunk more = shrunk(once.source, fails);
  EXPECT_EQ(more.source, once.source);
}

}  // namespace
}  // namespace rastercheck::properties::shrink_test
