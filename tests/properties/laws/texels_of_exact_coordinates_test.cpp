// `cpu` keeps the law; wrong coordinates, texels or wrap modes break it. The law does not apply to
// cases without coordinates.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/driver_bounds.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::texels_of_exact_coordinates_test {
namespace {

using cases::Case;
using cases::Picture;
using cases::Pipeline;
using cases::Wrap;
using records::AttributeKind;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "texels-are-those-of-the-exact-coordinates";

/// The number of the law's first hundred cases that a backend with this damage breaks.
int broken_by(const PipelineDamage& damage) {
  DamagedBackend backend({}, "cpu");
  backend.pipeline_damage = damage;
  return check_own_cases(kLaw, backend, 100).violated;
}

TEST(Texels, AreThoseOfCpuAndMeetWhatTheyAreAbout) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf({"texel border", "beyond 0 to 1", "repeat", "clamp", "mirror",
                                     "no one coordinate", "several samples", "w <= 0"}));
}

TEST(Texels, SayNothingOfCasesWithoutCoordinates) {
  Case c = square();
  EXPECT_TRUE(check_of(kLaw, c, {}, "cpu").is_applicable);
  c.attributes.resize(1);
  c.attribute_values = {0, 8, 0, 8};
  EXPECT_FALSE(check_of(kLaw, c, {}, "cpu").is_applicable);
}

TEST(Texels, AreNamedWhereTheyAreWrong) {
  DamagedBackend backend({}, "cpu");
  backend.picture_damage = [](const Pipeline&, Picture& picture) {
    picture.color[4 * 9 + 1] += 0x1p-20F;
    picture.color[4 * 10] = std::numeric_limits<float>::quiet_NaN();
  };
  const Check check = check_of(kLaw, square(), backend);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  ASSERT_EQ(check.violation_count, 2U);
  const records::Violation& green = check.violations[0];
  EXPECT_EQ(green.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(green.kind, AttributeKind::smooth);
  EXPECT_EQ(green.attribute, 1U);
  EXPECT_EQ(green.place.triangle, 0U);
  EXPECT_EQ(green.place.x, 1U);
  EXPECT_EQ(green.place.y, 1U);
  EXPECT_THAT(green.exact, HasSubstr("texel ("));
  EXPECT_THAT(green.note, HasSubstr("at s = 3/2, t = 1"));
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::not_a_number);
}

TEST(Texels, ShowCoordinatesOffByAFloat) {
  class Off : public DamagedBackend {
   public:
    Off() : DamagedBackend({}, "cpu") {}
    Result<Picture> draw_picture(const Case& c, const Pipeline& pipeline) override {
      Case damaged = c;
      for (float& value : damaged.attribute_values) value = std::nextafter(value, -1e38F);
      return DamagedBackend::draw_picture(damaged, pipeline);
    }
  };
  Off backend;
  EXPECT_GT(check_own_cases(kLaw, backend, 100).violated, 20);
}

TEST(Texels, ShowEveryWrap) {
  const auto swapped = [](Wrap from, Wrap to) {
    return broken_by([from, to](Pipeline& pipeline) {
      if (pipeline.texturing->wrap_s == from) pipeline.texturing->wrap_s = to;
      if (pipeline.texturing->wrap_t == from) pipeline.texturing->wrap_t = to;
    });
  };
  EXPECT_GT(swapped(Wrap::repeat, Wrap::mirror), 20);
  EXPECT_GT(swapped(Wrap::mirror, Wrap::repeat), 10);
  EXPECT_GT(swapped(Wrap::clamp, Wrap::repeat), 10);
}

TEST(Texels, OfADriverAreAmongThosePermitted) {
  DamagedBackend backend({}, "cpu");
  backend.picture_bounds = driver_bounds();
  const FoundInOwnCases found = check_own_cases(kLaw, backend, 100);
  EXPECT_EQ(found.violated, 0);
  EXPECT_GT(found.required, 1000U);
  EXPECT_THAT(found.labels(), testing::IsSupersetOf({"one texel", "one of several texels"}));
  backend.pipeline_damage = [](Pipeline& pipeline) {
    std::swap(pipeline.texturing->wrap_s, pipeline.texturing->wrap_t);
  };
  EXPECT_GT(check_own_cases(kLaw, backend, 100).violated, 10);
  backend.pipeline_damage = {};
  backend.picture_damage = [](const Pipeline&, Picture& picture) {
    for (float& color : picture.color) color += color == 0 ? 0 : 0x1p-20F;
  };
  EXPECT_GT(check_own_cases(kLaw, backend, 100).violated, 30);
}

}  // namespace
}  // namespace rastercheck::properties::texels_of_exact_coordinates_test
