#include "cases/contract.h"

#include <gtest/gtest.h>

#include <array>

#include "cases/case.h"

namespace rastercheck::cases::contract_test {
namespace {

TEST(MagnitudeRange, HasItsEndsOfEitherSignAndZero) {
  const MagnitudeRange range{0.5F, 2};
  for (const float number : {0.5F, -0.5F, 2.0F, -2.0F, 1.0F, 0.0F, -0.0F}) {
    EXPECT_TRUE(range.has(number)) << number;
  }
  for (const float number : {0x1.fffffep-2F, 0x1.000002p1F, -3.0F, 0x1p-149F}) {
    EXPECT_FALSE(range.has(number)) << number;
  }
  EXPECT_TRUE(MagnitudeRange().has(0x1p-149F));
  EXPECT_TRUE(MagnitudeRange().has(-0x1.fffffep127F));
}

/// Tests promises for a case whose numbers are all 1, except one that becomes 4.
class PromisesTest : public testing::Test {
 protected:
  PromisesTest() {
    contract_.numbers = {0.5F, 2};
    case_.viewport = {0, 0, 64, 64, 1, 1};
    case_.attributes = {{"smooth"}, {"flat", Interpolation::flat}};
    case_.positions = {{1, 1, 1, 1}, {1, 1, 1, 1}};
    case_.attribute_values = {1, 1, 1, 1};
    case_.clip_distances = {1, 1};
    case_.clip_distance_count = 1;
    case_.triangles = {{0, 0, 0}, {1, 1, 1}};
  }

  bool are_made() const { return promises_all_of(contract_, case_); }

  Contract contract_;
  Case case_;
};

TEST_F(PromisesTest, AreMadeOfNumbersInRange) { EXPECT_TRUE(are_made()); }

TEST_F(PromisesTest, DependOnEveryNumberThatIsComputedWith) {
  ClipVertex& p = case_.positions[0];
  for (float* const number :
       {&p.x, &p.y, &p.z, &p.w, &case_.attribute_values[0], &case_.clip_distances[0],
        &case_.viewport.min_depth, &case_.viewport.max_depth}) {
    *number = 4;
    EXPECT_FALSE(are_made());
    *number = 1;
  }
  case_.attribute_values[1] = 4;
  EXPECT_TRUE(are_made());
}

TEST_F(PromisesTest, AreOfTheTrianglesAndValuesThatHaveTheNumbers) {
  case_.positions[0].z = 4;
  EXPECT_FALSE(promise_of(contract_, case_, 0).is_made);
  EXPECT_TRUE(promise_of(contract_, case_, 1).is_made);
  case_.positions[0].z = 1;
  case_.attribute_values[0] = 4;
  EXPECT_TRUE(promise_of(contract_, case_, 0).is_made);
  EXPECT_FALSE(promises_values_of(contract_, case_, 0, 0));
  EXPECT_TRUE(promises_values_of(contract_, case_, 1, 0));
  EXPECT_TRUE(promises_depth_range_of(contract_, case_));
}

TEST_F(PromisesTest, AreThoseOfTheTriangleWhereThereAreSuch) {
  contract_.clip_tolerance = 3;
  EXPECT_EQ(promise_of(contract_, case_, 1).clip_tolerance, 3);
  contract_.triangles.resize(2);
  contract_.triangles[1].clip_tolerance = 2;
  contract_.triangles[1].bounds.depth.constant = 7;
  EXPECT_EQ(promise_of(contract_, case_, 1), contract_.triangles[1]);
  EXPECT_EQ(promise_of(contract_, case_, 0), TrianglePromise());
}

}  // namespace
}  // namespace rastercheck::cases::contract_test
