#include "oracle/judge.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "records/record.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::judge_test {
namespace {

using records::AttributeKind;
using records::FragmentClass;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The corner triangle of a 4×4 target: it covers the pixels with x + y < 3, and the diagonal's
/// samples are ties. u runs from 0 at the left border to 4 at the right; v is a constant.
class JudgeOf : public testing::Test {
 protected:
  JudgeOf()
      : case_(small_case(cases::Rules::vulkan, 4, 4,
                         {{{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}}},
                         {{{0, 0}, {4, 0}, {0, 0}}})),
        scene_(case_, cases::contract_of(case_)),
        drawn_(perfect(scene_)) {}

  records::Judgement judged() const { return judge(scene_, drawn_).judgement; }
  std::uint64_t count(AttributeKind kind, FragmentClass fragment_class) const {
    const records::Judgement judgement = judged();
    const auto found = judgement.errors.find(kind);
    return found == judgement.errors.end() ? 0 : found->second.classes[fragment_class];
  }

  cases::Case case_;
  SceneTruth scene_;
  cases::Fragments drawn_;
};

TEST_F(JudgeOf, AFaultlessDrawingIsCorrectThroughout) {
  const records::Judgement judgement = judged();
  EXPECT_EQ(judgement.counts, (records::Counts{6, 10, 0, 0}));
  for (const auto& [kind, errors] : judgement.errors) {
    const std::uint64_t each = kind == AttributeKind::smooth ? 12 : 6;
    EXPECT_EQ(errors.classes[FragmentClass::correct], each) << to_string(kind);
    EXPECT_EQ(errors.excess.extremes, records::Extremes()) << to_string(kind);
  }
}

TEST_F(JudgeOf, WhatIsNotDrawnIsMissing) {
  drawn_ = {};
  EXPECT_EQ(count(AttributeKind::coverage, FragmentClass::missing), 6U);
}

TEST_F(JudgeOf, WhatIsForbiddenOrUnheardOfIsExtra) {
  push(drawn_, 0, 3, 3, 0, 0, {0, 0});
  EXPECT_EQ(count(AttributeKind::coverage, FragmentClass::extra), 1U);
  push(drawn_, 0, 0, 0, 0, 0, {0, 0});  // a second time
  push(drawn_, 0, 0, 0, 1, 0, {0, 0});  // no such sample
  push(drawn_, 0, 900, 0, 0, 0, {0, 0});
  push(drawn_, 7, 0, 0, 0, 0, {0, 0});
  EXPECT_EQ(count(AttributeKind::coverage, FragmentClass::extra), 5U);
  EXPECT_EQ(count(AttributeKind::coverage, FragmentClass::correct), 6U);
}

TEST_F(JudgeOf, TheOrderOfFragmentsDoesNotMatter) {
  cases::Fragments reversed;
  for (std::size_t i = drawn_.size(); i-- > 0;) {
    const auto values = drawn_.attributes_of(i);
    push(reversed, drawn_.triangle[i], drawn_.x[i], drawn_.y[i], drawn_.sample[i], drawn_.depth[i],
         {values.begin(), values.end()});
  }
  const records::Judgement in_order = judged();
  drawn_ = reversed;
  EXPECT_EQ(judged(), in_order);
}

// By hand: u is 1/2 at the first pixel and up to 4 at its vertices, so a scale ULP is 2^-21. One
// step of 1/2 is 2^-24, 1/8 of a scale ULP; four steps are 1/2, the bound; five are beyond.
TEST_F(JudgeOf, ErrorsAreInScaleUlpAndHeldAgainstTheBound) {
  drawn_.attributes[0] = 0.5F + 4 * 0x1p-24F;
  EXPECT_EQ(count(AttributeKind::smooth, FragmentClass::beyond_bound), 0U);
  drawn_.attributes[0] = 0.5F + 5 * 0x1p-24F;
  EXPECT_EQ(count(AttributeKind::smooth, FragmentClass::beyond_bound), 1U);
  const auto worst = judged().errors.at(AttributeKind::smooth).excess.extremes.most_positive;
  EXPECT_EQ(worst->error, (records::Enclosure{0.625, 0.625}));
  EXPECT_EQ(worst->exact, "1/2");
  EXPECT_EQ(worst->attribute, 0U);
  EXPECT_EQ(judged().errors.at(AttributeKind::smooth).ideal.extremes.most_positive, worst);
}

// By hand: snapping moves the left side from 33/64 to 1/2, and r at u = 3/2 from 63/479 to 2/15,
// some 15,000 ULP of 1. The drawn value is 2/15, which is right only for some bases.
TEST(Judge, MeasuresPrecisionAgainstTheTriangleThatTheBasisNames) {
  const auto worst = [](cases::Basis basis) {
    const float left = 33.0F / 64 / 2 - 1;
    cases::Case c =
        small_case(cases::Rules::vulkan, 4, 4, {{{left, -1, 0, 1}, {3, -1, 0, 1}, {left, 3, 0, 1}}},
                   {{{0}, {1}, {0}}});
    c.coverage = cases::Snapping{4, cases::Rounding::nearest_even, 0};
    c.basis = basis;
    const SceneTruth scene(c, cases::contract_of(c));
    cases::Fragments drawn;
    push(drawn, 0, 1, 0, 0, 0, {2.0F / 15});
    const records::Judgement judgement = judge(scene, drawn).judgement;
    const records::Extremes& ideal = judgement.errors.at(AttributeKind::smooth).ideal.extremes;
    double most = 0;
    for (const auto& extreme : {ideal.most_positive, ideal.most_negative}) {
      if (extreme) most = std::max(most, records::magnitude_bound(extreme->error));
    }
    return most;
  };
  EXPECT_LT(worst(cases::Basis::snapped), 0.5);
  EXPECT_GT(worst(cases::Basis::ideal), 10'000);
  EXPECT_GT(worst(cases::Basis::unspecified), 10'000);
}

TEST_F(JudgeOf, WhatIsNoNumberIsAClass) {
  drawn_.attributes[0] = kNan;
  drawn_.attributes[2] = -kInfinity;
  drawn_.depth[0] = kNan;
  EXPECT_EQ(count(AttributeKind::smooth, FragmentClass::not_a_number), 1U);
  EXPECT_EQ(count(AttributeKind::smooth, FragmentClass::infinite), 1U);
  EXPECT_EQ(count(AttributeKind::depth, FragmentClass::not_a_number), 1U);
  EXPECT_EQ(judged().errors.at(AttributeKind::smooth).excess.histogram.count(), 10U);
}

TEST_F(JudgeOf, TheOtherZeroIsWrongWhereAllVerticesHaveTheSame) {
  drawn_.attributes[1] = -0.0F;
  EXPECT_EQ(count(AttributeKind::smooth, FragmentClass::wrong_sign_of_zero), 1U);
}

/// The classes of the values of one drawn fragment; its vertices all have the attribute 0.
class JudgeUnder : public testing::Test {
 protected:
  records::ClassCounts classes_of(const cases::Contract& contract, cases::Interpolation declared,
                                  float value) {
    cases::Case c = small_case(cases::Rules::vulkan, 1, 1,
                               {{{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}}}, {{{0}, {0}, {0}}});
    c.attributes[0].interpolation = declared;
    cases::Fragments drawn;
    push(drawn, 0, 0, 0, 0, 0, {value});
    const SceneTruth scene(c, contract);
    records::Judgement judgement = judge(scene, drawn).judgement;
    return judgement.errors[records::kind_of(declared)].classes;
  }
};

// Kills: requiring the sign of a zero although the contract does not promise it; not requiring the
// sign of copied values.
TEST_F(JudgeUnder, AContractWithoutSignsOfZeroAcceptsEitherZero) {
  cases::Contract contract;
  contract.keeps_sign_of_zero = false;
  EXPECT_EQ(classes_of(contract, cases::Interpolation::smooth, -0.0F)[FragmentClass::correct], 1U);
  EXPECT_EQ(
      classes_of(contract, cases::Interpolation::flat, -0.0F)[FragmentClass::wrong_sign_of_zero],
      1U);
}

// Kills: requiring a number although the contract promises nothing about the value.
TEST_F(JudgeUnder, AContractWithoutABoundAcceptsNaN) {
  cases::Contract contract;
  const auto nan_of = [&] {
    return classes_of(contract, cases::Interpolation::smooth, kNan)[FragmentClass::not_a_number];
  };
  contract.bounds.smooth.constant = 0x1.fffffep23F;
  EXPECT_EQ(nan_of(), 1U);
  contract.bounds.smooth.constant = 0x1p24F;
  EXPECT_EQ(nan_of(), 0U);
}

TEST_F(JudgeOf, CoverageAloneAsksForNoValues) {
  drawn_.attributes[0] = kNan;
  const records::Judgement judgement = judge(scene_, drawn_, {.judges_values = false}).judgement;
  EXPECT_EQ(judgement.errors.size(), 1U);
}

TEST_F(JudgeOf, TheSinkSeesEveryDrawnOrMissingSample) {
  drawn_ = {};
  push(drawn_, 0, 3, 3, 0, 0.5F, {0, 0});
  push(drawn_, 9, 0, 0, 0, 0.5F, {0, 0});
  std::string seen;
  judge(scene_, drawn_, {}, [&seen](const JudgedSample& s, const TriangleTruth* truth) {
    seen += std::to_string(s.place.triangle) + ":" + std::to_string(s.place.x) +
            std::to_string(s.place.y) + (truth == nullptr ? "? " : " ") +
            std::string(to_string(s.fragment_class)) + "; ";
  });
  EXPECT_EQ(seen,
            "0:00 missing; 0:10 missing; 0:20 missing; 0:01 missing; 0:11 missing; 0:02 missing; "
            "0:33 extra; 9:00? extra; ");
}

// Under an unspecified tie rule the diagonal's samples may be drawn or not.
TEST_F(JudgeOf, PermittedSamplesAreRightEitherWay) {
  cases::Contract contract = cases::contract_of(case_);
  contract.tie_rule = cases::TieRule::unspecified;
  const SceneTruth scene(case_, contract);
  const records::Judgement without = judge(scene, drawn_).judgement;
  EXPECT_EQ(without.counts, (records::Counts{6, 6, 4, 0}));
  push(drawn_, 0, 3, 0, 0, 0.5F, {3.5F, 0});
  const records::Judgement with = judge(scene, drawn_).judgement;
  const records::ClassCounts& classes = with.errors.at(AttributeKind::coverage).classes;
  EXPECT_EQ(classes[FragmentClass::correct], 7U);
  EXPECT_EQ(classes[FragmentClass::extra], 0U);
}

// 1/w is 1 at the left border and 2^-30 at the right border. A bound that grows towards the right
// allows errors there that it does not allow at the left.
TEST(JudgedBounds, GrowTowardsTheHorizon) {
  const cases::Case c = small_case(
      cases::Rules::vulkan, 4, 4,
      {{{-1, -1, 0, 1}, {0x1p30F, -0x1p30F, 0, 0x1p30F}, {-1, 3, 0, 1}}}, {{{1}, {1}, {1}}});
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth = {0.5F, 0.25F};
  const SceneTruth scene(c, contract);
  cases::Fragments drawn = perfect(scene);
  // By hand: 1/w is 7/8, 5/8, 3/8, 1/8 in the four columns, so the bound for an error of 1 ULP is
  // about 0.79, 0.9, 1.17 and 2.5.
  for (float& value : drawn.attributes) value = std::nextafter(value, 2.0F);
  std::string beyond;
  judge(scene, drawn, {}, [&beyond](const JudgedSample& s, const TriangleTruth*) {
    if (s.values[1].fragment_class == FragmentClass::beyond_bound)
      beyond += std::to_string(s.place.x);
  });
  EXPECT_EQ(beyond, "01010101");
}

/// Layers over a 1×1 target, at the given depths.
cases::Case layers(const std::vector<float>& depths) {
  cases::Case c = small_case(cases::Rules::vulkan, 1, 1, {});
  c.positions.clear();
  c.triangles.clear();
  for (const float z : depths) {
    const auto first = static_cast<std::uint32_t>(c.positions.size());
    c.positions.insert(c.positions.end(), {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}});
    c.triangles.push_back({first, first + 1, first + 2});
  }
  c.depth_test = cases::DepthTest::less;
  return c;
}

/// Draws on the layers and returns the classes of the samples, in words.
std::string judge_layers(const std::vector<float>& depths, const cases::Fragments& drawn) {
  const SceneTruth scene(layers(depths), cases::contract_of(layers(depths)));
  std::string classes;
  judge(scene, drawn, {}, [&classes](const JudgedSample& s, const TriangleTruth*) {
    classes += std::string(to_string(s.fragment_class)) + ";";
  });
  return classes;
}

cases::Fragments one_fragment(std::uint32_t triangle, float depth) {
  cases::Fragments drawn;
  push(drawn, triangle, 0, 0, 0, depth, {});
  return drawn;
}

TEST(JudgedNearest, TheNearestIsCorrectAndAnotherTheWrongTriangle) {
  EXPECT_EQ(judge_layers({0.5F, 0.25F}, one_fragment(1, 0.25F)), "correct;");
  EXPECT_EQ(judge_layers({0.5F, 0.25F}, one_fragment(0, 0.5F)), "wrong triangle;");
  EXPECT_EQ(judge_layers({0.5F, 0.25F}, {}), "missing;");
  cases::Fragments both = one_fragment(1, 0.25F);
  push(both, 0, 0, 0, 0, 0.5F, {});
  EXPECT_EQ(judge_layers({0.5F, 0.25F}, both), "wrong triangle;extra;");
}

// Two depths less than an ULP apart may round to the same float: either layer may be drawn.
TEST(JudgedNearest, DepthsThatRoundingMayExchangeAreOpen) {
  const float near = 0.5F;
  const float far = std::nextafter(near, 1.0F);
  EXPECT_EQ(judge_layers({far, near}, one_fragment(0, far)), "correct;");
  EXPECT_EQ(judge_layers({far, near}, one_fragment(1, near)), "correct;");
  EXPECT_EQ(judge_layers({0.5F, 0.5F + 0x1p-22F}, one_fragment(1, 0.5F + 0x1p-22F)),
            "wrong triangle;");
}

// Only the second sample of the pixel is covered; the pixel's centre lies outside the triangle,
// where a noperspective value exceeds the largest float32.
TEST(JudgedInfinity, IsRightWhereTheExactValueIsBeyondFloat) {
  cases::Case c = small_case(cases::Rules::vulkan, 1, 1,
                             {{{-1, 0.25F, 0, 1}, {-1, -1, 0, 1}, {0.25F, -1, 0, 1}}},
                             {{{3e38F}, {-3e38F}, {3e38F}}});
  c.framebuffer.samples = 2;
  c.attributes[0] = {"a", cases::Interpolation::noperspective, cases::Location::center};
  const SceneTruth scene(c, cases::contract_of(c));
  cases::Fragments drawn;
  for (const float value : {kInfinity, -kInfinity, 3.4e38F}) {
    drawn = {};
    push(drawn, 0, 0, 0, 1, 0, {value});
    const auto judgement = judge(scene, drawn).judgement;
    const auto& classes = judgement.errors.at(AttributeKind::noperspective).classes;
    EXPECT_EQ(classes[FragmentClass::correct], value == kInfinity ? 1U : 0U) << value;
    EXPECT_EQ(classes[FragmentClass::infinite], value == -kInfinity ? 1U : 0U) << value;
    EXPECT_EQ(classes[FragmentClass::beyond_bound], value == 3.4e38F ? 1U : 0U) << value;
  }
}

// Kills: any disagreement between the judge and for_each_fragment(); a sample that is not counted
// exactly once.
RC_GTEST_PROP(Judged, AFaultlessDrawingIsCorrect, ()) {
  const cases::Case c = random_exact_case();
  const SceneTruth scene(c, cases::contract_of(c));
  const JudgedDrawing judged = judge(scene, perfect(scene), {.self_check_one_in = 1});
  RC_ASSERT(!judged.fault);
  for (const auto& [kind, errors] : judged.judgement.errors) {
    for (std::size_t i = 1; i < errors.classes.counts.size(); ++i) {
      RC_ASSERT(errors.classes.counts[i] == 0U);
    }
  }
  const records::Counts& counts = judged.judgement.counts;
  RC_ASSERT(counts.required + counts.permitted + counts.forbidden ==
            static_cast<std::uint64_t>(30 * c.framebuffer.samples));
  RC_ASSERT(counts.undecided == 0U);
}

// Kills: a thread that waits forever for the turn of a chunk that has failed.
TEST(JudgeInThreads, PassesOnWhatASinkThrows) {
  struct Stop {};
  for (const cases::DepthTest test : {cases::DepthTest::none, cases::DepthTest::less}) {
    cases::Case c = small_case(cases::Rules::vulkan, 4, 64,
                               {{{-1, -1, 0.5F, 1}, {3, -1, 0.5F, 1}, {-1, 3, 0.5F, 1}}}, {});
    c.triangles.resize(600, c.triangles[0]);
    c.depth_test = test;
    const SceneTruth scene(c, cases::contract_of(c));
    JudgeOptions options;
    options.jobs = 3;
    int seen = 0;
    const auto stop = [&seen](const JudgedSample&, const TriangleTruth*) {
      if (++seen == 100) throw Stop{};
    };
    EXPECT_THROW(judge(scene, perfect(scene), options, stop), Stop);
    EXPECT_EQ(seen, 100);
  }
}

// By hand: w = 1 at u = 0 and w = 2 at u = 4, where the attribute is 0 and 1. A value linear in the
// window is u/4, which is claimed; in perspective the value is u/(8 − u). At u = 1/2 these are 1/8
// and 1/15.
TEST(JudgeOfAClaim, HoldsValuesAgainstItAndTellsTheErrorOfPerspective) {
  const cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {2, -2, 0, 2}, {-1, 1, 0, 1}}},
                 {{{0}, {1}, {0}}});
  cases::Contract contract = cases::contract_of(c);
  contract.claims = cases::Claim::affine;
  contract.bounds.smooth = {0};
  const SceneTruth scene(c, contract);
  cases::Fragments drawn;
  push(drawn, 0, 0, 0, 0, 0, {0.125F});
  JudgeOptions options;
  options.self_check_one_in = 1;
  std::optional<JudgedValue> judged;
  const JudgedDrawing result =
      judge(scene, drawn, options, [&](const JudgedSample& sample, const TriangleTruth*) {
        for (const JudgedValue& value : sample.values) {
          if (value.attribute) judged = value;
        }
      });
  EXPECT_FALSE(result.fault) << *result.fault;
  ASSERT_TRUE(judged);
  EXPECT_EQ(judged->fragment_class, FragmentClass::correct);
  EXPECT_EQ(judged->excess, (records::Enclosure{0, 0}));
  const double error = (7 / 120.0) * 0x1p23;  // (1/8 − 1/15) in ulp(1)
  EXPECT_NEAR(judged->ideal->lo, error, 1e-6);
  EXPECT_NEAR(judged->ideal->hi, error, 1e-6);

  contract.claims = cases::Claim::perspective;
  const SceneTruth perspective(c, contract);
  EXPECT_EQ(judge(perspective, drawn)
                .judgement.errors[AttributeKind::smooth]
                .classes[FragmentClass::beyond_bound],
            1U);
}

// Vertices with w <= 0 have no window position, so that no value is linear between them.
TEST(JudgeOfAClaim, LeavesAffineValuesFreeWhereSomeWIsNotPositive) {
  const cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {2, -2, 0, -2}, {-1, 1, 0, 1}}},
                 {{{0}, {1}, {0}}});
  cases::Contract contract = cases::contract_of(c);
  EXPECT_FALSE(TriangleTruth(SceneTruth(c, contract), 0).is_value_free(0));
  contract.claims = cases::Claim::affine;
  EXPECT_TRUE(TriangleTruth(SceneTruth(c, contract), 0).is_value_free(0));
}

}  // namespace
}  // namespace rastercheck::oracle::judge_test
