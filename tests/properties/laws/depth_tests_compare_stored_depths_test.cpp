// The law catches depth tests that compare what is not stored, of fragments or of the cleared
// buffer.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::depth_tests_compare_stored_depths_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "depth-tests-compare-stored-depths";

/// Triangle A of the square twice, at depths that are stored as 16384 of 65535.
Case layers() {
  Case c = square();
  constexpr float kNearer = 0.25F - 0x1p-20F;
  c.positions = {{-1, -1, 0.25F, 1},   {1, -1, 0.25F, 1},   {-1, 1, 0.25F, 1},
                 {-1, -1, kNearer, 1}, {1, -1, kNearer, 1}, {-1, 1, kNearer, 1}};
  c.attribute_values.assign(c.positions.size() * 3, 0);
  c.triangles = {{0, 1, 2}, {3, 4, 5}};
  c.depth_format = cases::DepthFormat::unorm16;
  return c;
}

bool is_tested(const Case& c) { return c.depth_test == cases::DepthTest::less; }

TEST(DepthTests, CompareStoredDepths) {
  const Check check = check_of(kLaw, layers(), {}, "cpu");
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 28U);
  EXPECT_THAT(check.labels, testing::IsSupersetOf({"equal as stored", "unorm"}));
}

TEST(DepthTests, DoNotCompareWhatWasNotStored) {
  const Damage leaves_second = [](const Case& c, Fragments& drawn) {
    if (is_tested(c)) drawn.triangle[find(drawn, 0, 1, 2)] = 1;
  };
  expect_at(only(check_of(kLaw, layers(), leaves_second, "cpu")), FragmentClass::wrong_triangle,
            AttributeKind::coverage, 1, 1, 2);
}

TEST(DepthTests, LeaveSomething) {
  const Damage loses = [](const Case& c, Fragments& drawn) {
    if (is_tested(c)) drop(drawn, 0, 1, 2);
  };
  expect_at(only(check_of(kLaw, layers(), loses, "cpu")), FragmentClass::missing,
            AttributeKind::coverage, 0, 1, 2);
}

// 0.25 is not less than the cleared 0.25 + 2^-20 as stored.
TEST(DepthTests, CompareWithWhatTheBufferWasClearedTo) {
  Case c = layers();
  c.depth_clear = 0.25F + 0x1p-20F;
  const Check right = check_of(kLaw, c, {}, "cpu");
  EXPECT_EQ(right.violation_count, 0U);
  EXPECT_THAT(right.labels, testing::Contains("equal to cleared"));
  const Damage adds = [](const Case& drawn_case, Fragments& drawn) {
    if (is_tested(drawn_case)) add(drawn, 0, 1, 2);
  };
  expect_at(only(check_of(kLaw, c, adds, "cpu")), FragmentClass::extra, AttributeKind::coverage, 0,
            1, 2);
}

TEST(DepthTests, OfOtherDirectionsAreLeftOut) {
  DamagedBackend backend({}, "cpu");
  backend.promised = backend.promise(layers());
  backend.promised->depth_function = cases::KeptDepth::greater;
  EXPECT_FALSE(check_of(kLaw, layers(), backend).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::depth_tests_compare_stored_depths_test
