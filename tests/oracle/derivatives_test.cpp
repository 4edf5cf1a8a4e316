// Screen derivatives, by hand. The triangle's window corners are (0,0), (4,0), (0,4); with
// w = (1, 2, 1): 1/w = 1 − u/8, and r = (0, 1, 0) gives N = u/8, so r = u/(8 − u).

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::derivatives_test {
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
  // w1 = −1: 1/w = 1 − u/2 vanishes at u = 2, left of the centre of pixel 2.
  auto c = corner(-1, {{{0}, {1}, {0}}});
  for (const auto interpolation :
       {cases::Interpolation::smooth, cases::Interpolation::noperspective}) {
    c.attributes[0].interpolation = interpolation;
    c.attributes[0].location = cases::Location::center;
    const Truth truth(c);
    EXPECT_FALSE(truth->attribute(0, 2, 0, 0));
    EXPECT_FALSE(truth->derivatives(0, 2, 0, 0));
    EXPECT_FALSE(truth->quad_difference(0, WindowAxis::x, 2, 0, 0, 1));
    EXPECT_FALSE(truth->conditioning(0, 2, 0, 0));
  }
}

// e_0 = 1 − u/4 − v/4, e_1 = u/8, e_2 = v/4, and at (1/2, 1/2) 1/w = 15/16.
TEST(ScaledDerivatives, AreMeasuredByTheSizeOfTheirTerms) {
  auto c = corner(2, {{{0}, {-1}, {0}}});
  const auto smooth = Truth(c)->scaled_derivatives(0, 0, 0, 0);
  EXPECT_EQ(smooth->exact.du.to_string(), "-32/225");
  EXPECT_EQ(smooth->exact.dv.to_string(), "0");
  EXPECT_EQ(smooth->scale.du.to_string(), "2/5");   // (1/4 + 1/8) / (15/16)
  EXPECT_EQ(smooth->scale.dv.to_string(), "8/15");  // (1/4 + 1/4) / (15/16)

  c = corner(2, {{{1}, {1}, {0}}});  // r_i w_i = 1, 2, 0
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  const auto affine = Truth(c)->scaled_derivatives(0, 0, 0, 0);
  EXPECT_EQ(affine->exact.du.to_string(), "0");
  EXPECT_EQ(affine->exact.dv.to_string(), "-1/4");
  EXPECT_EQ(affine->scale.du.to_string(), "1/2");
  EXPECT_EQ(affine->scale.dv.to_string(), "1/4");

  c.attributes[0].interpolation = cases::Interpolation::flat;
  const auto flat = Truth(c)->scaled_derivatives(0, 0, 0, 0);
  EXPECT_EQ(flat->exact.du.to_string(), "0");
  EXPECT_EQ(flat->scale.dv.to_string(), "0");
}

cases::Case with_centroid(cases::Rules rules, int samples) {
  auto c = corner(2, {{{0}, {1}, {0}}});
  c.rules = rules;
  c.framebuffer.samples = samples;
  c.attributes[0].location = cases::Location::centroid;
  if (rules != cases::Rules::d3d) return c;
  for (cases::ClipVertex& p : c.positions) p.y = -p.y;
  return c;
}

// The derivative is 8/(8 − u)². Pixel (0, 0) is covered completely; of pixel (3, 0) only samples 0
// and 2 are covered, and sample 0 lies at u = 27/8.
TEST(ScaledDerivatives, OfACentroidAreWhereItIs) {
  const Truth d3d(with_centroid(cases::Rules::d3d, 4));
  EXPECT_EQ(d3d->scaled_derivatives(0, 0, 0, 3)->exact.du.to_string(), "32/225");
  EXPECT_EQ(d3d->scaled_derivatives(0, 3, 0, 2)->exact.du.to_string(), "512/1369");
  EXPECT_FALSE(Truth(with_centroid(cases::Rules::vulkan, 4))->scaled_derivatives(0, 0, 0, 0));
  const Truth alone(with_centroid(cases::Rules::vulkan, 1));
  EXPECT_EQ(alone->scaled_derivatives(0, 0, 0, 0)->exact.du.to_string(), "32/225");
}

TEST(ScaledDerivatives, AreNotGivenWhereTheValueIsUndefined) {
  auto c = corner(-1, {{{0}, {1}, {0}}});
  c.attributes[0].location = cases::Location::center;
  EXPECT_FALSE(Truth(c)->scaled_derivatives(0, 2, 0, 0));
  EXPECT_FALSE(Truth(c)->judge_derivatives(0, 2, 0, 0, std::array{0.0F, 0.0F}, 1));
}

