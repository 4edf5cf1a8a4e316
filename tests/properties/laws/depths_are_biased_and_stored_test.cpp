// The law catches a biased depth that is off by a step of its format, and leaves plain cases alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::depths_are_biased_and_stored_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "depths-are-biased-and-stored-as-promised";

/// Depth 1/4 + 4 · 2^-16, which is 16387.7499 of 65535.
Case biased() {
  Case c = square();
  c.depth_bias.constant = 4;
  c.depth_format = cases::DepthFormat::unorm16;
  return c;
}

TEST(DepthsAreBiasedAndStored, ToTheNearestStep) {
  const Check check = check_of(kLaw, biased(), {}, "cpu");
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::IsSupersetOf({"biased", "unorm"}));
}

TEST(DepthsAreBiasedAndStored, FindsOneStep) {
  const Check check = check_of(
      kLaw, biased(),
      [](const Case&, Fragments& drawn) { drawn.depth[find(drawn, 0, 1, 2)] = 16387.0F / 65535; },
      "cpu");
  expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::depth, 0, 1, 2);
}

TEST(DepthsAreBiasedAndStored, FindsBiasForgotten) {
  Case c = square();
  c.depth_bias.constant = 4;
  const Check check = check_of(
      kLaw, c, [](const Case&, Fragments& drawn) { drawn.depth[find(drawn, 1, 6, 6)] = 0.25F; },
      "cpu");
  expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::depth, 1, 6, 6);
}

TEST(DepthsAreBiasedAndStored, LeavesPlainCasesAlone) {
  EXPECT_FALSE(check_of(kLaw, square(), {}, "cpu").is_applicable);
  const auto scans = backends::make_backend("method:scanline-linear").value();
  EXPECT_FALSE(is_promised(*find_law(kLaw), *scans));
}

}  // namespace
}  // namespace rastercheck::properties::depths_are_biased_and_stored_test
