// Screen derivatives, by hand. The triangle's window corners are (0,0), (4,0), (0,4); with
// w = (1, 2, 1): 1/w = 1 − u/8, and r = (0, 1, 0) gives N = u/8, so r = u/(8 − u).

#include <gtest/gtest.h>

#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle {
namespace {

cases::Case corner(float w1, const std::array<std::vector<float>, 3>& values) {
  return small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {w1, -w1, 0, w1}, {-1, 1, 0, 1}}},
                    values);
}

class Truth {
 public:
  explicit Truth(const cases::Case& c) : scene_(c, cases::contract_of(c)), truth_(scene_, 0) {}
  const TriangleTruth* operator->() const { return &truth_; }

 private:
  SceneTruth scene_;
  TriangleTruth truth_;
};

TEST(Derivatives, OfAnAffineAttributeAreItsSlopes) {
  const Truth truth(corner(1, {{{0}, {1}, {2}}}));  // r = u/4 + v/2
  const auto d = truth->derivatives(0, 1, 0, 0);
  EXPECT_EQ(d->du.to_string(), "1/4");
  EXPECT_EQ(d->dv.to_string(), "1/2");
}

TEST(Derivatives, OfARationalAttributeFollowTheQuotientRule) {
  const Truth truth(corner(2, {{{0}, {1}, {0}}}));
  EXPECT_EQ(truth->attribute(0, 0, 0, 0)->lo.to_string(), "1/15");
  const auto d = truth->derivatives(0, 0, 0, 0);
  EXPECT_EQ(d->du.to_string(), "32/225");  // 8/(8 − 1/2)²
  EXPECT_EQ(d->dv.to_string(), "0");
}

TEST(Derivatives, OfAFlatAttributeAreZero) {
  auto c = corner(2, {{{0}, {1}, {0}}});
  c.attributes[0].interpolation = cases::Interpolation::flat;
  const Truth truth(c);
  EXPECT_EQ(truth->derivatives(0, 0, 0, 0)->du.to_string(), "0");
}

TEST(Derivatives, OfANoperspectiveAttributeAreItsWindowSlopes) {
  auto c = corner(2, {{{0}, {1}, {0}}});
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  const Truth truth(c);
  EXPECT_EQ(truth->derivatives(0, 0, 0, 0)->du.to_string(), "1/4");
}

TEST(Derivatives, AreNotGivenWhereSeveralPlacementsAreOpen) {
  auto c = corner(1, {{{0}, {1}, {2}}});
  c.positions[1].x = 0.999F;
  c.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
  c.basis = cases::Basis::unspecified;
  EXPECT_FALSE(Truth(c)->derivatives(0, 1, 1, 0));
}

TEST(Derivatives, AreNotGivenWhereTheValueIsUndefined) {
  // w1 = −1: 1/w = 1 − u/2 vanishes at u = 2, before the centre of pixel 2.
  auto c = corner(-1, {{{0}, {1}, {0}}});
  for (const auto interpolation :
       {cases::Interpolation::smooth, cases::Interpolation::noperspective}) {
    c.attributes[0].interpolation = interpolation;
    c.attributes[0].location = cases::Location::center;
    const Truth truth(c);
    EXPECT_FALSE(truth->attribute(0, 2, 0, 0));
    EXPECT_FALSE(truth->derivatives(0, 2, 0, 0));
    EXPECT_FALSE(truth->quad_differences(0, 2, 0, 0));
    EXPECT_FALSE(truth->conditioning(0, 2, 0, 0));
  }
}

TEST(QuadDifferences, AreTakenAcrossTheEvenAlignedQuad) {
  const Truth truth(corner(2, {{{0}, {1}, {0}}}));
  // r(3/2) − r(1/2) = 3/13 − 1/15, for both pixels of the quad.
  EXPECT_EQ(truth->quad_differences(0, 0, 0, 0)->du.to_string(), "32/195");
  EXPECT_EQ(truth->quad_differences(0, 1, 0, 0)->du.to_string(), "32/195");
  EXPECT_EQ(truth->quad_differences(0, 1, 1, 0)->dv.to_string(), "0");
}

TEST(QuadDifferences, ExtrapolateToHelperPixels) {
  const Truth truth(corner(1, {{{0}, {1}, {2}}}));
  EXPECT_EQ(truth->judge(3, 1, 0).verdict, records::Verdict::forbidden);
  EXPECT_EQ(truth->quad_differences(0, 2, 0, 0)->du.to_string(), "1/4");
}

TEST(LevelOfDetail, CountsTexelsPerPixelInPowersOfTwo) {
  // s = u/4 over 16 texels is 4 texels per pixel; t is constant.
  const Truth truth(corner(1, {{{0, 5}, {1, 5}, {0, 5}}}));
  EXPECT_EQ(*truth->level_of_detail(0, 1, 16, 16, 0, 0, 0), (records::Enclosure{2, 2}));
}

TEST(LevelOfDetail, IsMinusInfinityForAConstant) {
  const Truth truth(corner(1, {{{5}, {5}, {5}}}));
  EXPECT_LT(truth->level_of_detail(0, 0, 16, 16, 0, 0, 0)->hi, -1e300);
}

}  // namespace
}  // namespace rastercheck::oracle
