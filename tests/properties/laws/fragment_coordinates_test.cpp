// `cpu` keeps the law; centres, depths and reciprocals that are slightly off break it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/driver_bounds.h"
#include "tests/properties/laws/own_cases.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::fragment_coordinates_test {
namespace {

using cases::Case;
using cases::Picture;
using cases::Pipeline;
using records::AttributeKind;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "fragment-coordinates-are-those-of-the-sample";

/// Changes a channel of pixel (2, 3) of the square.
PictureDamage change(std::size_t channel, float factor) {
  return [=](const Pipeline&, Picture& picture) {
    picture.color[4 * (3 * 8 + 2) + channel] *= factor;
  };
}

Check damaged(const Case& c, std::size_t channel, float factor) {
  DamagedBackend backend({}, "cpu");
  backend.picture_damage = change(channel, factor);
  return check_of(kLaw, c, backend);
}

/// The square with w = 3 everywhere. 1/3 is no float.
Case farther_square() {
  Case c = square();
  for (cases::ClipVertex& p : c.positions) p = {3 * p.x, 3 * p.y, 3 * p.z, 3};
  return c;
}

TEST(FragmentCoordinates, OfCpuAreThoseOfTheSample) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_THAT(found.labels(), testing::IsSupersetOf({"depth", "1/w", "1/w left open", "clipped",
                                                     "outside the exact triangle", "w <= 0"}));
}

TEST(FragmentCoordinates, FindsACentreThatIsSlightlyOff) {
  const float one_ulp = std::nextafter(1.0F, 2.0F);
  records::Violation violation = only(damaged(square(), 0, one_ulp));
  expect_at(violation, FragmentClass::beyond_bound, AttributeKind::flat, 0, 2, 3);
  EXPECT_EQ(violation.exact, "2.5");
  violation = only(damaged(square(), 1, 0.5F));
  EXPECT_EQ(violation.exact, "3.5");
  EXPECT_THAT(violation.note, HasSubstr("window y"));
}

TEST(FragmentCoordinates, FindsAnotherDepthThanTheStoredOne) {
  const records::Violation violation = only(damaged(square(), 2, std::nextafter(1.0F, 2.0F)));
  expect_at(violation, FragmentClass::beyond_bound, AttributeKind::depth, 0, 2, 3);
  EXPECT_THAT(violation.note, HasSubstr("window z"));
}

// Depths that are changed after the shader has seen them are not those that it sees.
TEST(FragmentCoordinates, JudgesNoDepthThatIsStoredOtherwise) {
  Case c = square();
  c.depth_clamp = true;
  EXPECT_EQ(damaged(c, 2, 0.5F).violation_count, 0U);
  c.depth_clamp = false;
  c.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(damaged(c, 2, 0.5F).violation_count, 0U);
}

// The bound of `cpu` is 0.51 ULP, and half an ULP for the rounding of 1/3 at the vertices.
TEST(FragmentCoordinates, FindsAnotherReciprocal) {
  EXPECT_EQ(damaged(farther_square(), 3, 1).violation_count, 0U);
  const records::Violation violation = only(damaged(farther_square(), 3, 1 + 0x1p-21F));
  expect_at(violation, FragmentClass::beyond_bound, AttributeKind::noperspective, 0, 2, 3);
  EXPECT_EQ(violation.note, "1/w at the sample");
  EXPECT_EQ(damaged(farther_square(), 3, 9).violation_count, 1U);  // w in place of 1/w
}

TEST(FragmentCoordinates, OfADriverHaveItsBounds) {
  DamagedBackend backend({}, "cpu");
  backend.picture_bounds = driver_bounds();
  cases::Contract contract = backend.contract(square());
  contract.bounds.depth = {4};
  contract.bounds.noperspective = {4};
  backend.promised = contract;
  const auto violations = [&](std::size_t channel, float factor) {
    backend.picture_damage = change(channel, factor);
    return check_of(kLaw, farther_square(), backend).violation_count;
  };
  EXPECT_EQ(violations(2, 1 + 0x1p-22F), 0U);
  EXPECT_EQ(violations(2, 1 + 0x1p-18F), 1U);
  EXPECT_EQ(violations(3, 1 + 0x1p-22F), 0U);
  EXPECT_EQ(violations(3, 1 + 0x1p-18F), 1U);
}

TEST(FragmentCoordinates, SaysNothingOfSeveralSamplesOrBackendsWithoutPictures) {
  Case c = square();
  EXPECT_TRUE(check_of(kLaw, c, {}, "cpu").is_applicable);
  c.framebuffer.samples = 4;
  EXPECT_FALSE(check_of(kLaw, c, {}, "cpu").is_applicable);
  DamagedBackend backend;
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
}

}  // namespace
}  // namespace rastercheck::properties::fragment_coordinates_test
