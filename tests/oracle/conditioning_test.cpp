// Condition numbers, by hand. The triangle's window corners are (0,0), (4,0), (0,4), all w = 1:
// e = (1 − u/4 − v/4, u/4, v/4), at (1/2, 1/2): (3/4, 1/8, 1/8).

#include <gtest/gtest.h>

#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::conditioning_test {
namespace {

Conditioning at_first_pixel(const std::array<std::vector<float>, 3>& values) {
  const cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                                   {{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}}}, values);
  const SceneTruth scene(c, cases::contract_of(c));
  return *TriangleTruth(scene, 0).conditioning(0, 0, 0, 0);
}

TEST(Kappa, IsOneWhereNothingCancels) {
  EXPECT_EQ(at_first_pixel({{{1}, {2}, {3}}}).kappa->to_string(), "1");
}

TEST(Kappa, GrowsWithCancellation) {
  // |N| = |−3/4 + 1/8| = 5/8, Σ|r_i| e_i = 7/8.
  EXPECT_EQ(at_first_pixel({{{-1}, {1}, {0}}}).kappa->to_string(), "7/5");
}

TEST(Kappa, IsAbsentAtAZeroOfTheValue) { EXPECT_FALSE(at_first_pixel({{{-1}, {6}, {0}}}).kappa); }

TEST(Conditioning, IsEmptyForFlatAttributes) {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4,
                             {{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}}}, {{{1}, {2}, {3}}});
  c.attributes[0].interpolation = cases::Interpolation::flat;
  const SceneTruth scene(c, cases::contract_of(c));
  EXPECT_FALSE(TriangleTruth(scene, 0).conditioning(0, 0, 0, 0));
}

TEST(KappaD, IsTheWorstCancellationOfAWeight) {
  // The magnitudes of e_0's terms sum to 1/8 + 1/8 + 1, and D = 1.
  EXPECT_EQ(at_first_pixel({{{1}, {2}, {3}}}).kappa_d->to_string(), "5/4");
}

}  // namespace
}  // namespace rastercheck::oracle::conditioning_test
