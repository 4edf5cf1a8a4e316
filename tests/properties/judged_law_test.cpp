#include "properties/judged_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::judged_law_test {
namespace {

TEST(ValueText, IsDecimalAndHex) {
  EXPECT_EQ(value_text(0.5F), "0.5 (0x1p-1)");
  EXPECT_EQ(value_text(-0.0F), "-0 (-0x0p+0)");
  EXPECT_EQ(value_text(std::numeric_limits<float>::infinity()), "inf");
  EXPECT_EQ(value_text(-std::numeric_limits<float>::infinity()), "-inf");
  EXPECT_EQ(value_text(-std::numeric_limits<float>::quiet_NaN()), "nan");
}

TEST(Note, CountsAllAndKeepsTheFirst) {
  Check check;
  for (std::uint32_t i = 0; i < 20; ++i) {
    records::Violation violation;
    violation.place.x = i;
    add_judged_violation(check, violation);
  }
  EXPECT_EQ(check.violation_count, 20U);
  ASSERT_EQ(check.violations.size(), records::kMostViolations);
  EXPECT_EQ(check.violations.back().place.x, records::kMostViolations - 1);
}

// Kills: a new defect that is not kept because of eight known violations.
TEST(Note, KeepsTheFirstOfEachSort) {
  Check check;
  const auto note_of = [&check](records::AttributeKind kind, std::uint32_t x) {
    records::Violation violation;
    violation.kind = kind;
    violation.place.x = x;
    add_judged_violation(check, violation);
  };
  for (std::uint32_t x = 0; x < 20; ++x) note_of(records::AttributeKind::depth, x);
  note_of(records::AttributeKind::smooth, 20);
  note_of(records::AttributeKind::smooth, 21);
  note_of(records::AttributeKind::flat, 22);
  std::vector<std::uint32_t> kept;
  for (const records::Violation& violation : check.violations) kept.push_back(violation.place.x);
  EXPECT_THAT(kept, testing::ElementsAre(0, 1, 2, 3, 4, 5, 20, 22));
  EXPECT_EQ(check.violation_count, 23U);
}

TEST(Merge, AddsCountsViolationsAndLabels) {
  Check a;
  a.labels = {"drawn", "tie"};
  a.judgement.counts.required = 3;
  a.judgement.errors[records::AttributeKind::depth].classes[records::FragmentClass::correct] = 3;
  for (int i = 0; i < 5; ++i) add_judged_violation(a, {});
  Check b = a;
  b.labels = {"clipped", "drawn"};
  b.fault = "a fault";
  merge(a, b);
  EXPECT_EQ(a.violation_count, 10U);
  EXPECT_EQ(a.violations.size(), records::kMostViolations);
  EXPECT_EQ(a.judgement.counts.required, 6U);
  EXPECT_EQ(
      a.judgement.errors[records::AttributeKind::depth].classes[records::FragmentClass::correct],
      6U);
  EXPECT_THAT(a.labels, testing::ElementsAre("clipped", "drawn", "tie"));
  EXPECT_EQ(a.fault, "a fault");
}

TEST(JudgeDrawn, SaysWhatIsExactlyTrueAndWhatWasDrawn) {
  DamagedBackend backend;
  const cases::Case c = square();
  cases::Fragments drawn = draw(c, backend).value().fragments;
  drop(drawn, 0, 1, 1);
  value(drawn, 0, 2, 3, 1) = 1.5F;
  const Check check = judge_drawn(c, backend.contract(c), drawn, {}, {});
  ASSERT_EQ(check.violation_count, 2U);
  const records::Violation& missing = check.violations[0];
  EXPECT_EQ(missing.fragment_class, records::FragmentClass::missing);
  EXPECT_EQ(missing.kind, records::AttributeKind::coverage);
  EXPECT_EQ(missing.exact, "required: inside");
  EXPECT_EQ(missing.actual, "not drawn");
  ASSERT_TRUE(missing.distance.has_value());
  EXPECT_NEAR(missing.distance->lo, 1.5, 1e-3);  // to the left edge, except for snapping

  const records::Violation& beyond = check.violations[1];
  EXPECT_EQ(beyond.fragment_class, records::FragmentClass::beyond_bound);
  EXPECT_EQ(beyond.kind, records::AttributeKind::smooth);
  EXPECT_EQ(beyond.attribute, 1U);
  EXPECT_EQ(beyond.exact, "1");
  EXPECT_EQ(beyond.actual, "1.5 (0x1.8p+0)");
  ASSERT_TRUE(beyond.error.has_value());
  EXPECT_NEAR(beyond.error->lo, 0x1p22, 1);  // one half, in ulps of 1
  EXPECT_TRUE(beyond.bound.has_value());
  EXPECT_EQ(check.judgement.counts.required, 56U);  // the diagonal's 8 are permitted twice
  EXPECT_EQ(check.judgement.counts.permitted, 16U);
}

TEST(JudgeDrawn, LabelsWhatWasReached) {
  cases::Case c = square();
  c.framebuffer.samples = 4;
  c.depth_test = cases::DepthTest::less;
  c.attributes[0].location = cases::Location::center;
  c.positions[0] = {-1.5F, -1, 0.25F, -0.5F};  // behind the eye
  c.positions[3].z = 1.5F;                     // beyond the far plane
  DamagedBackend backend;
  const cases::Fragments drawn = draw(c, backend).value().fragments;
  const Check check = judge_drawn(c, backend.contract(c), drawn, {}, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels,
              testing::IsSupersetOf({"clipped", "depth test", "drawn", "extrapolated centre",
                                     "several samples", "w <= 0"}));

  const Check plain = judge_drawn(square(), backend.contract(square()),
                                  draw(square(), backend).value().fragments, {}, {});
  EXPECT_THAT(plain.labels, testing::ElementsAre("drawn", "permitted", "snapping"));
}

}  // namespace
}  // namespace rastercheck::properties::judged_law_test
