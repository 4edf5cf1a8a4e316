// The law catches samples that two triangles of a mesh draw, or that none draws, also at a vertex
// and on either side of a plane that cuts all triangles. It does not apply to cases that are not
// triangulations.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::triangulation_covers_once_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-triangulation-of-the-screen-covers-each-sample-once";

/// Four cells around the centre of pixel (4, 4), which reach 4 pixels beyond the screen on each
/// side:
///
///   0 1 2
///   3 4 5     two triangles each, cut from the upper left to the lower right
///   6 7 8
Case screen() {
  Case c = square();
  c.attributes.clear();
  c.attribute_values.clear();
  c.positions.clear();
  c.triangles.clear();
  for (const float y : {-2.0F, 0.125F, 2.0F}) {
    for (const float x : {-2.0F, 0.125F, 2.0F}) c.positions.push_back({x, y, 0.25F, 1});
  }
  for (const std::uint32_t first : {0U, 1U, 3U, 4U}) {
    c.triangles.push_back({first, first + 1, first + 4});
    c.triangles.push_back({first, first + 4, first + 3});
  }
  return c;
}

Check checked(const Case& c, const Damage& damage, const std::string& specification = "cpu") {
  return check_of(kLaw, c, damage, specification);
}

/// The first triangle that drew this pixel.
std::uint32_t drawn_by(const Fragments& drawn, int x, int y) {
  std::uint32_t triangle = 0;
  while (find(drawn, triangle, x, y) == drawn.size()) ++triangle;
  return triangle;
}

TEST(Triangulation, CoversTheScreen) {
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    for (const int samples : {1, 4, 16}) {
      Case c = screen();
      c.rules = rules;
      c.framebuffer.samples = samples;
      c.positions[1].w = 0.5F;
      c.positions[7].w = 0.75F;
      c.cull = cases::Cull::back;
      c.depth_clamp = true;
      const Check check = checked(c, {});
      EXPECT_TRUE(check.is_applicable);
      EXPECT_EQ(check.violation_count, 0U);
      EXPECT_EQ(check.judgement.counts.required, 64U * static_cast<unsigned>(samples));
    }
  }
}

TEST(Triangulation, FindsWhatTwoDrawAndWhatNoneDraws) {
  const Check check = checked(screen(), [](const Case&, Fragments& drawn) {
    drop(drawn, drawn_by(drawn, 4, 4), 4, 4);  // the vertex in the middle
    add(drawn, (drawn_by(drawn, 1, 6) + 1) % 8, 1, 6);
    add(drawn, 3, 8, 0);
  });
  ASSERT_EQ(check.violation_count, 3U);
  std::map<FragmentClass, int> classes;
  for (const records::Violation& violation : check.violations) {
    ++classes[violation.fragment_class];
    if (violation.fragment_class != FragmentClass::missing) continue;
    EXPECT_EQ(violation.place.x, 4U);
    EXPECT_EQ(violation.place.y, 4U);
    EXPECT_EQ(violation.exact, "required: one triangle must cover it");
  }
  EXPECT_EQ(classes[FragmentClass::missing], 1);
  EXPECT_EQ(classes[FragmentClass::extra], 2);
}

// The half with x/w > 0, as a clip distance and as a depth: columns 4 to 7.
TEST(Triangulation, OfAHalfCoversThat) {
  Case distances = screen();
  distances.clip_distance_count = 1;
  Case depths = screen();
  for (cases::ClipVertex& p : depths.positions) {
    distances.clip_distances.push_back(p.x);
    p.z = p.x;
  }
  for (const Case& c : {distances, depths}) {
    const Check whole = checked(c, {});
    EXPECT_TRUE(whole.is_applicable);
    EXPECT_EQ(whole.violation_count, 0U);
    EXPECT_EQ(whole.judgement.counts.required, 32U);
    EXPECT_THAT(whole.labels, testing::Contains("half of the screen"));
    const Check check = checked(c, [](const Case&, Fragments& drawn) {
      add(drawn, 0, 3, 1);
      drop(drawn, drawn_by(drawn, 4, 0), 4, 0);
    });
    ASSERT_EQ(check.violation_count, 2U);
  }
}

TEST(Triangulation, OfTiesLeftOpenIsHeldWhereTwoMeet) {
  constexpr const char* kTextbook = "method:rational-linear";
  EXPECT_EQ(checked(screen(), {}, kTextbook).violation_count, 0U);
  // Pixel (2, 2) lies on the diagonal between two triangles, and pixel (4, 4) where six triangles
  // meet.
  const auto twice = [](int at) {
    return
        [at](const Case&, Fragments& drawn) { add(drawn, drawn_by(drawn, at, at) ^ 1U, at, at); };
  };
  EXPECT_EQ(checked(screen(), twice(2), kTextbook).violation_count, 1U);
  EXPECT_EQ(checked(screen(), twice(4), kTextbook).violation_count, 0U);
}

TEST(Triangulation, DoesNotApplyToOtherMeshes) {
  const auto is_applicable = [](const Case& c) { return checked(c, {}).is_applicable; };
  EXPECT_TRUE(is_applicable(screen()));
  EXPECT_FALSE(is_applicable(square()));  // its outline is the viewport's border
  Case hole = screen();
  hole.triangles.pop_back();
  EXPECT_FALSE(is_applicable(hole));
  Case turned = screen();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_FALSE(is_applicable(turned));
  Case folded = screen();
  folded.positions[4] = {3, 0, 0.25F, 1};
  EXPECT_FALSE(is_applicable(folded));
  Case behind = screen();
  behind.positions[0].w = -1;
  EXPECT_FALSE(is_applicable(behind));
  Case beside = screen();
  for (cases::ClipVertex& p : beside.positions) p.x += 4;
  EXPECT_FALSE(is_applicable(beside));
  Case clipped = screen();
  clipped.positions[4].z = -1;
  EXPECT_FALSE(is_applicable(clipped));
  Case snapped = screen();
  snapped.coverage = cases::Snapping{8};
  EXPECT_TRUE(is_applicable(snapped));
}

TEST(Triangulation, IsWhatTheLawsOwnCasesAre) {
  EXPECT_GT(check_own_cases(kLaw, "cpu", 200).applicable, 190);
}

}  // namespace
}  // namespace rastercheck::properties::triangulation_covers_once_test
