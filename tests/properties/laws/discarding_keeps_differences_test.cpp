// `cpu` keeps the law; differences that depend on what is discarded beside them break it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/driver_bounds.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::discarding_keeps_differences_test {
namespace {

using cases::Case;
using cases::Picture;
using cases::Pipeline;
using testing::HasSubstr;

constexpr std::string_view kLaw = "discarding-keeps-differences";

/// The square, of which the last attribute is the window x.
Case sloping() {
  Case c = square();
  for (std::size_t v = 0; v < 4; ++v) c.attribute_values[3 * v + 2] = c.attribute_values[3 * v];
  return c;
}

/// Removes the differences of samples whose neighbour along x has none, as if it had been discarded
/// before they were taken.
void lose_beside_discarded(const Pipeline& pipeline, Picture& picture) {
  const bool is_limited = pipeline.discard_below && *pipeline.discard_below > -1000;
  if (!is_limited) return;
  const Picture before = picture;
  const auto width = static_cast<std::size_t>(picture.size.width);
  const auto samples = static_cast<std::size_t>(picture.size.samples);
  for (std::size_t i = 0; i < picture.color.size(); ++i) {
    const std::size_t of_pixel = picture.channels * samples;
    const std::size_t x = i / of_pixel % width;
    if ((x ^ 1U) >= width) continue;
    const std::size_t neighbor = (x & 1U) != 0 ? i - of_pixel : i + of_pixel;
    if (before.color[neighbor] == 0) picture.color[i] /= 2;
  }
}

TEST(DiscardedNeighbors, KeepDifferencesOnCpu) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 300);
  EXPECT_EQ(found.violated, 0);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf({"along x", "along y", "beside a discarded one", "clipped",
                                     "discarded", "kept", "several samples", "w <= 0"}));
}

TEST(DiscardedNeighbors, ThatAreLostAreShown) {
  for (const bool is_driver : {false, true}) {
    DamagedBackend backend({}, "cpu");
    if (is_driver) {
      backend.picture_bounds = driver_bounds();
      backend.promised = backend.contract(sloping());
      backend.promised->is_invariant = false;
    }
    EXPECT_EQ(check_own_cases(kLaw, backend, 50).violated, 0);
    backend.picture_damage = &lose_beside_discarded;
    EXPECT_GT(check_own_cases(kLaw, backend, 50).violated, 10);
  }
}

// Fragments that are drawn though they have lesser values show what they show without a limit.
TEST(DiscardedNeighbors, AreAllThatTheLawIsAbout) {
  DamagedBackend backend({}, "cpu");
  backend.pipeline_damage = [](Pipeline& pipeline) { pipeline.discard_below.reset(); };
  const Check check = check_of(kLaw, sloping(), backend);
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Not(testing::Contains("discarded")));
}

TEST(DiscardedNeighbors, ThatShowSomethingElseAreNamed) {
  DamagedBackend backend({}, "cpu");
  backend.picture_damage = [](const Pipeline& pipeline, Picture& picture) {
    if (pipeline.discard_below) picture.color.back() = 7;
  };
  const Check check = check_of(kLaw, sloping(), backend);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().place.x, 7U);
  EXPECT_EQ(check.violations.front().attribute, 2U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("discarded; expected is what is drawn"));
}

TEST(DiscardedNeighbors, NeedPicturesAndAttributes) {
  Case c = sloping();
  c.attributes.clear();
  c.attribute_values.clear();
  EXPECT_FALSE(check_of(kLaw, c, {}, "cpu").is_applicable);
  DamagedBackend backend;
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  DamagedBackend driver({}, "cpu");
  driver.picture_bounds = driver_bounds();
  EXPECT_TRUE(check_of(kLaw, sloping(), driver).is_applicable);
  driver.picture_bounds->keeps_fragments = false;  // as of centroids of several samples
  EXPECT_FALSE(check_of(kLaw, sloping(), driver).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::discarding_keeps_differences_test
