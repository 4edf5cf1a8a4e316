#include "oracle/judged_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::judged_transform_test {
namespace {

using cases::ClipVertex;
using records::FragmentClass;

/// Judges coordinate x of vertex 0, which is the product of the projection's first row and `first`.
JudgedNumber judged_x(const cases::Matrix4& projection, const ClipVertex& first, float bound,
                      float computed) {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4, {{first, {0, 0, 0, 1}, {1, 0, 0, 1}}});
  c.camera.emplace();
  c.camera->projection = projection;
  std::vector<ClipVertex> positions(c.positions.size(), ClipVertex{0, 0, 0, 1});
  positions[0].x = computed;
  return judge_transform(c, positions, bound)[0][0];
}

// The exact value is 2^40 − 2^40; the allowed error is half an ulp of the computed number and bound
// · 2^-53 · 2^41.
TEST(JudgedTransform, AllowsHalfAnUlpAndTheBoundsShareOfTheSizes) {
  cases::Matrix4 projection = cases::kIdentity;
  projection[1] = 0x1p40F;
  projection[2] = 0x1p40F;
  const auto at = [&projection](float computed, float bound) {
    return judged_x(projection, {0, 1, -1, 1}, bound, computed);
  };
  EXPECT_EQ(at(0x1p-12F, 1).fragment_class, FragmentClass::correct);
  EXPECT_EQ(at(-0x1p-12F, 1).fragment_class, FragmentClass::correct);
  EXPECT_EQ(at(0x1.0002p-12F, 1).fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(at(0x1.0002p-12F, 1.5F).fragment_class, FragmentClass::correct);
  EXPECT_TRUE(at(0, 1).is_cancelled);
  EXPECT_EQ(at(0x1p-12F, 1).exact, Rational(0));
  // In units of ulp(2^-12) = 2^-35, 2^-12 is 2^23 units.
  EXPECT_EQ(at(0x1p-12F, 1).error, (records::Enclosure{0x1p23, 0x1p23}));
  EXPECT_EQ(at(0x1p-12F, 1).bound, (records::Enclosure{0x1p23 + 0.5, 0x1p23 + 0.5}));
}

TEST(JudgedTransform, TakesAnUlpOfSubnormalsForTwoToTheMinus149) {
  cases::Matrix4 projection{};
  projection[0] = 0x1p-100F;
  const auto at = [&projection](float computed, float x) {
    return judged_x(projection, {x, 0, 0, 1}, 0, computed);
  };
  EXPECT_EQ(at(0x1p-149F, 0x1.8p-49F).fragment_class, FragmentClass::correct);  // 1.5 · 2^-149
  EXPECT_EQ(at(0x1p-148F, 0x1.8p-49F).fragment_class, FragmentClass::correct);
  EXPECT_EQ(at(0, 0x1.8p-49F).fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(at(0, 0x1p-50F).fragment_class, FragmentClass::correct);
  EXPECT_FALSE(at(0, 0x1p-50F).is_cancelled);
}

TEST(JudgedTransform, TakesInfinityForWhatRoundsToIt) {
  const float infinity = std::numeric_limits<float>::infinity();
  const auto at = [](float computed, float x, float bound = 0) {
    cases::Matrix4 projection{};
    projection[0] = 1 + 0x1p-23F;
    return judged_x(projection, {x, 0, 0, 1}, bound, computed);
  };
  const float most = std::numeric_limits<float>::max();
  EXPECT_EQ(at(infinity, most).fragment_class, FragmentClass::correct);
  EXPECT_EQ(at(-infinity, -most).fragment_class, FragmentClass::correct);
  EXPECT_EQ(at(-infinity, most).fragment_class, FragmentClass::infinite);
  EXPECT_EQ(at(infinity, 0x1p127F).fragment_class, FragmentClass::infinite);
  EXPECT_EQ(at(most, most).fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(at(std::nanf(""), 1).fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(at(std::nanf(""), 1).error, std::nullopt);
  EXPECT_EQ(at(infinity, most).bound, std::nullopt);
}

TEST(JudgedTransform, TakesPositionsWithoutACameraForTheExactOnes) {
  const auto c = small_case(cases::Rules::d3d, 4, 4, {{{1, 2, 3, 4}, {0, 0, 0, 1}, {1, 0, 0, 1}}});
  const auto judged = judge_transform(c, c.positions, 0);
  ASSERT_EQ(judged.size(), 3U);
  EXPECT_EQ(judged[0][3].exact, Rational(4));
  EXPECT_EQ(judged[0][3].error, (records::Enclosure{0, 0}));
}

}  // namespace
}  // namespace rastercheck::oracle::judged_transform_test
