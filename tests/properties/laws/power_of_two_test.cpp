// The law catches, to the bit, drawings that compare coordinates with a constant.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::power_of_two_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::Contains;

constexpr std::string_view kLaw = "a-power-of-two-changes-no-bit";
constexpr int kNumbers = 32;

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage); }

/// The square; another number makes the law choose other factors.
Case numbered(int number) {
  Case c = square();
  c.attribute_values[2] = static_cast<float>(number);
  return c;
}

TEST(PowerOfTwo, MultipliesAllCoordinatesOfATriangle) {
  std::set<float> factors;
  for (int number = 0; number < kNumbers; ++number) {
    std::vector<Case> seen;
    const Check check =
        checked(numbered(number), [&](const Case& c, Fragments&) { seen.push_back(c); });
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_EQ(check.judgement.counts.required, 64U);
    ASSERT_EQ(seen.size(), 2U);
    for (std::size_t t = 0; t < 2; ++t) {
      const float factor = seen[1].positions[3 * t].w;
      factors.insert(factor);
      EXPECT_EQ(std::exp2(std::ilogb(factor)), factor);
      for (std::size_t v = 3 * t; v < 3 * t + 3; ++v) {
        const cases::ClipVertex& before = seen[0].positions[v];
        EXPECT_EQ(seen[1].positions[v], (cases::ClipVertex{before.x * factor, before.y * factor,
                                                           before.z * factor, before.w * factor}));
      }
    }
  }
  EXPECT_GT(factors.size(), 20U);
}

TEST(PowerOfTwo, ScalesClipDistancesOrLeavesThem) {
  std::set<bool> are_scaled;
  for (int number = 0; number < kNumbers; ++number) {
    Case c = numbered(number);
    c.clip_distance_count = 1;
    c.clip_distances = {1, 0.25F, 1, -1};
    std::vector<Case> seen;
    EXPECT_EQ(
        checked(c, [&](const Case& drawn, Fragments&) { seen.push_back(drawn); }).violation_count,
        0U);
    const bool is_scaled = seen[0].clip_distances != seen[1].clip_distances;
    are_scaled.insert(is_scaled);
    if (is_scaled) {
      EXPECT_EQ(seen[1].clip_distances[1], seen[1].positions[1].w / 4);
    }
  }
  EXPECT_EQ(are_scaled, (std::set{false, true}));
}

// The backend discards triangles that are nearer to the eye than some constant.
TEST(PowerOfTwo, FindsALeastW) {
  bool is_found = false;
  for (int number = 0; number < kNumbers; ++number) {
    float least = 1;
    const Check check = checked(numbered(number), [&](const Case& c, Fragments& drawn) {
      for (std::uint32_t t = 0; t < 2; ++t) {
        least = std::min(least, c.positions[c.triangles[t][0]].w);
        if (c.positions[c.triangles[t][0]].w < 0.01F) {
          while (std::count(drawn.triangle.begin(), drawn.triangle.end(), t) > 0) {
            const auto at = std::find(drawn.triangle.begin(), drawn.triangle.end(), t);
            const auto i = static_cast<std::size_t>(at - drawn.triangle.begin());
            drop(drawn, t, drawn.x[i], drawn.y[i]);
          }
        }
      }
    });
    EXPECT_EQ(check.violation_count > 0, least < 0.01F);
    if (check.violation_count == 0) continue;
    is_found = true;
    EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
    EXPECT_THAT(check.labels, Contains("smaller"));
  }
  EXPECT_TRUE(is_found);
}

TEST(PowerOfTwo, FindsALastBit) {
  bool is_first = true;
  const Check check = checked(square(), [&](const Case&, Fragments& drawn) {
    if (!is_first) value(drawn, 1, 5, 5, 0) = std::nextafter(5.5F, 6.0F);
    is_first = false;
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(check.violations.front().place.x, 5U);
}

TEST(PowerOfTwo, SaysNothingWhereNoFactorKeepsAllDigits) {
  Case c = square();
  c.triangles = {{0, 1, 2}};
  c.positions[0].z = 0x1p-126F;
  c.positions[1].w = 0x1p127F;
  EXPECT_FALSE(checked(c, {}).is_applicable);
  c.positions[1].w = 0x1p126F;
  bool is_first = true;
  checked(c, [&](const Case& drawn, Fragments&) {
    if (!is_first) {
      EXPECT_EQ(drawn.positions[1].w, 0x1p127F);
    }
    is_first = false;
  });
  EXPECT_FALSE(is_first);
}

}  // namespace
}  // namespace rastercheck::properties::power_of_two_test
