#include "oracle/internal/number.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace rastercheck::oracle::number_test {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Field ratio(long p, long q) { return Field(p) / Field(q); }

TEST(Number, FloorAndCeilingRoundTowardsTheirInfinity) {
  EXPECT_EQ(floor_to_long(ratio(7, 2)), 3);
  EXPECT_EQ(floor_to_long(ratio(-7, 2)), -4);
  EXPECT_EQ(floor_to_long(Field(-4)), -4);
  EXPECT_EQ(ceil_to_long(ratio(7, 2)), 4);
  EXPECT_EQ(ceil_to_long(ratio(-7, 2)), -3);
  EXPECT_EQ(ceil_to_long(Field(5)), 5);
}

TEST(Number, FloorLog2IsTheExponentOfTheLargestPowerNotAbove) {
  EXPECT_EQ(floor_log2(Field(1)), 0);
  EXPECT_EQ(floor_log2(ratio(-1, 3)), -2);
  EXPECT_EQ(floor_log2(ratio(2, 3)), -1);
  EXPECT_EQ(floor_log2(ratio(1023, 1024)), -1);
  EXPECT_EQ(floor_log2(ratio(4, 3)), 0);
  EXPECT_EQ(floor_log2(power_of_two(-149)), -149);
  EXPECT_EQ(floor_log2(power_of_two(127)), 127);
}

TEST(NearestFloat, TiesGoToTheEvenNeighbour) {
  EXPECT_EQ(nearest_float(Field(16777217)), 16777216.0F);
  EXPECT_EQ(nearest_float(Field(16777219)), 16777220.0F);
  EXPECT_EQ(nearest_float(ratio(1, 3)), 1.0F / 3.0F);
}

TEST(NearestFloat, SubnormalsAreKeptAndRoundedToTheirGrid) {
  EXPECT_EQ(nearest_float(power_of_two(-149)), 0x1p-149F);
  EXPECT_EQ(nearest_float(power_of_two(-150)), 0.0F);
  EXPECT_EQ(nearest_float(Field(3) * power_of_two(-150)), 0x1p-148F);
  EXPECT_EQ(nearest_float(Field(power_of_two(-150) + power_of_two(-400))), 0x1p-149F);
  EXPECT_EQ(nearest_float(-power_of_two(-149)), -0x1p-149F);
}

TEST(NearestFloat, OverflowsHalfAnUlpBeyondTheLargest) {
  const Field limit = Field(double{kLargest}) + power_of_two(103);
  EXPECT_EQ(nearest_float(limit), kInfinity);
  EXPECT_EQ(nearest_float(Field(limit - power_of_two(-300))), kLargest);
  EXPECT_EQ(nearest_float(-power_of_two(5000)), -kInfinity);
}

RC_GTEST_PROP(NearestFloat, IsTheConversionOfEveryDouble, ()) {
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  const auto exponent = *rc::gen::inRange<std::uint64_t>(1023 - 160, 1023 + 135);
  // Random fraction and sign bits, with an exponent in the range of float32.
  const auto value = std::bit_cast<double>((bits & 0x800fffffffffffffULL) | (exponent << 52));
  RC_ASSERT(nearest_float(Field(value)) == static_cast<float>(value));
}

RC_GTEST_PROP(Enclosure, IsTheDoubleItselfOrItsNeighbours, ()) {
  const auto p = *rc::gen::inRange<long>(-1000000, 1000000);
  const auto q = *rc::gen::inRange<long>(1, 1000000);
  const records::Enclosure e = enclose(ratio(p, q));
  RC_ASSERT(Field(e.lo) <= ratio(p, q));
  RC_ASSERT(Field(e.hi) >= ratio(p, q));
  const bool is_tight = e.lo == e.hi || std::nextafter(e.lo, 1e300) == e.hi;
  RC_ASSERT(is_tight);
  RC_ASSERT((e.lo == e.hi) == (Field(e.lo) == ratio(p, q)));
}

RC_GTEST_PROP(Enclosure, OfARootHoldsItsSquare, ()) {
  const auto p = *rc::gen::inRange<long>(0, 1000000);
  const auto q = *rc::gen::inRange<long>(1, 1000000);
  const records::Enclosure e = enclose_sqrt(ratio(p, q));
  RC_ASSERT(Field(e.lo) * Field(e.lo) <= ratio(p, q));
  RC_ASSERT(Field(e.hi) * Field(e.hi) >= ratio(p, q));
  RC_ASSERT(e.hi <= std::nextafter(e.lo, 1e300));
}

TEST(Enclosure, OfALogarithmIsExactForPowersOfTwo) {
  EXPECT_EQ(enclose_log2(Field(8)), (records::Enclosure{3, 3}));
  const records::Enclosure third = enclose_log2(ratio(1, 3));
  EXPECT_LT(third.lo, third.hi);  // irrational
  EXPECT_NEAR(third.lo, -1.584962500721156, 0x1p-51);
}

}  // namespace
}  // namespace rastercheck::oracle::number_test
