// The law catches clip positions that are farther off than the contract allows, or that are not
// numbers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::vertex_stage_stays_within_its_bound_test {
namespace {

using cases::Case;
using cases::ClipVertex;
using records::FragmentClass;

constexpr std::string_view kLaw = "the-vertex-stage-stays-within-its-bound";

/// The square seen by a camera that moves it by 3 and back, exactly.
Case seen_square() {
  Case c = square();
  c.camera.emplace();
  c.camera->model[3] = 3;
  c.camera->view[3] = -3;
  return c;
}

Check checked(const Case& c, TransformDamage damage) {
  DamagedBackend backend({}, "cpu");
  backend.transform_damage = std::move(damage);
  return check_of(kLaw, c, backend);
}

records::Violation only_of(const Check& check) {
  EXPECT_EQ(check.violation_count, 1U);
  return check.violations.empty() ? records::Violation{} : check.violations.front();
}

TEST(VertexStageBound, HoldsOfCpu) {
  const Check check = checked(seen_square(), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 4U);
}

// z of vertex 3 is 1/4 and nothing cancels: an error of half an ulp plus 8 (1 + 2^-23) 2^-53 / 4 is
// allowed.
TEST(VertexStageBound, FindsOneUlpAndNamesVertexAndTriangle) {
  const auto damage = [](const Case&, std::vector<ClipVertex>& clip) {
    clip[3].z = std::nextafter(clip[3].z, 1.0F);
  };
  const records::Violation violation = only_of(checked(seen_square(), damage));
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(violation.place.triangle, 1U);
  EXPECT_EQ(violation.exact, "1/4");
  EXPECT_EQ(violation.error, (records::Enclosure{1, 1}));
  ASSERT_TRUE(violation.bound.has_value());
  EXPECT_LT(violation.bound->hi, 0.5 + 0x1p-26);
  EXPECT_GT(violation.bound->lo, 0.5);
  EXPECT_EQ(violation.note, "clip z of vertex 3; errors in its ULP");
}

// x of vertex 0 is 0 + 3 − 3: |V| |M| |p| is 6, so that an error of 48 · 2^-53 is allowed, and
// little more.
TEST(VertexStageBound, LeavesWhatCancellationCostsAndNoMore) {
  Case c = seen_square();
  c.positions[0].x = 0;
  const auto at = [&c](float x) {
    return checked(c, [x](const Case&, std::vector<ClipVertex>& clip) { clip[0].x = x; });
  };
  EXPECT_EQ(at(48 * 0x1p-53F).violation_count, 0U);
  EXPECT_EQ(at(-48 * 0x1p-53F).violation_count, 0U);
  EXPECT_EQ(at(49 * 0x1p-53F).violation_count, 1U);
  EXPECT_EQ(at(-49 * 0x1p-53F).violation_count, 1U);
  EXPECT_THAT(at(0).labels, testing::ElementsAre("cancellation"));
  EXPECT_EQ(at(0).violation_count, 0U);
}

TEST(VertexStageBound, FindsWhatIsNoNumber) {
  const auto damage = [](const Case&, std::vector<ClipVertex>& clip) {
    clip[1].x = std::numeric_limits<float>::quiet_NaN();
    clip[2].w = std::numeric_limits<float>::infinity();
  };
  const Check check = checked(seen_square(), damage);
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::infinite);
}

// From half an ulp below 2^128 on, an infinity of the same sign is right.
TEST(VertexStageBound, TakesInfinityForWhatIsBeyondFloat32) {
  Case c = seen_square();
  c.camera->model[3] = 0;
  c.camera->view[3] = 0;
  c.positions[0].y = 0x1p127F;
  c.camera->projection[5] = 2;
  EXPECT_EQ(checked(c, {}).violation_count, 0U);
  EXPECT_THAT(checked(c, {}).labels, testing::Contains("beyond float32"));
  const auto at = [&c](float y) {
    return checked(c, [y](const Case&, std::vector<ClipVertex>& clip) { clip[0].y = y; })
        .violation_count;
  };
  EXPECT_EQ(at(-std::numeric_limits<float>::infinity()), 1U);
  // The largest float is 2^104 below the exact 2^128; half an ulp, 2^103, covers only half of that.
  EXPECT_EQ(at(std::numeric_limits<float>::max()), 1U);
  c.positions[0].y = 0x1.fffffep126F;
  EXPECT_EQ(at(std::numeric_limits<float>::infinity()), 1U);
}

TEST(VertexStageBound, SaysNothingWithoutACameraOrAPromise) {
  EXPECT_FALSE(checked(square(), {}).is_applicable);
  DamagedBackend backend({}, "cpu");
  cases::Contract contract = backend.contract(square());
  contract.transform_bound.reset();
  backend.promised = contract;
  EXPECT_FALSE(check_of(kLaw, seen_square(), backend).is_applicable);
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
}

TEST(VertexStageBound, RefusesAnotherNumberOfPositions) {
  DamagedBackend backend({}, "cpu");
  backend.transform_damage = [](const Case&, std::vector<ClipVertex>& clip) { clip.pop_back(); };
  const auto check = check_law(*find_law(kLaw), seen_square(), backend, 0);
  ASSERT_FALSE(check.has_value());
  EXPECT_EQ(check.error().reason,
            "the number of the backend's clip positions differs from the number of vertices");
}

TEST(VertexStageBound, MeetsCancellationAndSubnormals) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 100);
  EXPECT_THAT(found.labels(), testing::ElementsAre("cancellation", "subnormal", "w <= 0"));
  EXPECT_THAT(found.strata, testing::ElementsAre("any matrices", "far from the origin", "huge",
                                                 "mirrored and sheared", "ordinary", "tiny"));
}

}  // namespace
}  // namespace rastercheck::properties::vertex_stage_stays_within_its_bound_test
