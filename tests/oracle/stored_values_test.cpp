// Compares the values that floats are stored as with arithmetic that is exact in doubles, with long
// doubles, and with the float16 of OpenEXR.

#include "oracle/stored_values.h"

#include <gtest/gtest.h>
#include <half.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::stored_values_test {
namespace {

using cases::Storage;
using cases::StoreRounding;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool may_be_stored(Storage storage, StoreRounding rounding, float f, float value) {
  const auto numbers = numbers_stored_as(storage, rounding, value);
  return numbers && f >= numbers->least && f <= numbers->greatest;
}

/// A number around [0, 1], often on or beside a border between two codes.
float number_near_codes(int greatest) {
  const int k = *rc::gen::inRange(-1, 2 * greatest + 3);
  const double border = k / 2.0 / greatest;
  auto f = static_cast<float>(border);
  for (int i = *rc::gen::inRange(-3, 4); i > 0; --i) f = std::nextafter(f, 2.0F);
  return *rc::gen::inRange(0, 4) == 0 ? ordinary_float(2) : f;
}

// 0.5 · 255 = 127.5, so both neighbours are nearest. 1.5/255 lies between codes 1 and 2.
TEST(StoredValues, MiddlesOfUnorm8AreStoredAsEitherNeighbour) {
  for (const float code : {127.0F, 128.0F}) {
    EXPECT_TRUE(may_be_stored(Storage::unorm8, StoreRounding::nearest, 0.5F, code));
  }
  EXPECT_FALSE(may_be_stored(Storage::unorm8, StoreRounding::nearest, 0.5F, 126));
  EXPECT_FALSE(may_be_stored(Storage::unorm8, StoreRounding::either, 0.5F, 129));
  EXPECT_FALSE(may_be_stored(Storage::unorm8, StoreRounding::nearest, 0.25F, 63));
  EXPECT_TRUE(may_be_stored(Storage::unorm8, StoreRounding::either, 0.25F, 63));  // 63.75
}

TEST(StoredValues, NumbersBeyondTheEndsAreStoredAsTheEnds) {
  for (const Storage storage : {Storage::unorm8, Storage::unorm16, Storage::srgb8}) {
    const float greatest = storage == Storage::unorm16 ? 65535 : 255;
    EXPECT_TRUE(may_be_stored(storage, StoreRounding::nearest, -kInfinity, 0));
    EXPECT_TRUE(may_be_stored(storage, StoreRounding::nearest, kInfinity, greatest));
    EXPECT_FALSE(may_be_stored(storage, StoreRounding::nearest, 1, greatest - 1));
    EXPECT_FALSE(may_be_stored(storage, StoreRounding::either, 0, 1));
    EXPECT_FALSE(numbers_stored_as(storage, StoreRounding::nearest, greatest + 1));
    EXPECT_FALSE(numbers_stored_as(storage, StoreRounding::nearest, 0.5F));
    EXPECT_FALSE(numbers_stored_as(storage, StoreRounding::nearest, std::nanf("")));
  }
}

// IEC 61966-2-1 gives linear 0.2140 for 127.5/255, and 0.5 for 187.516/255.
TEST(StoredValues, SrgbFollowsItsTransferFunction) {
  EXPECT_TRUE(may_be_stored(Storage::srgb8, StoreRounding::nearest, 0.5F, 188));
  EXPECT_FALSE(may_be_stored(Storage::srgb8, StoreRounding::nearest, 0.5F, 187));
  EXPECT_TRUE(may_be_stored(Storage::srgb8, StoreRounding::either, 0.5F, 187));
  EXPECT_TRUE(may_be_stored(Storage::srgb8, StoreRounding::nearest, 0.2140F, 127));
  EXPECT_TRUE(may_be_stored(Storage::srgb8, StoreRounding::nearest, 0.2142F, 128));
  EXPECT_TRUE(may_be_stored(Storage::srgb8, StoreRounding::nearest, 0x1p-10F, 3));  // 3.217
}

// The product with 255 or 65535 is exact in double. Kills: truncation, rounding of the sum alone.
RC_GTEST_PROP(StoredValues, UnormIsRightWhereDoublesSaySo, ()) {
  const auto storage = one_of({Storage::unorm8, Storage::unorm16});
  const int greatest = storage == Storage::unorm8 ? 255 : 65535;
  const float f = number_near_codes(greatest);
  const double product = std::clamp(double{f} * greatest, -1.0, greatest + 1.0);
  for (int step = -2; step <= 2; ++step) {
    const int k = static_cast<int>(std::lround(product)) + step;
    if (k < 0 || k > greatest) continue;
    const double distance = k == 0          ? std::max(product - k, 0.0)
                            : k == greatest ? std::max(k - product, 0.0)
                                            : std::abs(product - k);
    const auto code = static_cast<float>(k);
    RC_ASSERT(may_be_stored(storage, StoreRounding::nearest, f, code) ==
              (distance <= 0.5 + 0x1p-23 * (k + 1)));
    RC_ASSERT(may_be_stored(storage, StoreRounding::either, f, code) == (distance < 1));
  }
}

// Long doubles are within 2^-50 of the encoded number; closer borders are left out.
RC_GTEST_PROP(StoredValues, SrgbIsRightWhereLongDoublesSaySo, ()) {
  const float f = std::abs(ordinary_float(1));
  const long double linear = f;
  const long double encoded =
      linear <= 0.0031308L ? linear * 12.92L : 1.055L * std::pow(linear, 1 / 2.4L) - 0.055L;
  const long double product = encoded * 255;
  for (int k = 0; k <= 255; ++k) {
    const long double beyond =
        std::abs(product - static_cast<long double>(k)) - (0.5L + 0x1p-21L * (k + 1));
    if (std::abs(beyond) < 0x1p-30L) continue;
    const bool is_end = (k == 0 && product < 0.5L) || (k == 255 && product > 254.5L);
    RC_ASSERT(may_be_stored(Storage::srgb8, StoreRounding::nearest, f, static_cast<float>(k)) ==
              (is_end || beyond < 0));
  }
}

// Kills: float16 without subnormals, ties that only one neighbour takes, a wrong overflow.
RC_GTEST_PROP(StoredValues, Float16IsWhatOpenExrsTypeHolds, ()) {
  const float f = *rc::gen::arbitrary<bool>() ? any_float() : ordinary_float(70000);
  const Imath::half stored(f);
  RC_ASSERT(may_be_stored(Storage::float16, StoreRounding::nearest, f, stored));
  RC_ASSERT(may_be_stored(Storage::float16, StoreRounding::either, f, stored));
  for (const bool up : {false, true}) {
    const float next = next_stored(Storage::float16, stored, up);
    if (next == float{stored}) continue;
    const bool is_tie =
        std::abs(double{f} - next) == std::abs(double{f} - float{stored}) || std::abs(f) == 65520;
    RC_ASSERT(may_be_stored(Storage::float16, StoreRounding::nearest, f, next) == is_tie);
    RC_ASSERT(float{Imath::half(next)} == next);
  }
}

// Kills: a range that leaves out its ends, or reaches beyond them.
RC_GTEST_PROP(StoredValues, ARangeHasTheValuesOfItsNumbers, ()) {
  const auto storage = one_of({Storage::unorm8, Storage::srgb8});
  const auto rounding = one_of({StoreRounding::nearest, StoreRounding::either});
  const double a = number_near_codes(255);
  const double b = *rc::gen::arbitrary<bool>() ? a : double{number_near_codes(255)};
  const records::Enclosure range{std::min(a, b), std::max(a, b)};
  const StoredNumbers found = values_stored_of(storage, rounding, range);
  for (float code = 0; code <= 255; ++code) {
    const StoredNumbers numbers = *numbers_stored_as(storage, rounding, code);
    const bool is_stored =
        double{numbers.least} <= range.hi && double{numbers.greatest} >= range.lo;
    RC_ASSERT(is_stored == (code >= found.least && code <= found.greatest));
  }
}

RC_GTEST_PROP(StoredValues, StepsAreCountedAsTheyAreTaken, ()) {
  const auto storage =
      one_of({Storage::float32, Storage::float16, Storage::unorm8, Storage::unorm16});
  const bool is_integer = storage == Storage::unorm8 || storage == Storage::unorm16;
  const float from = is_integer ? static_cast<float>(*rc::gen::inRange(0, 250))
                                : float{Imath::half(ordinary_float(4))};
  float to = from;
  const int steps = *rc::gen::inRange(0, 5);
  for (int i = 0; i < steps; ++i) to = next_stored(storage, to, true);
  RC_ASSERT(steps_between(storage, from, to) == steps);
  RC_ASSERT(steps_between(storage, to, from) == -steps);
}

}  // namespace
}  // namespace rastercheck::oracle::stored_values_test
