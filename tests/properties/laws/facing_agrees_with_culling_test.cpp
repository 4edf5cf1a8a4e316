// `cpu` keeps the law; facings that are wrong, or that culling does not respect, break it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/driver_bounds.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::facing_agrees_with_culling_test {
namespace {

using cases::Case;
using cases::Cull;
using cases::FrontFace;
using cases::Picture;
using cases::Pipeline;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "facing-agrees-with-culling";

/// The square, with half of it seen from behind.
Case two_sided() {
  Case c = square();
  c.triangles[1] = {1, 2, 3};
  return c;
}

/// Draws pictures of a changed case.
class Misled : public DamagedBackend {
 public:
  explicit Misled(std::function<void(Case&)> mislead)
      : DamagedBackend({}, "cpu"), mislead_(std::move(mislead)) {}
  Result<Picture> draw_picture(const Case& c, const Pipeline& pipeline) override {
    Case changed = c;
    mislead_(changed);
    return DamagedBackend::draw_picture(changed, pipeline);
  }

 private:
  std::function<void(Case&)> mislead_;
};

void turn_round(Picture& picture) {
  for (std::size_t i = 0; i < picture.color.size(); ++i) {
    if (i % 4 != 3 && picture.color[i | 3U] != 0) picture.color[i] = 1 - picture.color[i];
  }
}

TEST(Facing, OfCpuAgreesAndMeetsWhatItIsAbout) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_THAT(found.labels(), testing::IsSupersetOf({"front faces", "back faces", "both", "clipped",
                                                     "several samples", "w <= 0"}));
}

TEST(Facing, IsThatOfTheFrontFaceOfTheCase) {
  for (const FrontFace front : {FrontFace::ccw, FrontFace::cw}) {
    Case c = two_sided();
    c.front_face = front;
    const Check check = check_of(kLaw, c, {}, "cpu");
    EXPECT_TRUE(check.is_applicable);
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_THAT(check.labels, testing::ElementsAre("back faces", "front faces"));
  }
}

TEST(Facing, ShowsTheWrongSign) {
  DamagedBackend backend({}, "cpu");
  backend.picture_damage = [](const Pipeline&, Picture& picture) { turn_round(picture); };
  const Check check = check_of(kLaw, two_sided(), backend);
  // All samples of the culled pictures, and all without culling, of which the oracle is asked too.
  EXPECT_EQ(check.violation_count, 64U + 64 + 64);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
  EXPECT_THAT(check.violations.front().note, HasSubstr("with front faces culled; a back face"));
}

// Facing and culling are both wrong: they agree, but the oracle does not.
TEST(Facing, ShowsBothSidesExchanged) {
  Misled backend([](Case& c) {
    c.front_face = c.front_face == FrontFace::ccw ? FrontFace::cw : FrontFace::ccw;
  });
  const Check check = check_of(kLaw, two_sided(), backend);
  EXPECT_EQ(check.violation_count, 64U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("the facing of the triangle drawn last"));
}

TEST(Facing, ShowsCullingThatIsIgnored) {
  Misled backend([](Case& c) { c.cull = Cull::none; });
  EXPECT_GT(check_of(kLaw, two_sided(), backend).violation_count, 0U);
  Misled lost([](Case& c) {
    if (c.cull == Cull::none) c.cull = Cull::back;
  });
  EXPECT_GT(check_of(kLaw, two_sided(), lost).violation_count, 0U);
}

// A driver promises no equal bits with other faces culled.
TEST(Facing, OfADriverIsThatOfTheOracle) {
  DamagedBackend backend({}, "cpu");
  backend.picture_bounds = driver_bounds();
  backend.promised = backend.contract(two_sided());
  backend.promised->is_invariant = false;
  EXPECT_EQ(check_of(kLaw, two_sided(), backend).violation_count, 0U);
  backend.picture_damage = [](const Pipeline&, Picture& picture) { turn_round(picture); };
  EXPECT_EQ(check_of(kLaw, two_sided(), backend).violation_count, 64U + 64);
}

TEST(Facing, SaysNothingOfBackendsWithoutPictures) {
  DamagedBackend backend;
  EXPECT_FALSE(check_of(kLaw, two_sided(), backend).is_applicable);
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
}

}  // namespace
}  // namespace rastercheck::properties::facing_agrees_with_culling_test
