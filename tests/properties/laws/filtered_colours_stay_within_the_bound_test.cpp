// `cpu` keeps the law; other filters, and colours beyond the bound, break it. The law does not
// apply to cases without coordinates, or if no bound is promised.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/driver_bounds.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::filtered_colours_stay_within_the_bound_test {
namespace {

using cases::Case;
using cases::Filter;
using cases::Pipeline;
using testing::HasSubstr;

constexpr std::string_view kLaw = "filtered-colours-stay-within-the-bound";

/// The number of the law's first hundred cases that a backend with this damage breaks.
int broken_by(const PipelineDamage& damage) {
  DamagedBackend backend({}, "cpu");
  backend.pipeline_damage = damage;
  return check_own_cases(kLaw, backend, 100).violated;
}

TEST(FilteredColours, AreThoseOfCpuAndMeetWhatTheyAreAbout) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf({"bilinear", "trilinear", "level 0", "between levels",
                                     "last level", "no one coordinate", "several samples"}));
}

TEST(FilteredColours, SayNothingOfCasesWithoutCoordinates) {
  Case c = square();
  EXPECT_TRUE(check_of(kLaw, c, {}, "cpu").is_applicable);
  c.attributes.resize(1);
  c.attribute_values = {0, 8, 0, 8};
  EXPECT_FALSE(check_of(kLaw, c, {}, "cpu").is_applicable);
}

TEST(FilteredColours, AreNotJudgedWithoutABound) {
  DamagedBackend backend({}, "cpu");
  backend.promised = backend.contract(square());
  backend.promised->texture_bounds.reset();
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  EXPECT_FALSE(check_of(kLaw, square(), backend).is_applicable);
  EXPECT_TRUE(is_promised(*find_law("texels-are-those-of-the-exact-coordinates"), backend));
}

TEST(FilteredColours, ShowAnotherFilter) {
  const auto swapped = [](Filter from, Filter to) {
    return broken_by([from, to](Pipeline& pipeline) {
      if (pipeline.texturing->filter == from) pipeline.texturing->filter = to;
    });
  };
  EXPECT_GT(swapped(Filter::bilinear, Filter::nearest), 20);
  EXPECT_GT(swapped(Filter::bilinear, Filter::trilinear), 10);
  EXPECT_GT(swapped(Filter::trilinear, Filter::bilinear), 10);
}

// Rounding to the bytes of a framebuffer is far beyond a filter's bound.
TEST(FilteredColours, ShowRoundingToBytes) {
  EXPECT_GT(broken_by([](Pipeline& pipeline) { pipeline.format = cases::ColorFormat::rgba8; }), 25);
}

// If coordinates are small, an error of more than a few units of 2^-24 is too large.
TEST(FilteredColours, AreJudgedByTheBound) {
  // The case has so few pixels that the law judges all of them.
  Case c = square();
  c.framebuffer = {4, 4, 1};
  c.viewport.width = c.viewport.height = 4;
  const auto found_of = [&c](float damage) {
    DamagedBackend backend({}, "cpu");
    backend.picture_damage = [damage](const Pipeline&, cases::Picture& picture) {
      picture.color[4 * 5] += damage;
    };
    return check_of(kLaw, c, backend);
  };
  EXPECT_EQ(found_of(0).violation_count, 0U);
  const Check check = found_of(0x1p-12F);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].place.x, 1U);
  EXPECT_EQ(check.violations[0].place.y, 1U);
  EXPECT_THAT(check.violations[0].note, HasSubstr("at s = 3, t = 1; allowed is "));
}

TEST(FilteredColours, OfADriverAreThoseOfPermittedCoordinates) {
  DamagedBackend backend({}, "cpu");
  backend.picture_bounds = driver_bounds();
  const FoundInOwnCases found = check_own_cases(kLaw, backend, 100);
  EXPECT_EQ(found.violated, 0);
  EXPECT_GT(found.required, 300U);
  EXPECT_THAT(found.labels(), testing::Contains("bilinear"));
  EXPECT_THAT(found.labels(), testing::Not(testing::Contains("trilinear")));
  backend.pipeline_damage = [](Pipeline& pipeline) {
    pipeline.texturing->filter = Filter::nearest;
  };
  EXPECT_GT(check_own_cases(kLaw, backend, 100).violated, 20);
}

}  // namespace
}  // namespace rastercheck::properties::filtered_colours_stay_within_the_bound_test
