#include "oracle/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "tests/oracle/small_case.h"

namespace rastercheck::oracle {
namespace {

using cases::ClipVertex;

cases::Case with_projection(const cases::Matrix4& projection, const ClipVertex& first) {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4, {{first, {0, 0, 0, 1}, {1, 0, 0, 1}}});
  c.camera.emplace();
  c.camera->projection = projection;
  return c;
}

TEST(Transform, MultipliesRowsByTheColumnOfThePosition) {
  const auto c =
      with_projection({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}, {1, 2, 3, 1});
  const auto clip = to_clip_case(c, "f");
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->positions[0], (ClipVertex{18, 46, 74, 102}));
  EXPECT_FALSE(clip->camera);
}

TEST(Transform, AppliesModelThenViewThenProjection) {
  auto c = with_projection({2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {1, 0, 0, 1});
  c.camera->view = {1, 0, 0, 10, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // x + 10
  c.camera->model = {3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // 3 x
  EXPECT_EQ(to_clip_case(c, "f")->positions[0].x, 2 * (3 * 1 + 10));
}

TEST(Transform, RoundsOnceToEven) {
  // 1 + 2^-24 is a tie, to 1; with 2^-60 more it is not. Summed in float32 both would be 1.
  const auto tie =
      with_projection({1, 0x1p-24F, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {1, 1, 0, 1});
  EXPECT_EQ(to_clip_case(tie, "f")->positions[0].x, 1.0F);
  const auto above =
      with_projection({1, 0x1p-24F, 0x1p-60F, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {1, 1, 1, 1});
  EXPECT_EQ(to_clip_case(above, "f")->positions[0].x, 0x1.000002p0F);
}

TEST(Transform, KeepsSubnormals) {
  const auto c = with_projection({0x1p-100F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                 {0x1p-49F, 0, 0, 1});
  EXPECT_EQ(to_clip_case(c, "f")->positions[0].x, 0x1p-149F);
}

TEST(Transform, RefusesOverflowAtTheVertex) {
  const auto c =
      with_projection({1, 0, 0, 0, 0x1p127F, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {2, 0, 0, 1});
  const auto clip = to_clip_case(c, "scene.json");
  ASSERT_FALSE(clip);
  EXPECT_EQ(to_string(clip.error()),
            "scene.json: /vertices/0/position: its clip y overflows float32");
}

TEST(Transform, LeavesAClipCaseAsItIs) {
  const auto c = small_case(cases::Rules::d3d, 4, 4, {{{1, 2, 3, 4}, {0, 0, 0, 1}, {1, 0, 0, 1}}});
  EXPECT_EQ(to_clip_case(c, "f").value(), c);
}

using records::FragmentClass;

/// Coordinate x of vertex 0, which the projection's first row and `first` make, judged.
JudgedNumber judged_x(const cases::Matrix4& projection, const ClipVertex& first, float bound,
                      float computed) {
  const cases::Case c = with_projection(projection, first);
  std::vector<ClipVertex> positions(c.positions.size(), ClipVertex{0, 0, 0, 1});
  positions[0].x = computed;
  return judge_transform(c, positions, bound)[0][0];
}

// 2^40 − 2^40: allowed are half an ulp of the computed number and bound · 2^-53 · 2^41.
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
  // In ulp(2^-12) = 2^-35: 2^-12 is 2^23 of them.
  EXPECT_EQ(at(0x1p-12F, 1).error, (records::Enclosure{0x1p23, 0x1p23}));
  EXPECT_EQ(at(0x1p-12F, 1).bound, (records::Enclosure{0x1p23 + 0.5, 0x1p23 + 0.5}));
}

TEST(JudgedTransform, TakesAnUlpOfSubnormalsForTwoToTheMinus149) {
  cases::Matrix4 projection{};
  projection[0] = 0x1p-100F;
  const auto at = [&projection](float computed, float x) {
    return judged_x(projection, {x, 0, 0, 1}, 0, computed);
  };
  EXPECT_EQ(at(0x1p-149F, 0x1.8p-49F).fragment_class, FragmentClass::correct);  // 1 1/2 of it
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

/// One normal of a model, judged.
JudgedNormal judged_normal(const cases::Matrix4& model, const cases::Normal& normal,
                           const cases::Normal& computed, float bound) {
  return judge_normals(model, std::span(&normal, 1), std::span(&computed, 1), bound).front();
}

// C = diag(6, 3, 2), so that (1, 2, 3) becomes (6, 6, 6).
TEST(JudgedNormals, AreTheImagesByCofactors) {
  const cases::Matrix4 model{1, 0, 0, 9, 0, 2, 0, 9, 0, 0, 3, 9, 0, 0, 0, 1};
  const auto class_at = [&model](float x, float bound) {
    return judged_normal(model, {1, 2, 3}, {x, x, x}, bound).components[1].fragment_class;
  };
  const float nearest = 0.57735026F;
  EXPECT_EQ(class_at(nearest, 0), FragmentClass::correct);
  EXPECT_EQ(class_at(std::nextafter(nearest, 0.0F), 0), FragmentClass::beyond_bound);
  EXPECT_EQ(class_at(std::nextafter(nearest, 1.0F), 0), FragmentClass::beyond_bound);
  EXPECT_EQ(class_at(-nearest, 0), FragmentClass::beyond_bound);
  EXPECT_EQ(class_at(std::nextafter(nearest, 1.0F), 0x1p29F), FragmentClass::correct);
  const JudgedNormal judged = judged_normal(model, {1, 2, 3}, {0, 0, 0}, 0);
  EXPECT_TRUE(records::contains(judged.components[0].exact, 0.57735026918962576));
  EXPECT_TRUE(judged.has_direction);
  EXPECT_FALSE(judged.is_mirrored);
  EXPECT_FALSE(judged.is_singular);
}

// (3, 4) / 5 is rational: with no bound 2^-51 and half an ulp are allowed of 0, no more.
TEST(JudgedNormals, AreDecidedExactly) {
  const auto class_at = [](float z) {
    return judged_normal(cases::kIdentity, {3, 4, 0}, {0.6F, 0.8F, z}, 0)
        .components[2]
        .fragment_class;
  };
  EXPECT_EQ(class_at(0x1p-51F), FragmentClass::correct);
  EXPECT_EQ(class_at(0x1.000002p-51F), FragmentClass::beyond_bound);
  EXPECT_EQ(class_at(-0x1p-51F), FragmentClass::correct);
  EXPECT_EQ(class_at(-0x1.000002p-51F), FragmentClass::beyond_bound);
}

TEST(JudgedNormals, TakeTheSignOfTheDeterminant) {
  cases::Matrix4 model = cases::kIdentity;
  model[10] = -1;
  const JudgedNormal judged = judged_normal(model, {0, 0, 1}, {0, 0, -1}, 0);
  EXPECT_TRUE(judged.is_mirrored);
  for (const JudgedComponent& one : judged.components) {
    EXPECT_EQ(one.fragment_class, FragmentClass::correct);
  }
}

// The cofactors of what presses z flat are 0 but for the last: only z of a normal is left.
TEST(JudgedNormals, WithoutAnImageHaveToBeZero) {
  cases::Matrix4 model = cases::kIdentity;
  model[10] = 0;
  const JudgedNormal none = judged_normal(model, {1, 1, 0}, {0, 0, -0.0F}, 0);
  EXPECT_FALSE(none.has_direction);
  EXPECT_TRUE(none.is_singular);
  EXPECT_EQ(none.components[2].fragment_class, FragmentClass::correct);
  EXPECT_EQ(judged_normal(model, {1, 1, 0}, {0, 0, 1}, 8).components[2].fragment_class,
            FragmentClass::beyond_bound);
  EXPECT_EQ(judged_normal(model, {1, 1, 2}, {0, 0, 1}, 0).components[2].fragment_class,
            FragmentClass::correct);
}

}  // namespace
}  // namespace rastercheck::oracle
