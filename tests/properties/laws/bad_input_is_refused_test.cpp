// The law catches bad input that is accepted, and a target that was written although the input was
// refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::bad_input_is_refused_test {
namespace {

using cases::Case;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "bad-input-is-refused-and-the-target-untouched";

/// A square whose numbers make the law choose another fault for each `i`.
Case numbered(int i) {
  Case c = square();
  c.attribute_values[0] = static_cast<float>(i) / 64;
  return c;
}

TEST(BadInput, IsRefusedInEveryWay) {
  DamagedBackend backend({}, "cpu");
  std::set<std::string> labels;
  for (int i = 0; i < 64; ++i) {
    const Check check = check_of(kLaw, numbered(i), backend);
    EXPECT_TRUE(check.is_applicable);
    EXPECT_EQ(check.violation_count, 0U) << i;
    EXPECT_EQ(check.judgement.counts.required, 3U);
    labels.insert(check.labels.begin(), check.labels.end());
  }
  EXPECT_THAT(labels, testing::ElementsAre("empty", "mesh", "state", "target"));
}

TEST(BadInput, IsNotTaken) {
  DamagedBackend backend({}, "cpu");
  backend.over_damage = [](const Case&, Result<void>& drawn, cases::Picture&) { drawn = {}; };
  int found = 0;
  for (int i = 0; i < 64; ++i) {
    const Check check = check_of(kLaw, numbered(i), backend);
    const bool may_draw_nothing = check.labels.front() == "empty";
    ASSERT_EQ(check.violation_count, may_draw_nothing ? 0U : 1U);
    if (may_draw_nothing) continue;
    ++found;
    const records::Violation& violation = check.violations.front();
    EXPECT_EQ(violation.fragment_class, FragmentClass::extra);
    EXPECT_THAT(violation.exact, HasSubstr("refused: "));
    EXPECT_EQ(violation.actual, "not refused");
    EXPECT_EQ(violation.note, "drawn over a picture");
  }
  EXPECT_GT(found, 32);
}

TEST(BadInput, LeavesTheTargetAlone) {
  DamagedBackend backend({}, "cpu");
  backend.over_damage = [](const Case&, Result<void>&, cases::Picture& picture) {
    picture.color[3 * (8 * 2 + 5) + 1] += 1;
  };
  const Check check = check_of(kLaw, square(), backend);
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.place.x, 5U);
  EXPECT_EQ(violation.place.y, 2U);
  EXPECT_EQ(violation.attribute, 1U);
  EXPECT_THAT(violation.note, HasSubstr("the target was written to by a case with "));
  backend.over_damage = [](const Case&, Result<void>&, cases::Picture& picture) {
    picture.depth.pop_back();
  };
  EXPECT_EQ(check_of(kLaw, square(), backend).violations.front().actual,
            "a target of another size");
}

TEST(BadInput, IsNotJudgedOfBackendsThatDoNotDrawOver) {
  DamagedBackend backend;
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  EXPECT_FALSE(check_of(kLaw, square(), backend).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::bad_input_is_refused_test
