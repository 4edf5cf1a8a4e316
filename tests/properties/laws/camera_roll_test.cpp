// The law catches a vertex stage that works for upright projections only, and a picture that does
// not turn; it reports places in the case with the original camera.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::camera_roll_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kLaw = "a-roll-by-a-quarter-turns-the-picture";

/// A camera at the origin sees triangle A of the square, two units away, in 12×8 pixels.
Case seen() {
  Case c = square();
  c.framebuffer = {12, 8, 1};
  c.viewport = {0.25F, -0.125F, 11.5F, 8.25F, 0, 1};
  c.triangles.pop_back();
  for (cases::ClipVertex& p : c.positions) p = {p.x * 2, p.y * 2, -2, 1};
  c.camera.emplace();
  c.camera->projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0};
  return c;
}

bool is_rolled(const Case& c) { return c.camera->projection[0] == 0; }

Check checked(const Case& c, DamagedBackend& backend) { return check_of(kLaw, c, backend); }

TEST(CameraRoll, TurnsThePictureUnderAllRules) {
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    for (const char* specification : {"cpu", "method:rational-linear"}) {
      Case c = seen();
      c.rules = rules;
      DamagedBackend backend({}, specification);
      const Check check = checked(c, backend);
      EXPECT_TRUE(check.is_applicable);
      EXPECT_EQ(check.violation_count, 0U);
      EXPECT_GT(check.judgement.counts.required, 30U);
    }
  }
}

TEST(CameraRoll, ExchangesTwoRowsOfTheProjection) {
  DamagedBackend backend({}, "cpu");
  std::vector<Case> asked;
  backend.transform_damage = [&](const Case& c, auto&) { asked.push_back(c); };
  EXPECT_THAT(checked(seen(), backend).labels, Contains("vertex stage"));
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].camera->projection,
            (cases::Matrix4{0, -1, 0, 0, 1, 0, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0}));
  EXPECT_EQ(asked[0].framebuffer, (cases::FramebufferSize{8, 12, 1}));
}

// The vertex stage acts as if the numbers beside the diagonal were 0.
TEST(CameraRoll, FindsAVertexStageForUprightCameras) {
  DamagedBackend backend({}, "cpu");
  backend.transform_damage = [](const Case& c, std::vector<cases::ClipVertex>& positions) {
    if (!is_rolled(c)) return;
    for (cases::ClipVertex& p : positions) p.x = 0;
  };
  const Check check = checked(seen(), backend);
  EXPECT_EQ(check.violation_count, 4U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
  EXPECT_THAT(check.violations.front().note, HasSubstr("clip y of vertex 0"));
}

TEST(CameraRoll, FindsClipPositionsThatAreNone) {
  DamagedBackend backend({}, "cpu");
  backend.transform_damage = [](const Case&, std::vector<cases::ClipVertex>& positions) {
    positions[2].w = std::numeric_limits<float>::quiet_NaN();
  };
  const Check check = checked(seen(), backend);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::not_a_number);
}

// Pixel (i, j) = (1, 3) is pixel (8 − 1 − 3, 1) of the turned picture.
TEST(CameraRoll, FindsWhatIsMissingInThePlaceOfTheCameraAsItWas) {
  DamagedBackend backend(
      [](const Case& c, Fragments& drawn) {
        if (c.framebuffer.width == 8) drop(drawn, 0, 4, 1);
      },
      "cpu");
  const Check check = checked(seen(), backend);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations.front().place.x, 1U);
  EXPECT_EQ(check.violations.front().place.y, 3U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("turned by a quarter, at pixel (4, 1)"));
}

TEST(CameraRoll, HandsPositionsToBackendsWithoutAVertexStage) {
  class Flat : public DamagedBackend {
   public:
    Flat() : DamagedBackend({}, "cpu") {}
    backends::VertexStage* vertex_stage() override { return nullptr; }
  };
  Flat backend;
  const Check check = checked(seen(), backend);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_GT(check.judgement.counts.required, 30U);
  EXPECT_THAT(check.labels, Not(Contains("vertex stage")));
}

TEST(CameraRoll, SaysNothingOfWhatDoesNotTurn) {
  DamagedBackend backend({}, "cpu");
  EXPECT_FALSE(checked(square(), backend).is_applicable);  // the square has no camera
  Case pattern = seen();
  pattern.framebuffer.samples = 8;
  EXPECT_FALSE(checked(pattern, backend).is_applicable);
  Case no_float = seen();
  no_float.viewport.y = 0x1p-30F;
  EXPECT_FALSE(checked(no_float, backend).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::camera_roll_test
