// The law catches a vertex's value that does not come back, names the place, and does not apply if
// nothing is promised.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::vertex_values_come_back_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "values-at-vertices-come-back";

/// 8×8 pixels and a triangle with the corners (1.5, 1.5), (5.5, 1.5) and (1.5, 5.5), each at the
/// centre of a pixel, with w = 1, 4 and 2. Ties go to top and left edges, so only the first
/// corner's sample is drawn. At the first corner the second attribute is a millionth of its values
/// elsewhere.
Case corner() {
  Case c;
  c.framebuffer = {8, 8, 1};
  c.viewport.width = 8;
  c.viewport.height = 8;
  c.positions = {{-0.625F, -0.625F, 0.25F, 1}, {1.5F, -2.5F, 1, 4}, {-1.25F, 0.75F, 0.5F, 2}};
  c.attributes = {{"x", cases::Interpolation::smooth, cases::Location::sample},
                  {"small", cases::Interpolation::noperspective, cases::Location::sample},
                  {"zero", cases::Interpolation::smooth, cases::Location::sample}};
  c.attribute_values = {0.75F, 1e-6F, -0.0F, 6, 1, 1, 2, -1, 3};
  c.triangles = {{0, 1, 2}};
  return c;
}

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

TEST(VertexValues, ComeBackFromCpu) {
  const Check check = checked(corner(), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 1U);
  EXPECT_THAT(check.labels,
              testing::ElementsAre("tie", "vertex value", "vertex value far below the others",
                                   "vertex zero"));
}

// One ulp of the small value is far less than an ulp of the largest of the three values.
TEST(VertexValues, FindsOneUlpOfTheirOwn) {
  const Check check = checked(corner(), [](const Case&, Fragments& drawn) {
    float& small = value(drawn, 0, 1, 1, 1);
    small = std::nextafter(small, 1.0F);
  });
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(violation.kind, AttributeKind::noperspective);
  EXPECT_EQ(violation.place.triangle, 0U);
  EXPECT_EQ(violation.place.x, 1U);
  EXPECT_EQ(violation.place.y, 1U);
  EXPECT_EQ(violation.attribute, 1U);
  EXPECT_THAT(violation.note,
              HasSubstr("vertex 0 lies exactly at this sample and has 9.99999997e-07"));
  ASSERT_TRUE(violation.error.has_value());
  EXPECT_LT(violation.error->hi, 0x1p-18);
}

TEST(VertexValues, FindsWhatIsNoNumber) {
  const Check check = checked(corner(), [](const Case&, Fragments& drawn) {
    value(drawn, 0, 1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    value(drawn, 0, 1, 1, 2) = std::numeric_limits<float>::infinity();
  });
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::infinite);
}

TEST(VertexValues, LeaveTheSignOfZeroAndOtherSamplesAlone) {
  const Check check = checked(corner(), [](const Case&, Fragments& drawn) {
    value(drawn, 0, 1, 1, 2) = 0.0F;
    value(drawn, 0, 2, 1, 0) = 77;
    drawn.depth[find(drawn, 0, 1, 1)] = 77;
  });
  EXPECT_EQ(check.violation_count, 0U);
}

TEST(VertexValues, AreExactlyAtTheSample) {
  const auto is_applicable = [](const Case& c) { return checked(c, {}).is_applicable; };
  Case beside = corner();
  beside.positions[0].x = std::nextafter(beside.positions[0].x, -1.0F);
  EXPECT_FALSE(is_applicable(beside));
  Case fractional = corner();  // no vertex is at a sample
  fractional.viewport.x = 0x1p-20F;
  EXPECT_FALSE(is_applicable(fractional));
}

TEST(VertexValues, OfCentresAreNotAtSamples) {
  Case c = corner();
  c.framebuffer.samples = 4;
  c.positions[0] = {-0.65625F, -0.71875F, 0.25F, 1};  // sample 0 of pixel (1, 1), (6, 2)/16
  c.positions[1].y = -3.5F;                           // above it: the corner is drawn
  EXPECT_TRUE(checked(c, {}).is_applicable);
  for (cases::Attribute& attribute : c.attributes) attribute.location = cases::Location::center;
  EXPECT_FALSE(checked(c, {}).is_applicable);
}

TEST(VertexValues, AreNotJudgedWhereSomeWIsNegativeAndTheyAreFree) {
  Case c = corner();
  c.positions[2] = {1.25F, -0.75F, 0, -2};
  c.depth_clamp = true;
  c.attributes.resize(2);
  c.attribute_values = {0.75F, 1e-6F, 6, 1, 2, -1};
  for (cases::Attribute& a : c.attributes) a.interpolation = cases::Interpolation::noperspective;
  EXPECT_FALSE(checked(c, {}).is_applicable);
}

// If a grid of whole pixels moves the vertex away from the sample, its value need not come back.
TEST(VertexValues, AreJudgedWhereTheVertexStays) {
  Case c = corner();
  c.coverage = cases::Snapping{8};
  c.basis = cases::Basis::snapped;
  const Damage damage = [](const Case&, Fragments& drawn) { value(drawn, 0, 1, 1, 0) = 77; };
  DamagedBackend backend(damage, "cpu");
  cases::Contract contract = backend.contract(c);
  const auto violations = [&] {
    backend.promised = contract;
    return check_of(kLaw, c, backend).violation_count;
  };
  EXPECT_EQ(violations(), 1U);
  contract.coverage->position_error = 0.25F;
  EXPECT_EQ(violations(), 0U);
  contract.basis = cases::Basis::ideal;
  EXPECT_EQ(violations(), 1U);
}

TEST(VertexValues, AreJudgedWherePromised) {
  DamagedBackend backend([](const Case&, Fragments& drawn) { value(drawn, 0, 1, 1, 0) = 77; },
                         "cpu");
  cases::Contract contract = backend.contract(corner());
  EXPECT_TRUE(is_promised(*find_law(kLaw), backend));
  contract.keeps_vertex_values = false;
  backend.promised = contract;
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  EXPECT_FALSE(check_of(kLaw, corner(), backend).is_applicable);
}

TEST(VertexValues, OfTheLawsOwnCasesComeInAllSorts) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_THAT(found.labels(), testing::IsSupersetOf(
                                  {"several samples", "snapped", "tie", "vertex value",
                                   "vertex value far below the others", "vertex zero", "w <= 0"}));
  EXPECT_EQ(found.strata.size(), 9U);
}

}  // namespace
}  // namespace rastercheck::properties::vertex_values_come_back_test
