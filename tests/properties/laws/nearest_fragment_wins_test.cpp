// The law catches a depth test that leaves a fragment other than the nearest, a later one of
// several equally near ones, or other values.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::nearest_fragment_wins_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "the-nearest-fragment-wins";

/// Triangle A of the square three times, at these depths.
Case layers(float first, float second, float third) {
  Case c = square();
  c.positions.clear();
  for (const float depth : {first, second, third}) {
    c.positions.insert(c.positions.end(),
                       {{-1, -1, depth, 1}, {1, -1, depth, 1}, {-1, 1, depth, 1}});
  }
  c.attribute_values.assign(c.positions.size() * 3, 0);
  c.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  return c;
}

bool is_tested(const Case& c) { return c.depth_test == cases::DepthTest::less; }

/// Leaves triangle `left` at pixel (1, 1) after the depth test.
Damage leaving(std::uint32_t left, float depth) {
  return [=](const Case& c, Fragments& drawn) {
    if (!is_tested(c)) return;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (drawn.x[i] != 1 || drawn.y[i] != 1) continue;
      drawn.triangle[i] = left;
      drawn.depth[i] = depth;
    }
  };
}

TEST(NearestFragment, Wins) {
  const Check check = check_of(kLaw, layers(0.5F, 0.25F, 0.75F), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 28U);
  EXPECT_THAT(check.labels, testing::ElementsAre("depth test", "farther drawn first", "overdraw",
                                                 "three and more"));
}

TEST(NearestFragment, IsNotTheLastOne) {
  const Check check = check_of(kLaw, layers(0.5F, 0.25F, 0.75F), leaving(2, 0.75F));
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::wrong_triangle);
  EXPECT_EQ(violation.place.triangle, 2U);
  EXPECT_EQ(violation.place.x, 1U);
  EXPECT_EQ(violation.place.y, 1U);
  EXPECT_EQ(violation.exact, "forbidden: triangle 1 is nearer");
  EXPECT_THAT(violation.note, HasSubstr("the nearest of 3 at 0.25"));
}

/// Checks a case under the depth tests of another depth buffer.
Check check_under(cases::DepthFormat format, const Case& c, const Damage& damage) {
  DamagedBackend backend(damage);
  backend.promised = backend.promise(c);
  backend.promised->depth_format = format;
  return check_law(*find_law(kLaw), c, backend, 0).value();
}

// Kills: comparing depths as floats although the backend's depth buffer has 24 bits or holds
// doubles.
TEST(NearestFragment, IsToldByWhatTheBufferHolds) {
  constexpr float kNear = 0.5F - 0x1p-25F;  // nearer by less than a step of 1/(2^24 - 1)
  const Case c = layers(0.5F, kNear, 0.75F);
  const Damage leaves_first = leaving(0, 0.5F);
  EXPECT_EQ(check_under(cases::DepthFormat::float32, c, leaves_first).violation_count, 1U);
  EXPECT_EQ(check_under(cases::DepthFormat::unorm24, c, leaves_first).violation_count, 0U);
  EXPECT_EQ(check_under(cases::DepthFormat::unorm24, c, leaving(1, kNear)).violation_count, 0U);
  const Case farther = layers(0.5F, 0.5F - 0x1p-22F, 0.75F);
  EXPECT_EQ(check_under(cases::DepthFormat::unorm24, farther, leaves_first).violation_count, 1U);
  EXPECT_EQ(check_under(cases::DepthFormat::unorm32, farther, leaves_first).violation_count, 1U);
  // If the nearer triangle is drawn first, rounding cannot make a later depth less than its depth.
  EXPECT_EQ(check_under(cases::DepthFormat::unorm24, layers(kNear, 0.5F, 0.75F), leaving(1, 0.5F))
                .violation_count,
            1U);
  // Depths that are the same float may be different doubles, so that either may be nearer.
  const Case equal = layers(0.5F, 0.5F, 0.75F);
  const Damage leaves_second = leaving(1, 0.5F);
  EXPECT_EQ(check_under(cases::DepthFormat::float64, equal, leaves_second).violation_count, 0U);
  EXPECT_EQ(check_under(cases::DepthFormat::unorm24, equal, leaves_second).violation_count, 0U);
  EXPECT_EQ(check_under(cases::DepthFormat::float32, equal, leaves_second).violation_count, 1U);
}

