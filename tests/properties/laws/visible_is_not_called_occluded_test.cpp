// The law catches a culler that calls something visible occluded, and accepts every answer where
// the contract leaves it open.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::visible_is_not_called_occluded_test {
namespace {

using cases::Case;
using records::FragmentClass;
using testing::Contains;
using testing::Not;

constexpr std::string_view kLaw = "what-is-visible-is-not-called-occluded";

/// Triangle A of the square, at `depth` and over 28 pixels, before the same triangle at 1/2.
Case before_half(float depth) {
  Case c = square();
  c.positions.clear();
  for (const float one : {depth, 0.5F}) {
    c.positions.insert(c.positions.end(), {{-1, -1, one, 1}, {1, -1, one, 1}, {-1, 1, one, 1}});
  }
  c.attribute_values.assign(c.positions.size() * 3, 0);
  c.triangles = {{0, 1, 2}, {3, 4, 5}};
  return c;
}

OcclusionDamage answering(bool is_occluded) {
  return [is_occluded](const Case&, std::size_t, bool& answer) { answer = is_occluded; };
}

Check check_with(const Case& c, const OcclusionDamage& damage) {
  DamagedBackend backend({}, "cpu");
  backend.occlusion_damage = damage;
  return check_of(kLaw, c, backend);
}

TEST(VisibleIsNotCalledOccluded, HoldsOfRightAnswers) {
  const Check visible = check_with(before_half(0.75F), {});
  EXPECT_TRUE(visible.is_applicable);
  EXPECT_EQ(visible.violation_count, 0U);
  EXPECT_EQ(visible.judgement.counts, (records::Counts{28, 0, 0, 0}));
  EXPECT_THAT(visible.labels, testing::ElementsAre("depth test", "occluders", "visible"));
  const Check hidden = check_with(before_half(0.25F), {});
  EXPECT_EQ(hidden.violation_count, 0U);
  EXPECT_EQ(hidden.judgement.counts, (records::Counts{0, 28, 0, 0}));
  EXPECT_THAT(hidden.labels, testing::ElementsAre("depth test", "hidden", "occluders"));
}

TEST(VisibleIsNotCalledOccluded, CatchesTheContrary) {
  const Check check = check_with(before_half(0.75F), answering(true));
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::missing);
  EXPECT_EQ(violation.place, (cases::SamplePlace{1, 0, 0, 0}));
  EXPECT_EQ(violation.actual, "called occluded");
  // cpu's bound for depths is 0.51 ULP of 1.
  EXPECT_EQ(violation.exact,
            "required: its depth is at most 0.5000000607967365, that of occluders at least "
            "0.7499999392032635");
  EXPECT_EQ(violation.note,
            "triangle 0 is "
            "the nearest occluder there");
}

TEST(VisibleIsNotCalledOccluded, CatchesItOfATriangleWithoutOccluders) {
  Case c = before_half(0.75F);
  c.triangles.erase(c.triangles.begin());
  EXPECT_EQ(check_with(c, {}).violation_count, 0U);
  const Check check = check_with(c, answering(true));
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().note, "no occluder is nearer there than the cleared depth");
}

// Kills: a violation where only one of several samples is visible that is overlooked.
TEST(VisibleIsNotCalledOccluded, CatchesItOfASingleVisibleSample) {
  Case c = before_half(0.25F);
  // The occluder's edge moves inwards over the centre of pixel (6, 0) alone.
  c.positions[1].x = 0.7F;
  EXPECT_EQ(check_with(c, {}).violation_count, 0U);
  const Check check = check_with(c, answering(true));
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.judgement.counts.required, 1U);
  EXPECT_EQ(check.violations.front().place, (cases::SamplePlace{1, 0, 6, 0}));
  EXPECT_THAT(check.labels, Contains("narrow gap"));
}

TEST(VisibleIsNotCalledOccluded, AcceptsAndCountsConservativeAnswers) {
  const Check check = check_with(before_half(0.25F), answering(false));
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, Contains("conservative answer"));
}

TEST(VisibleIsNotCalledOccluded, AcceptsEitherAnswerAtEqualDepths) {
  for (const bool answer : {false, true}) {
    const Check check = check_with(before_half(0.5F), answering(answer));
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_EQ(check.judgement.counts.permitted, 28U);
    EXPECT_THAT(check.labels, Contains("left open"));
    EXPECT_THAT(check.labels, Not(Contains("conservative answer")));
  }
}

TEST(VisibleIsNotCalledOccluded, GoesByTheContract) {
  DamagedBackend backend({}, "cpu");
  backend.occlusion_damage = answering(true);
  const Case c = before_half(0.5F + 0x1p-20F);
  backend.promised = backend.promise(c);
  EXPECT_EQ(check_of(kLaw, c, backend).violation_count, 1U);
  backend.promised->depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(check_of(kLaw, c, backend).violation_count, 0U);
}

TEST(VisibleIsNotCalledOccluded, DoesNotApplyToWhatAnswersNoQueries) {
  const Check check = check_of(kLaw, before_half(0.75F), Damage{});
  EXPECT_FALSE(check.is_applicable);
  EXPECT_EQ(check.why_not, "the backend answers no occlusion queries");
  DamagedBackend method;
  EXPECT_FALSE(is_promised(*find_law(kLaw), method));
  DamagedBackend cpu({}, "cpu");
  EXPECT_TRUE(is_promised(*find_law(kLaw), cpu));
  Case empty = before_half(0.75F);
  empty.triangles.clear();
  EXPECT_EQ(check_with(empty, {}).why_not, "no triangle to ask about");
}

// The drawing's own attributes and depth test are not part of the question.
TEST(VisibleIsNotCalledOccluded, AsksWithoutAttributes) {
  Case asked;
  std::size_t occluders = 0;
  check_with(before_half(0.75F), [&](const Case& c, std::size_t first, bool&) {
    asked = c;
    occluders = first;
  });
  EXPECT_EQ(occluders, 1U);
  EXPECT_EQ(asked.triangles.size(), 2U);
  EXPECT_TRUE(asked.attributes.empty());
  EXPECT_TRUE(asked.attribute_values.empty());
  EXPECT_EQ(asked.depth_test, cases::DepthTest::less);
}

}  // namespace
}  // namespace rastercheck::properties::visible_is_not_called_occluded_test
