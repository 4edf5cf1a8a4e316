// The numbers that may be drawn, against hand calculation and against the judge.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "oracle/judge.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/open_case.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::permitted_numbers_test {
namespace {

using records::FloatRange;
using records::FragmentClass;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// By hand: the attribute is 1/4 in the middle of the left border and 3/4 at the right corner, so
/// 1/2 at the middle pixel; its ULP is that of 3/4, 2^-24.
cases::Case half_in_the_middle() {
  return small_case(cases::Rules::vulkan, 9, 9, {{{-1, -1, 0, 1}, {1, 0, 0, 1}, {-1, 1, 0, 1}}},
                    {{{0.25F}, {0.75F}, {0.25F}}});
}

TEST(PermittedNumbers, ReachToTheBoundOnBothSides) {
  const cases::Case c = half_in_the_middle();
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth = {2.5F, 0};
  const SceneTruth scene(c, contract);
  // Above 1/2 floats are 2^-24 apart, below 2^-25.
  EXPECT_EQ(TriangleTruth(scene, 0).permitted_numbers(0, 4, 4, 0),
            (FloatRange{0.5F - 0x5p-25F, 0.5F + 0x2p-24F}));
}

TEST(PermittedNumbers, AreAllWhereNothingIsPromised) {
  const cases::Case c = half_in_the_middle();
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth = {0x1p24F, 0};
  const SceneTruth scene(c, contract);
  EXPECT_FALSE(TriangleTruth(scene, 0).permitted_numbers(0, 4, 4, 0));
}

TEST(PermittedNumbers, IncludeAnInfinityThatTheBoundReaches) {
  cases::Case c = half_in_the_middle();
  const float greatest = std::numeric_limits<float>::max();
  c.attribute_values = {greatest, greatest, greatest};
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth = {0.5F, 0};
  const SceneTruth almost(c, contract);
  EXPECT_EQ(TriangleTruth(almost, 0).permitted_numbers(0, 4, 4, 0)->greatest, greatest);
  contract.bounds.smooth = {1, 0};
  const SceneTruth scene(c, contract);
  EXPECT_EQ(TriangleTruth(scene, 0).permitted_numbers(0, 4, 4, 0)->greatest, kInfinity);
}

// The depth is 0 everywhere, its ULP that of the depth range's far end, 1.
TEST(PermittedNumbers, OfADepthLieOnTheSideThatTheContractNames) {
  const cases::Case c = half_in_the_middle();
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.depth = {1, 0};
  contract.depth_error = cases::DepthError::never_nearer;
  const SceneTruth scene(c, contract);
  EXPECT_EQ(TriangleTruth(scene, 0).permitted_numbers(std::nullopt, 4, 4, 0),
            (FloatRange{0, 0x1p-23F}));
  contract.bounds.depth = {0x1p24F, 0};
  contract.depth_error = cases::DepthError::never_farther;
  const SceneTruth unbounded(c, contract);
  EXPECT_EQ(TriangleTruth(unbounded, 0).permitted_numbers(std::nullopt, 4, 4, 0),
            (FloatRange{-kInfinity, 0}));
}

std::optional<FloatRange> permitted(const TriangleTruth& truth, const cases::Fragments& drawn,
                                    std::size_t fragment, std::optional<std::size_t> attribute) {
  return truth.permitted_numbers(attribute, drawn.x[fragment], drawn.y[fragment],
                                 drawn.sample[fragment]);
}

/// The drawing with each value replaced: by what `choose` takes from its permitted numbers, or, if
/// it has none to choose from, by a number that is far off almost everywhere.
template <typename Choose>
cases::Fragments replaced(const TriangleTruth& truth, const cases::Fragments& drawn,
                          const Choose& choose) {
  const auto other = [&](const std::optional<FloatRange>& range) {
    return range ? choose(*range) : std::numeric_limits<float>::lowest();
  };
  cases::Fragments changed = drawn;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    changed.depth[i] = other(permitted(truth, drawn, i, std::nullopt));
    for (std::size_t a = 0; a < drawn.attribute_count; ++a) {
      changed.attributes[i * drawn.attribute_count + a] = other(permitted(truth, drawn, i, a));
    }
  }
  return changed;
}

/// Judges a drawing of values that are all right, or, if they have permitted numbers, all wrong.
void expect_all(bool is_right, const SceneTruth& scene, const cases::Fragments& drawn) {
  judge(scene, drawn, {}, [&](const JudgedSample& sample, const TriangleTruth* truth) {
    for (const JudgedValue& value : sample.values) {
      const auto range = truth->permitted_numbers(value.attribute, static_cast<int>(sample.place.x),
                                                  static_cast<int>(sample.place.y),
                                                  static_cast<int>(sample.place.sample));
      if (range && std::isnan(value.actual)) continue;
      const bool counts_as_right = value.fragment_class == FragmentClass::correct ||
                                   value.fragment_class == FragmentClass::wrong_sign_of_zero;
      // Without permitted numbers, any is right, or the value is not judged at all.
      RC_ASSERT(counts_as_right == (is_right || !range));
    }
  });
}

/// Holds both ends, and the numbers next to them, against the judge. NaN stands for a number that
/// does not exist.
void expect_ends_of_judge(const cases::Case& c, const cases::Contract& contract) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  const cases::Fragments drawn = perfect(scene);
  const auto unless_empty = [&](const FloatRange& range, float end) {
    return range.least <= range.greatest ? end : nan;
  };
  expect_all(true, scene, replaced(truth, drawn, [&](const FloatRange& range) {
               return unless_empty(range, range.least);
             }));
  expect_all(true, scene, replaced(truth, drawn, [&](const FloatRange& range) {
               return unless_empty(range, range.greatest);
             }));
  expect_all(false, scene, replaced(truth, drawn, [&](const FloatRange& range) {
               return range.least > -kInfinity ? std::nextafter(range.least, -kInfinity) : nan;
             }));
  expect_all(false, scene, replaced(truth, drawn, [&](const FloatRange& range) {
               return range.greatest < kInfinity ? std::nextafter(range.greatest, kInfinity) : nan;
             }));
}

// Kills: an end that is one float off; a value of a kind or location without permitted numbers.
RC_GTEST_PROP(PermittedNumbers, AreThoseThatTheJudgeTakesForRight, ()) {
  const cases::Case c = open_case();
  cases::Contract contract = open_contract(c);
  contract.depth_error = one_of({cases::DepthError::either_side, cases::DepthError::never_nearer,
                                 cases::DepthError::never_farther});
  expect_ends_of_judge(c, contract);
}

RC_GTEST_PROP(PermittedNumbers, AreThoseThatTheJudgeTakesForRightIfNothingIsOpen, ()) {
  const cases::Case c = random_exact_case();
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth = one_of<cases::ValueBound>({{0, 0}, {0.5F, 0}, {8, 0}, {0.5F, 0.25F}});
  expect_ends_of_judge(c, contract);
}

}  // namespace
}  // namespace rastercheck::oracle::permitted_numbers_test
