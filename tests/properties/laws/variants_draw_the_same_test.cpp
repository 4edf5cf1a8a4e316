// The law compares a backend with the specifications that it names as equal, and does not apply if
// it names none.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backends/factory.h"
#include "properties/law.h"
#include "tests/properties/laws/picture_backend.h"

namespace rastercheck::properties::variants_draw_the_same_test {
namespace {

using cases::Case;
using cases::Fragments;
using testing::HasSubstr;

constexpr std::string_view kLaw = "threads-tiles-and-simd-change-no-bit";

Result<Check> checked(DamagedBackend& backend) {
  return check_law(*find_law(kLaw), square(), backend, 0);
}

TEST(Variants, DrawTheSame) {
  DamagedBackend backend({}, "cpu");
  backend.same_as_these = {"cpu:output=framebuffer", "cpu:output=framebuffer,threads=3"};
  const Check check = checked(backend).value();
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 128U);
  EXPECT_THAT(check.labels, testing::ElementsAre("drawn", "three attributes and more"));
}

TEST(Variants, AreNoMoreThanTwoAtATime) {
  DamagedBackend backend({}, "cpu");
  backend.same_as_these.assign(9, "cpu");
  EXPECT_EQ(checked(backend)->judgement.counts.required, 2 * 64U);
}

TEST(Variants, HaveTheSameLastBits) {
  DamagedBackend backend(
      [](const Case&, Fragments& drawn) {
        value(drawn, 0, 1, 1, 0) = std::nextafter(value(drawn, 0, 1, 1, 0), 0.0F);
      },
      "cpu");
  backend.same_as_these = {"cpu:output=framebuffer"};
  const Check check = checked(backend).value();
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, records::FragmentClass::beyond_bound);
  EXPECT_EQ(violation.attribute, 0U);
  EXPECT_EQ(violation.exact, "1.5 (0x1.8p+0)");
  EXPECT_EQ(violation.note, "cpu:output=framebuffer draws the expected value");
}

TEST(Variants, DrawTheSamePictures) {
  PictureBackend backend;
  backend.same_as_these = {"cpu"};
  EXPECT_EQ(checked(backend)->violation_count, 0U);
  backend.picture_damage = [](const cases::Pipeline&, cases::Picture& picture) {
    picture.color[5] += 0.125F;
  };
  const Check check = checked(backend).value();
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("cpu draws the expected value; "));
}

TEST(Variants, HaveToBeThere) {
  DamagedBackend backend({}, "cpu");
  backend.same_as_these = {"cpu:nonsense"};
  EXPECT_FALSE(checked(backend));
}

TEST(Variants, AreNotPromisedByABackendThatNamesNone) {
  DamagedBackend backend({}, "cpu");
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  EXPECT_FALSE(checked(backend)->is_applicable);
  EXPECT_TRUE(is_promised(*find_law(kLaw), *backends::make_backend("cpu").value()));
}

}  // namespace
}  // namespace rastercheck::properties::variants_draw_the_same_test
