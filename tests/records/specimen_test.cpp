#include "records/specimen.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>

namespace rastercheck::records::specimen_test {
namespace {

/// Two by one pixels at (3, 5), with two samples each, a depth and an attribute; all are drawn.
Specimen small() {
  Specimen specimen;
  specimen.key = {"law", "cpu", Origin::random, 7};
  specimen.left = 3;
  specimen.top = 5;
  specimen.width = 2;
  specimen.height = 1;
  specimen.samples = 2;
  specimen.attributes = 1;
  specimen.drawn = {true, true, true, true};
  for (const float value : {0.5F, 1.0F, 0.5F, 2.0F, 0.5F, 3.0F, 0.5F, 4.0F}) {
    specimen.bits.push_back(std::bit_cast<std::uint32_t>(value));
  }
  return specimen;
}

void set(Specimen& specimen, std::size_t at, float value) {
  specimen.bits[at] = std::bit_cast<std::uint32_t>(value);
}

// Kills: exchanging x and y; putting samples before pixels; counting from the framebuffer's corner.
TEST(Specimen, FindsSamplesByTheirPlace) {
  const Specimen specimen = small();
  EXPECT_EQ(specimen.index_of(3, 5, 1), 1U);
  EXPECT_EQ(specimen.index_of(4, 5, 0), 2U);
  EXPECT_EQ(specimen.value_at(4, 5, 0, std::nullopt), 0.5F);
  EXPECT_EQ(specimen.value_at(4, 5, 1, 0), 4.0F);
  for (const auto& [x, y, sample] :
       {std::array{2U, 5U, 0U}, {5U, 5U, 0U}, {3U, 4U, 0U}, {3U, 6U, 0U}, {3U, 5U, 2U}}) {
    EXPECT_FALSE(specimen.index_of(x, y, sample)) << x << ' ' << y << ' ' << sample;
  }
  EXPECT_FALSE(specimen.value_at(4, 5, 1, 1)) << "there is one attribute";
}

TEST(Specimen, HasNoValueWhereNothingIsDrawn) {
  Specimen specimen = small();
  specimen.drawn[3] = false;
  EXPECT_FALSE(specimen.value_at(4, 5, 1, 0));
}

TEST(IsSamePart, AsksNeitherWhoDrewNorWhat) {
  Specimen other = small();
  other.key.backend = "gl";
  other.bits[0] = 0;
  EXPECT_TRUE(is_same_part(small(), other));
  other.triangle = 1;
  EXPECT_FALSE(is_same_part(small(), other));
  other = small();
  other.key.index = 8;
  EXPECT_FALSE(is_same_part(small(), other));
}

TEST(ChangeOf, IsNothingOfTheSameBits) {
  Specimen specimen = small();
  set(specimen, 3, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(change_of(specimen, specimen), std::nullopt);
}

// The attribute is at most 4, where float32 numbers are 2^-21 apart. Depths are at most 1/2, where
// they are 2^-24 apart.
TEST(ChangeOf, CountsSpacingsOfTheLargestValue) {
  Specimen after = small();
  set(after, 1, 1 + 0x1p-19F);         // 4 spacings of the attribute
  set(after, 4, 0.5F + 3 * 0x1p-24F);  // 3 spacings of the depth
  EXPECT_EQ(change_of(small(), after), (SpecimenChange{2, 0, 0, 4}));
  set(after, 6, 0.5F - 5 * 0x1p-24F);
  EXPECT_EQ(change_of(small(), after), (SpecimenChange{3, 3, std::nullopt, 5}));
}

// Kills: losing a sample that appears or disappears, or a NaN, among numbers that changed.
TEST(ChangeOf, PutsWhatHasNoSizeFirst) {
  Specimen after = small();
  set(after, 1, 1000);
  after.drawn[2] = false;
  EXPECT_EQ(change_of(small(), after),
            (SpecimenChange{2, 2, std::nullopt, std::numeric_limits<double>::infinity()}));
  after = small();
  set(after, 7, std::numeric_limits<float>::infinity());
  EXPECT_EQ(change_of(small(), after),
            (SpecimenChange{1, 3, 0, std::numeric_limits<double>::infinity()}));
}

// The distance of −0 and +0 is 0, and yet they are different values.
TEST(ChangeOf, SeesTheSignOfZero) {
  Specimen before = small();
  set(before, 0, 0);
  Specimen after = before;
  set(after, 0, -0.0F);
  EXPECT_EQ(change_of(before, after), (SpecimenChange{1, 0, std::nullopt, 0}));
}

}  // namespace
}  // namespace rastercheck::records::specimen_test