// Kills: fragments at the buffer's initial depth that are required, or forbidden, whatever the case
// says.
TEST(NearestFragment, IsNearerThanTheBeginningOfTheBuffer) {
  const Damage drops_all = [](const Case& c, Fragments& drawn) {
    const std::size_t attributes = drawn.attribute_count;
    if (!is_tested(c)) return;
    drawn = {};
    drawn.attribute_count = attributes;
  };
  EXPECT_EQ(check_of(kLaw, layers(1, 1, 1), {}).violation_count, 0U);
  EXPECT_EQ(check_of(kLaw, layers(1, 1, 1), drops_all).violation_count, 0U);
  EXPECT_EQ(check_of(kLaw, layers(0.5F, 1, 1), drops_all).violation_count, 28U);
  Case c = layers(0.5F, 0.25F, 0.75F);
  c.depth_clear = 0.25F;
  EXPECT_EQ(check_of(kLaw, c, {}).violation_count, 0U);
  const Damage ignores_it = [](const Case& asked, Fragments& drawn) {
    if (!is_tested(asked)) return;
    Case other = asked;
    other.depth_clear.reset();
    drawn = backends::make_backend("method:rational-linear").value()->draw(other).value().fragments;
  };
  const Check check = check_of(kLaw, c, ignores_it);
  EXPECT_EQ(check.violation_count, 28U);
  EXPECT_EQ(check.violations.front().exact,
            "forbidden: it is not nearer than the value that the depth buffer is cleared to");
}

// Finds a depth test by "less or equal".
TEST(NearestFragment, IsTheFirstOfEqualOnes) {
  const Case c = layers(0.5F, 0.25F, 0.25F);
  const Check right = check_of(kLaw, c, {});
  EXPECT_EQ(right.violation_count, 0U);
  EXPECT_THAT(right.labels, testing::Contains("equal nearest"));
  const Check check = check_of(kLaw, c, leaving(2, 0.25F));
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().exact, "forbidden: triangle 1 is as near and was drawn first");
}

// Two equal depths behind the nearest fragment do not count as a tie.
TEST(NearestFragment, IsEqualToNoneThatIsFarther) {
  const Check check = check_of(kLaw, layers(0.5F, 0.5F, 0.25F), {});
  EXPECT_THAT(check.labels, testing::Not(testing::Contains("equal nearest")));
}

TEST(NearestFragment, HasItsOwnValuesToTheBit) {
  const Check check =
      check_of(kLaw, layers(0.5F, 0.25F, 0.75F), [](const Case& c, Fragments& drawn) {
        if (!is_tested(c)) return;
        value(drawn, 1, 2, 3, 0) = std::numeric_limits<float>::denorm_min();
        const std::size_t at = find(drawn, 1, 2, 2);
        drawn.depth[at] = std::nextafter(0.25F, 0.0F);
      });
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].kind, records::AttributeKind::depth);
  EXPECT_EQ(check.violations[1].attribute, 0U);
  EXPECT_EQ(check.violations[1].place.y, 3U);
}

TEST(NearestFragment, IsThereAndAlone) {
  const Check check =
      check_of(kLaw, layers(0.5F, 0.25F, 0.75F), [](const Case& c, Fragments& drawn) {
        if (!is_tested(c)) return;
        drop(drawn, 1, 1, 1);
        add(drawn, 0, 2, 2);
        add(drawn, 0, 7, 7);
      });
  ASSERT_EQ(check.violation_count, 3U);
  EXPECT_EQ(check.violations[0].exact, "forbidden: more than one fragment is left");
  EXPECT_EQ(check.violations[1].exact, "forbidden: nothing is drawn there without a depth test");
  EXPECT_EQ(check.violations[2].fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations[2].place.triangle, 1U);
}

TEST(NearestFragment, LeavesDepthsThatAreNoNumberAlone) {
  const Check check =
      check_of(kLaw, layers(0.5F, 0.25F, 0.75F), [](const Case& c, Fragments& drawn) {
        if (is_tested(c)) {
          drop(drawn, 1, 1, 1);
        } else {
          drawn.depth[find(drawn, 0, 1, 1)] = std::numeric_limits<float>::quiet_NaN();
        }
      });
  EXPECT_EQ(check.violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::nearest_fragment_wins_test
