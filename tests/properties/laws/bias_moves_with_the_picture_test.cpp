// The law catches a bias that depends on where the picture lies.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::bias_moves_with_the_picture_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-bias-moves-with-the-picture";

Case biased(std::uint64_t choices) {
  Case c = square();
  c.depth_bias.constant = 1024;
  c.choices = choices;
  return c;
}

TEST(BiasMoves, WithThePicture) {
  const std::array labels{"moved", "mirrored", "turned"};
  for (std::uint64_t way = 0; way < 3; ++way) {
    const Check check = check_of(kLaw, biased(way), {}, "cpu");
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_THAT(check.labels, testing::Contains(labels[way]));
  }
}

TEST(BiasMoves, AndIsTheSameElsewhere) {
  const Damage by_viewport = [](const Case& c, Fragments& drawn) {
    if (c.viewport.x == 0 && c.viewport.y == 0) return;
    for (float& depth : drawn.depth) depth += 0x1p-10F;
  };
  EXPECT_GT(check_of(kLaw, biased(3), by_viewport, "cpu").violation_count, 0U);
}

TEST(BiasMoves, OnlyWhereThereIsOne) {
  EXPECT_FALSE(check_of(kLaw, square(), {}, "cpu").is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::bias_moves_with_the_picture_test
