// `cpu` keeps the law; fragments that are wrongly kept or discarded, and depths left by discarded
// fragments, break it. The law does not apply to cases without coordinates.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/driver_bounds.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::discarding_keeps_the_kept_texels_test {
namespace {

using cases::Case;
using cases::Pipeline;

constexpr std::string_view kLaw = "discarding-draws-what-keeping-the-kept-texels-draws";

/// The number of the law's first hundred cases that a backend with this damage breaks.
int broken_by(const PipelineDamage& damage) {
  DamagedBackend backend({}, "cpu");
  backend.pipeline_damage = damage;
  return check_own_cases(kLaw, backend, 100).violated;
}

TEST(Discarding, IsThatOfCpuAndMeetsWhatItIsAbout) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_THAT(found.labels(), testing::IsSupersetOf({"discarded", "kept", "exactly the limit",
                                                     "overdraw", "several samples"}));
}

TEST(Discarding, SaysNothingOfCasesWithoutCoordinates) {
  Case c = square();
  EXPECT_TRUE(check_of(kLaw, c, {}, "cpu").is_applicable);
  c.attributes.resize(1);
  c.attribute_values = {0, 8, 0, 8};
  EXPECT_FALSE(check_of(kLaw, c, {}, "cpu").is_applicable);
}

TEST(Discarding, ShowsWhatIsKeptOrLost) {
  EXPECT_EQ(broken_by([](Pipeline&) {}), 0);
  EXPECT_GT(broken_by([](Pipeline& pipeline) { pipeline.discard_below.reset(); }), 30);
  // Discards if "less or equal" instead of "less".
  EXPECT_GT(broken_by([](Pipeline& pipeline) {
              float& limit = *pipeline.discard_below;
              limit = std::nextafter(limit, 2.0F);
            }),
            5);
}

// A discarded fragment that writes its depth, as if it had been drawn without a colour.
TEST(Discarding, ShowsDepthThatWasLeft) {
  DamagedBackend backend({}, "cpu");
  backend.picture_damage = [](const Pipeline&, cases::Picture& picture) {
    for (float& depth : picture.depth) {
      if (depth == 1) depth = 0.5F;
    }
  };
  EXPECT_GT(check_own_cases(kLaw, backend, 100).violated, 30);
}

TEST(Discarding, OfADriverKeepsItsBounds) {
  DamagedBackend backend({}, "cpu");
  backend.picture_bounds = driver_bounds();
  const FoundInOwnCases found = check_own_cases(kLaw, backend, 100);
  EXPECT_EQ(found.violated, 0);
  EXPECT_GT(found.required, 300U);
  backend.pipeline_damage = [](Pipeline& pipeline) { pipeline.discard_below.reset(); };
  EXPECT_GT(check_own_cases(kLaw, backend, 100).violated, 30);
  backend.pipeline_damage = {};
  backend.picture_bounds->keeps_fragments = false;
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
}

}  // namespace
}  // namespace rastercheck::properties::discarding_keeps_the_kept_texels_test