// The exact derivatives are 32/225 and 0; their units are ulp(2/5) = 2^-25 and ulp(8/15) = 2^-24.
TEST(JudgedDerivatives, AreDecidedExactly) {
  const Truth truth(corner(2, {{{0}, {1}, {0}}}));
  const auto judged = [&truth](float du, float dv, float bound) {
    return truth->judge_derivatives(0, 0, 0, 0, std::array{du, dv}, bound).value();
  };
  using records::FragmentClass;
  EXPECT_EQ(judged(0.14222223F, 0x1p-25F, 0.5F)[0].fragment_class, FragmentClass::correct);
  const auto half = judged(0x1p-3F, 0x1p-25F, 0.5F);
  EXPECT_EQ(half[0].fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(half[1].fragment_class, FragmentClass::correct);
  EXPECT_TRUE(records::contains(*half[1].error, 0.5));
  const auto less = judged(0x1p-3F, 0x1p-25F, 0x1.fffffep-2F);
  EXPECT_EQ(less[1].fragment_class, FragmentClass::beyond_bound);
  const auto none = judged(std::numeric_limits<float>::quiet_NaN(),
                           -std::numeric_limits<float>::infinity(), 0.5F);
  EXPECT_EQ(none[0].fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(none[1].fragment_class, FragmentClass::infinite);
  EXPECT_FALSE(none[1].error);
}

// The value grows from −3e38 to 3e38 within one pixel: its derivative is 6e38.
TEST(JudgedDerivatives, BeyondFloatHaveToBeInfinite) {
  auto c = corner(1, {{{-3e38F}, {3e38F}, {-3e38F}}});
  c.positions[1].x = -0.5F;
  const Truth truth(c);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto class_of = [&truth](float du) {
    return truth->judge_derivatives(0, 0, 0, 0, std::array{du, 0.0F}, 0.5F)->front().fragment_class;
  };
  EXPECT_EQ(class_of(kInfinity), records::FragmentClass::correct);
  EXPECT_EQ(class_of(-kInfinity), records::FragmentClass::infinite);
  EXPECT_EQ(class_of(0x1.fffffep127F), records::FragmentClass::beyond_bound);
}

Rational difference(const Truth& truth, int x, int y, WindowAxis axis) {
  return truth->quad_difference(0, axis, x, y, 0, 1).value().exact;
}

TEST(QuadDifference, IsTakenAcrossTheEvenAlignedQuad) {
  const Truth truth(corner(2, {{{0}, {1}, {0}}}));
  // r(3/2) − r(1/2) = 3/13 − 1/15 for both pixels of the quad.
  EXPECT_EQ(difference(truth, 0, 0, WindowAxis::x).to_string(), "32/195");
  EXPECT_EQ(difference(truth, 1, 0, WindowAxis::x).to_string(), "32/195");
  EXPECT_EQ(difference(truth, 1, 1, WindowAxis::y).to_string(), "0");
}

TEST(QuadDifference, ExtrapolatesToHelperPixels) {
  const Truth truth(corner(1, {{{0}, {1}, {2}}}));
  EXPECT_EQ(truth->judge(3, 1, 0).verdict, records::Verdict::forbidden);
  EXPECT_EQ(difference(truth, 2, 0, WindowAxis::x).to_string(), "1/4");
}

// r = u/(8 − u) is 5/11 in column 2 and 7/9 in column 3; 1/w is (8 − u)/8, and max|r_i| = 1.
TEST(QuadDifference, HasABoundByTheTwoValues) {
  const Truth truth(corner(2, {{{0}, {1}, {0}}}));
  const auto at = [&truth](int x, int y, WindowAxis axis) {
    return truth->quad_difference(0, axis, x, y, 0, 0.5F).value();
  };
  EXPECT_EQ(at(2, 0, WindowAxis::x).exact.to_string(), "32/99");
  EXPECT_EQ(at(3, 0, WindowAxis::x).exact, at(2, 0, WindowAxis::x).exact);
  EXPECT_EQ(at(2, 0, WindowAxis::y).exact, Rational(0));
  // M = M' = 1, and g is 11/9 as seen from column 2 and less than 1 as seen from column 3.
  EXPECT_EQ(at(2, 0, WindowAxis::x).allowed.to_string(), "10/9");
  EXPECT_EQ(at(3, 0, WindowAxis::x).allowed, Rational(1));
  EXPECT_FALSE(at(2, 0, WindowAxis::x).is_next_to_horizon);
}

TEST(QuadDifference, EndsAtTheHorizon) {
  const Truth behind(corner(-1, {{{0}, {1}, {0}}}));  // 1/w = 1 − u/2
  EXPECT_TRUE(behind->quad_difference(0, WindowAxis::x, 0, 0, 0, 1));
  EXPECT_FALSE(behind->quad_difference(0, WindowAxis::x, 2, 0, 0, 1));
  EXPECT_TRUE(behind->quad_difference(0, WindowAxis::y, 0, 0, 0, 1));
  // With a little more than 3/5, 1/w is about 1 − u · 2/3, which is only a little more than 0 at
  // column 1.
  const Truth next(corner(-0.6F, {{{0}, {1}, {0}}}));
  EXPECT_TRUE(next->quad_difference(0, WindowAxis::x, 0, 0, 0, 1).value().is_next_to_horizon);
  EXPECT_FALSE(next->quad_difference(0, WindowAxis::x, 1, 0, 0, 1).value().is_next_to_horizon);
}

TEST(QuadDifference, SaysNothingOfCentroidsOfSeveralSamples) {
  EXPECT_FALSE(
      Truth(with_centroid(cases::Rules::d3d, 4))->quad_difference(0, WindowAxis::x, 0, 0, 0, 1));
  EXPECT_TRUE(
      Truth(with_centroid(cases::Rules::vulkan, 1))->quad_difference(0, WindowAxis::x, 0, 0, 0, 1));
}

TEST(QuadDifference, OfAFlatAttributeIsZero) {
  auto c = corner(-1, {{{0}, {1}, {0}}});
  c.attributes[0].interpolation = cases::Interpolation::flat;
  const auto difference = Truth(c)->quad_difference(0, WindowAxis::x, 2, 0, 0, 1);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->exact, Rational(0));
  EXPECT_EQ(difference->allowed, Rational(0));
}

}  // namespace
}  // namespace rastercheck::oracle::derivatives_test
