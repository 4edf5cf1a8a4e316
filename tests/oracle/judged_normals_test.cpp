#include "oracle/judged_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

namespace rastercheck::oracle::judged_normals_test {
namespace {

using records::FragmentClass;

/// Judges one normal of a model.
JudgedNormal judged_normal(const cases::Matrix4& model, const cases::Normal& normal,
                           const cases::Normal& computed, float bound) {
  return judge_normals(model, std::span(&normal, 1), std::span(&computed, 1), bound).front();
}

// The cofactor matrix is C = diag(6, 3, 2), so that (1, 2, 3) becomes (6, 6, 6).
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

// (3, 4) / 5 is rational: with bound 0, the coordinate 0 may be off by 2^-51 and half an ulp, but
// no more.
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

// The model flattens z, so that all its cofactors but the last are 0: only the z of a normal
// remains.
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
}  // namespace rastercheck::oracle::judged_normals_test
