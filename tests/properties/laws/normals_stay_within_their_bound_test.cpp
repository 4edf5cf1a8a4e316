// The law catches normals that are farther off than the contract allows, that lean, that face
// inwards, or that are not numbers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::normals_stay_within_their_bound_test {
namespace {

using cases::Case;
using cases::Matrix4;
using cases::Normal;
using records::FragmentClass;

constexpr std::string_view kLaw = "normals-stay-within-their-bound";

/// The square with (0, 3, 4) and (0, 0, 2) as its first positions, and a model that stretches x.
Case stretched() {
  Case c = square();
  c.camera.emplace();
  c.camera->model[0] = 4;
  c.positions[0] = {0, 3, 4, 1};
  c.positions[1] = {0, 0, 2, 1};
  return c;
}

Check checked(const Case& c, NormalDamage damage) {
  DamagedBackend backend({}, "cpu");
  backend.normal_damage = std::move(damage);
  return check_of(kLaw, c, backend);
}

Check with(const Case& c, const Normal& first) {
  return checked(c, [first](const Matrix4&, std::vector<Normal>& world) { world[0] = first; });
}

TEST(NormalsBound, HoldsOfCpu) {
  const Check check = checked(stretched(), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 4U);
  EXPECT_THAT(check.labels, testing::ElementsAre());
}

// The unit normal has 3/5 and 4/5. An error of 2^-25 (half an ulp) plus a few 2^-53 is allowed, and
// only the nearest float is that close.
TEST(NormalsBound, FindsOneUlpAndNamesTheNormal) {
  EXPECT_EQ(with(stretched(), {0, 0.6F, 0.8F}).violation_count, 0U);
  const Check check = with(stretched(), {0, std::nextafter(0.6F, 1.0F), 0.8F});
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations[0];
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(violation.exact, "0.6");
  EXPECT_EQ(violation.note, "y of the unit normal computed from (0, 3, 4), position 0");
}

// A computed value in place of a zero is off by its own size. Allowed is (4 + 8 (1 + 2^-23)) 2^-53,
// which is about 12 · 2^-53, because K = 1: 11.5 · 2^-53 is within, and 12.5 · 2^-53 is beyond.
TEST(NormalsBound, LeavesTheBoundAndNoMore) {
  EXPECT_EQ(with(stretched(), {0x1.7p-50F, 0.6F, 0.8F}).violation_count, 0U);
  EXPECT_EQ(with(stretched(), {-0x1.7p-50F, 0.6F, 0.8F}).violation_count, 0U);
  EXPECT_EQ(with(stretched(), {0x1.9p-50F, 0.6F, 0.8F}).violation_count, 1U);
  EXPECT_EQ(with(stretched(), {-0x1.9p-50F, 0.6F, 0.8F}).violation_count, 1U);
}

// The matrix itself used in place of its cofactors is right only for normals along the axes.
TEST(NormalsBound, FindsNormalsThatLean) {
  Case c = stretched();
  c.positions[0] = {1, 0, 1, 1};
  const auto of_root = [](double x) { return static_cast<float>(x / std::sqrt(17.0)); };
  EXPECT_EQ(checked(c, {}).violation_count, 0U);
  EXPECT_EQ(with(c, {of_root(1), 0, of_root(4)}).violation_count, 0U);
  EXPECT_EQ(with(c, {of_root(4), 0, of_root(1)}).violation_count, 2U);
}

TEST(NormalsBound, FindsMirroredNormalsThatFaceInwards) {
  Case c = stretched();
  c.camera->model[0] = -4;
  EXPECT_THAT(checked(c, {}).labels, testing::ElementsAre("mirrored"));
  EXPECT_EQ(checked(c, {}).violation_count, 0U);
  EXPECT_EQ(with(c, {0, -0.6F, -0.8F}).violation_count, 2U);
}

TEST(NormalsBound, FindsWhatIsNoNumber) {
  const float infinity = std::numeric_limits<float>::infinity();
  const Check check = with(stretched(), {0, std::nanf(""), infinity});
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::infinite);
}

// The model flattens everything into the plane of these two tangents. A normal equal to one of them
// has no image: its terms cancel, and the rounding errors that remain are not a direction.
TEST(NormalsBound, WantsZeroWhereThereIsNoDirection) {
  Case c = stretched();
  c.camera->model = {0.1F, 0.2F, 0.3F, 0, 0.7F, 0.5F, 0.9F, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  c.positions[0] = {0.1F, 0.2F, 0.3F, 1};
  const Check check = checked(c, {});
  EXPECT_THAT(check.labels, testing::ElementsAre("no direction", "singular"));
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(with(c, {0, 0, 1}).violation_count, 1U);
  EXPECT_EQ(with(c, {-0.0F, 0, 0}).violation_count, 0U);
}

TEST(NormalsBound, SaysNothingWithoutACameraOrAPromise) {
  EXPECT_FALSE(checked(square(), {}).is_applicable);
  DamagedBackend backend({}, "cpu");
  cases::Contract contract = backend.contract(square());
  contract.normal_bound.reset();
  backend.promised = contract;
  EXPECT_FALSE(check_of(kLaw, stretched(), backend).is_applicable);
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
}

TEST(NormalsBound, RefusesAnotherNumberOfNormals) {
  DamagedBackend backend({}, "cpu");
  backend.normal_damage = [](const Matrix4&, std::vector<Normal>& world) { world.pop_back(); };
  const auto check = check_law(*find_law(kLaw), stretched(), backend, 0);
  ASSERT_FALSE(check.has_value());
  EXPECT_EQ(check.error().reason,
            "the backend returned another number of normals than it was given");
}

TEST(NormalsBound, MeetsWhatItIsAbout) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_THAT(found.labels(),
              testing::ElementsAre("cancellation", "mirrored", "no direction", "singular"));
  EXPECT_THAT(found.strata, testing::ElementsAre("any matrix", "extreme", "flat", "nearly singular",
                                                 "rotated", "scaled"));
}

}  // namespace
}  // namespace rastercheck::properties::normals_stay_within_their_bound_test
