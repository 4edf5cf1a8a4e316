// The projective map of a triangle after the division, by hand.

#include "oracle/triangle_truth.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::triangle_truth_test {
namespace {

using Texts = std::array<std::string, 3>;

Texts texts(const std::array<Rational, 3>& numbers) {
  return {numbers[0].to_string(), numbers[1].to_string(), numbers[2].to_string()};
}

// Window corners (0, 0), (4, 0), (0, 4), w = 1: e = (1 - u/4 - v/4, u/4, v/4).
TEST(QMatrixOfATriangle, IsTheInverseWithTheDivision) {
  const cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}}});
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  const QMatrix q = truth.q_matrix().value();
  EXPECT_EQ(texts(q[0]), (Texts{"-1/4", "-1/4", "1"}));
  EXPECT_EQ(texts(q[1]), (Texts{"1/4", "0", "0"}));
  EXPECT_EQ(texts(q[2]), (Texts{"0", "1/4", "0"}));
  EXPECT_EQ(texts(truth.edges(0, 1, 0).value()), (Texts{"1/2", "1/8", "3/8"}));
}

// Kills: w left out; |det M| left in; the row of another vertex.
TEST(QMatrixOfATriangle, HasTheWeightsOfAPerspectiveOne) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {2, -2, 0, 2}, {-3, 3, 0, 3}}});
  for (const bool is_turned : {false, true}) {
    SCOPED_TRACE(is_turned);
    if (is_turned) c.triangles[0] = {0, 2, 1};  // det M < 0
    const SceneTruth scene(c, cases::contract_of(c));
    const TriangleTruth truth(scene, 0);
    const QMatrix q = truth.q_matrix().value();
    EXPECT_EQ(texts(q[0]), (Texts{"-1/4", "-1/4", "1"}));
    EXPECT_EQ(texts(q[is_turned ? 2 : 1]), (Texts{"1/8", "0", "0"}));
    EXPECT_EQ(texts(q[is_turned ? 1 : 2]), (Texts{"0", "1/12", "0"}));
    const Texts e = texts(truth.edges(0, 0, 0).value());
    EXPECT_EQ(e[0], "3/4");
    EXPECT_EQ(e[is_turned ? 2 : 1], "1/16");
    EXPECT_EQ(e[is_turned ? 1 : 2], "1/24");
  }
}

TEST(QMatrixOfATriangle, IsEmptyIfTheTriangleIsSeenEdgeOn) {
  const cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {1, 1, 0, 1}, {0, 0, 0, 1}}});
  const SceneTruth scene(c, cases::contract_of(c));
  EXPECT_FALSE(TriangleTruth(scene, 0).q_matrix());
  EXPECT_FALSE(TriangleTruth(scene, 0).edges(1, 1, 0));
}

}  // namespace
}  // namespace rastercheck::oracle::triangle_truth_test
