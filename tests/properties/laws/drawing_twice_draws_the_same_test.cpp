// The law catches state that one drawing leaves behind for the next.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "properties/law.h"
#include "tests/properties/laws/picture_backend.h"

namespace rastercheck::properties::drawing_twice_draws_the_same_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "drawing-twice-draws-the-same-bits";

TEST(DrawingTwice, DrawsTheSame) {
  std::vector<Case> drawn;
  const Check check =
      check_of(kLaw, square(), [&](const Case& c, Fragments&) { drawn.push_back(c); });
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 128U);
  EXPECT_THAT(check.labels, testing::ElementsAre("drawn"));
  ASSERT_EQ(drawn.size(), 4U);
  EXPECT_EQ(drawn[0], drawn[1]);
  EXPECT_EQ(drawn[0], drawn[3]);
  const Case& other = drawn[2];
  EXPECT_GT(other.framebuffer.width, 8);
  EXPECT_EQ(other.framebuffer.samples, 4);
  EXPECT_NE(other.rules, drawn[0].rules);
  EXPECT_EQ(other.attribute_values.size(), other.attributes.size() * other.positions.size());
  EXPECT_EQ(other.clip_distances.size(), other.positions.size());
  EXPECT_EQ(other.triangles.size(), 4U);
}

TEST(DrawingTwice, FindsWhatTheFirstLeavesBehind) {
  int count = 0;
  const Check check = check_of(kLaw, square(), [&](const Case&, Fragments& drawn) {
    // The other case, which is drawn in between, has its triangles elsewhere.
    if (++count > 1 && is_drawn(drawn, 0, 1, 1)) {
      value(drawn, 0, 1, 1, 1) = std::nextafter(1.0F, 2.0F);
    }
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().attribute, 1U);
  EXPECT_EQ(check.violations.front().place.x, 1U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("the first drawing"));
}

TEST(DrawingTwice, FindsWhatAnotherCaseLeavesBehind) {
  int before = 0;
  const Check check = check_of(kLaw, square(), [&](const Case& c, Fragments& drawn) {
    if (before > c.framebuffer.width) drop(drawn, 0, 1, 1);
    before = c.framebuffer.width;
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
  EXPECT_THAT(check.violations.front().note, HasSubstr("after another case"));
}

TEST(DrawingTwice, FindsWhatIsLeftInAPicture) {
  PictureBackend backend;
  EXPECT_EQ(check_of(kLaw, square(), backend).violation_count, 0U);
  int count = 0;
  backend.picture_damage = [&](const cases::Pipeline&, cases::Picture& picture) {
    if (++count == 4) picture.depth.back() = 0.125F;
  };
  const Check check = check_of(kLaw, square(), backend);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().kind, records::AttributeKind::depth);
  EXPECT_THAT(check.violations.front().note, HasSubstr("a picture, "));
}

}  // namespace
}  // namespace rastercheck::properties::drawing_twice_draws_the_same_test
