// The law catches values and depths that belong to another place than the sample's, and a vertex
// stage that depends on how the camera is split into matrices.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backends/factory.h"
#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::camera_form_equals_clip_form_test {
namespace {

using cases::Case;
using cases::ClipVertex;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "camera-form-equals-clip-form";

/// A triangle that slopes away from the camera, with w from 1 to 4; it fills most of 8×8 pixels.
Case seen_at_a_slant() {
  Case c = square();
  c.attributes.clear();
  c.attribute_values.clear();
  c.camera.emplace();
  c.camera->model = {1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  c.camera->view = {1, 0, 0, -2, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1};
  c.camera->projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -0.5F, 0, 0, -1, 0};
  c.positions = {{-1, 1, -1, 1}, {1, 1, -1, 1}, {0, 4, 4, 1}};
  c.triangles = {{0, 1, 2}};
  return c;
}

Check checked(const Case& c, DamagedBackend& backend) { return check_of(kLaw, c, backend); }

Check checked(const Case& c, const Damage& damage, const std::string& specification = "cpu") {
  return check_of(kLaw, c, damage, specification);
}

TEST(CameraForm, ShowsWhatLiesOnTheRay) {
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    Case c = seen_at_a_slant();
    c.rules = rules;
    c.viewport = {0.25F, 8, 7.5F, -7.75F, 0.25F, 0.75F};
    if (rules != cases::Rules::vulkan) c.viewport = {0.25F, 0.5F, 7.5F, 7.25F, 0.25F, 0.75F};
    Case seen;
    const Check check = checked(c, [&seen](const Case& drawn, Fragments&) { seen = drawn; });
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_GT(check.judgement.counts.required, 15U);
    EXPECT_EQ(seen.positions[2], (ClipVertex{0, 4, 3.5F, 4}));
    EXPECT_EQ(seen.attributes_of(2)[1], 4);
  }
}

// x is at most 1, and 8 ulps of 1 are far beyond 0.51.
TEST(CameraForm, FindsValuesOfAnotherPlace) {
  const Check check = checked(seen_at_a_slant(), [](const Case&, Fragments& drawn) {
    drawn.attributes[3 * 4] += 8 * 0x1p-23F;
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().kind, records::AttributeKind::smooth);
  EXPECT_THAT(check.violations.front().note, HasSubstr("along x"));
}

TEST(CameraForm, FindsADepthOfAnotherPlace) {
  const Check check = checked(seen_at_a_slant(), [](const Case&, Fragments& drawn) {
    drawn.depth[4] += 0.001F;
    drawn.depth[5] = std::nanf("");
  });
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations.front().kind, records::AttributeKind::depth);
}

TEST(CameraForm, FindsAffineValues) {
  const Check check = checked(seen_at_a_slant(), [](const Case& c, Fragments& drawn) {
    Case affine = c;
    for (cases::Attribute& attribute : affine.attributes) {
      attribute.interpolation = cases::Interpolation::noperspective;
    }
    drawn = backends::make_backend("cpu").value()->draw(affine).value().fragments;
  });
  EXPECT_GT(check.violation_count, 10U);
}

TEST(CameraForm, FindsAVertexStageThatDependsOnTheMatrices) {
  DamagedBackend backend({}, "cpu");
  backend.transform_damage = [](const Case& c, std::vector<ClipVertex>& positions) {
    if (c.camera->view == cases::kIdentity) positions[1].y += 0.25F;
  };
  const Check check = checked(seen_at_a_slant(), backend);
  EXPECT_GT(check.violation_count, 0U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(check.violations.front().note,
            "clip y of vertex 1, with the matrices distributed differently");
}

TEST(CameraForm, LeavesWhatIsRoundedAlone) {
  const auto is_applicable = [](const Case& c) { return checked(c, {}).is_applicable; };
  EXPECT_TRUE(is_applicable(seen_at_a_slant()));
  EXPECT_FALSE(is_applicable(square()));
  Case rounded = seen_at_a_slant();
  rounded.camera->view[0] = 0x1.234568p+0F;
  rounded.camera->projection[0] = 0x1.234568p+0F;
  EXPECT_FALSE(is_applicable(rounded));
  Case homogeneous = seen_at_a_slant();
  homogeneous.positions[0].w = 2;
  EXPECT_FALSE(is_applicable(homogeneous));
}

// Values of snapped vertices are judged by how far snapping may move them; those of a method by
// what its contract leaves open.
TEST(CameraForm, HoldsOfSnappedVerticesToTheirReach) {
  Case c = seen_at_a_slant();
  c.coverage = cases::Snapping{4};
  c.basis = cases::Basis::snapped;
  EXPECT_EQ(checked(c, {}).violation_count, 0U);
  const auto off = [](const Case&, Fragments& drawn) { drawn.attributes[3 * 4] += 0.25F; };
  EXPECT_EQ(checked(c, off).violation_count, 1U);
  EXPECT_EQ(checked(seen_at_a_slant(), off, "method:rational-linear").violation_count, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::camera_form_equals_clip_form_test
