#include "oracle/self_check.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::self_check_test {
namespace {

RC_GTEST_PROP(SelfCheck, FindsNothingToSayOfARightFragment, ()) {
  const cases::Case c = random_exact_case();
  const SceneTruth scene(c, cases::contract_of(c));
  std::optional<std::string> difference;
  for_each_fragment(scene, [&](const Fragment& f, const TriangleTruth&) {
    difference = self_check(scene, f);
    return !difference;
  });
  RC_ASSERT(!difference);
}

// Checks samples that are not covered, too.
RC_GTEST_PROP(SelfCheck, FindsNothingToSayOfAnySample, ()) {
  const cases::Case c = random_exact_case();
  const SceneTruth scene(c, cases::contract_of(c));
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) RC_ASSERT(!self_check(scene, 0, x, y, 0));
  }
}

/// The first fragment of a corner triangle with one attribute.
class SelfCheckOf : public testing::Test {
 protected:
  SelfCheckOf()
      : case_(small_case(cases::Rules::vulkan, 4, 4,
                         {{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}}}, {{{0}, {1}, {0}}})),
        scene_(case_, cases::contract_of(case_)) {
    for_each_fragment(scene_, [this](const Fragment& f, const TriangleTruth&) {
      first_ = f;
      return false;
    });
  }
  cases::Case case_;
  SceneTruth scene_;
  Fragment first_;
};

TEST_F(SelfCheckOf, AWrongDepthNamesIt) {
  first_.depth->lo = Rational(0.5);
  EXPECT_EQ(self_check(scene_, first_).value(),
            "oracle and referee differ at triangle 0, pixel (0, 0), sample 0: depth");
}

TEST_F(SelfCheckOf, AWrongAttributeNamesIt) {
  first_.attributes[0]->lo = Rational(0.5);
  EXPECT_EQ(self_check(scene_, first_).value(),
            "oracle and referee differ at triangle 0, pixel (0, 0), sample 0: attribute 0");
}

TEST_F(SelfCheckOf, AnUncoveredSampleReportsTheDifference) {
  first_.place.x = 3;
  first_.place.y = 3;
  EXPECT_EQ(self_check(scene_, first_).value(),
            "oracle and referee differ at triangle 0, pixel (3, 3), sample 0: covered or not");
}

}  // namespace
}  // namespace rastercheck::oracle::self_check_test
