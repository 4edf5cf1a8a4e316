// `cpu` keeps the law on differences across quads, helpers that do not follow the triangle's own
// map break it, and the law does not apply to values that the map does not define.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/driver_bounds.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::differences_across_quads_stay_within_the_bound_test {
namespace {

using cases::Case;
using cases::Picture;
using cases::Pipeline;
using cases::Shading;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "differences-across-quads-stay-within-the-bound";

/// The number of the law's first hundred cases that the backend breaks.
int broken(DamagedBackend& backend) { return check_own_cases(kLaw, backend, 100).violated; }

TEST(QuadDifferences, HoldOfCpuAndMeetWhatTheyAreAbout) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 300);
  EXPECT_EQ(found.violated, 0);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf({"along x", "along y", "beyond the framebuffer",
                                     "beyond the triangle", "no one difference", "cancellation",
                                     "next to the horizon", "several samples", "w <= 0"}));
}

// Attribute 0 is the window x: differences are 1 along x and 0 along y. A pixel with even x is
// paired with the next one, a pixel with odd x with the one before. The pair may be in the other
// triangle, which has the same map.
TEST(QuadDifferences, OfTheSquareAreOneOrZero) {
  DamagedBackend backend({}, "cpu");
  bool is_along_x = false;
  backend.picture_damage = [&is_along_x](const Pipeline& pipeline, Picture& picture) {
    is_along_x = pipeline.shading == Shading::differences_along_x;
    picture.color[3 * 9] = std::nextafter(is_along_x ? 1.0F : 0.0F, 2.0F);
    picture.color[3 * 10 + 1] = std::numeric_limits<float>::quiet_NaN();
  };
  const Check check = check_of(kLaw, square(), backend);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  // An error of ulp(1) is more than half an ulp plus 16 · 2^-29; an error of 2^-149 is less.
  ASSERT_EQ(check.violation_count, is_along_x ? 2U : 1U);
  const records::Violation& last = check.violations.back();
  EXPECT_EQ(last.fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(last.kind, AttributeKind::smooth);
  EXPECT_EQ(last.attribute, 1U);
  EXPECT_EQ(last.place.x, 2U);
  EXPECT_EQ(last.place.y, 1U);
  EXPECT_EQ(last.exact, "0");
}

TEST(QuadDifferences, ShowTheOtherAxisAndTheOtherDirection) {
  DamagedBackend other_axis({}, "cpu");
  other_axis.pipeline_damage = [](Pipeline& pipeline) {
    pipeline.shading = pipeline.shading == Shading::differences_along_x
                           ? Shading::differences_along_y
                           : Shading::differences_along_x;
  };
  EXPECT_GT(broken(other_axis), 50);
  DamagedBackend backwards({}, "cpu");
  backwards.picture_damage = [](const Pipeline&, Picture& picture) {
    for (float& color : picture.color) color = -color;
  };
  EXPECT_GT(broken(backwards), 50);
}

// Helpers that copy the value of the fragment next to them.
TEST(QuadDifferences, ShowHelpersThatAreHeldToTheEdge) {
  DamagedBackend backend({}, "cpu");
  backend.picture_damage = [](const Pipeline& pipeline, Picture& picture) {
    const auto samples = static_cast<std::size_t>(picture.size.samples);
    const auto width = static_cast<std::size_t>(picture.size.width);
    const bool is_along_x = pipeline.shading == Shading::differences_along_x;
    for (std::size_t at = 0; at < picture.depth.size(); ++at) {
      const std::size_t x = at / samples % width;
      const std::size_t y = at / samples / width;
      const std::size_t other_x = is_along_x ? x ^ 1 : x;
      const std::size_t other_y = is_along_x ? y : y ^ 1;
      const std::size_t other = (other_y * width + other_x) * samples + at % samples;
      const bool is_drawn =
          other_x < width && other < picture.depth.size() && std::isfinite(picture.depth[other]);
      for (std::size_t k = 0; !is_drawn && k < picture.channels; ++k) {
        picture.color[at * picture.channels + k] = 0;
      }
    }
  };
  EXPECT_GT(broken(backend), 40);
}

TEST(QuadDifferences, AreOfBackendsThatPromiseThem) {
  DamagedBackend backend({}, "cpu");
  EXPECT_TRUE(is_promised(*find_law(kLaw), backend));
  EXPECT_TRUE(check_of(kLaw, square(), backend).is_applicable);
  Case c = square();
  c.attributes.clear();
  c.attribute_values.clear();
  EXPECT_FALSE(check_of(kLaw, c, backend).is_applicable);
  backend.promised = backend.contract(square());
  backend.promised->quad_share.reset();
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  EXPECT_FALSE(check_of(kLaw, square(), backend).is_applicable);
}

TEST(QuadDifferences, OfADriverAreThoseOfTheValuesThatItDraws) {
  DamagedBackend backend({}, "cpu");
  backend.picture_bounds = driver_bounds();
  const FoundInOwnCases found = check_own_cases(kLaw, backend, 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_GT(found.required, 300U);
  // Differences with the other sign, and of the quad's other row or column.
  backend.picture_damage = [](const Pipeline&, Picture& picture) {
    for (float& color : picture.color) color = -color;
  };
  EXPECT_GT(broken(backend), 5);
  backend.picture_damage = [](const Pipeline& pipeline, Picture& picture) {
    const auto width = static_cast<std::size_t>(picture.size.width) * picture.channels;
    const bool is_along_x = pipeline.shading == Shading::differences_along_x;
    const std::size_t step = is_along_x ? width : picture.channels;
    const std::vector<float> before = picture.color;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const std::size_t at = is_along_x ? i / width : i % width / picture.channels;
      const std::size_t other = at % 2 == 0 ? i + step : i - step;
      const bool is_inside = other < before.size() && (is_along_x || other / width == i / width);
      if (is_inside) picture.color[i] = before[other];
    }
  };
  EXPECT_GT(broken(backend), 5);
  backend.picture_bounds->keeps_fragments = false;
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
}

}  // namespace
}  // namespace rastercheck::properties::differences_across_quads_stay_within_the_bound_test
