#include "oracle/stored_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "oracle/internal/number.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/stored_depth.h"

namespace rastercheck::oracle {
namespace {

using cases::Storage;
using cases::StoreRounding;

constexpr float kInfiniteFloat = std::numeric_limits<float>::infinity();
constexpr float kGreatestHalf = 65504;

bool is_code(Storage storage) {
  return storage == Storage::unorm8 || storage == Storage::unorm16 || storage == Storage::srgb8;
}

int greatest_code(Storage storage) { return storage == Storage::unorm16 ? 65535 : 255; }

Field fraction_of(long numerator, long denominator) {
  return quotient(Ring(static_cast<double>(numerator)), Ring(static_cast<double>(denominator)));
}

Field power(const Field& base, int exponent) {
  Field product(1);
  for (; exponent > 0; --exponent) product *= base;
  return product;
}

// --- Codes ---------------------------------------------------------------------------------------

/// The side of a code on which a limit lies.
enum class Side { lower, upper };

/// The limit, on the given side, of the numbers that may be stored as `code`: the encoded number
/// times 2^n − 1.
Field limit_of_code(Storage storage, StoreRounding rounding, int code, Side side) {
  const Field k(code);
  const int sign = side == Side::upper ? 1 : -1;
  if (rounding == StoreRounding::either) return k + Field(sign);
  const Field slack = (k + Field(1)) * power_of_two(storage == Storage::srgb8 ? -21 : -23);
  return k + Field(sign) * (fraction_of(1, 2) + slack);
}

/// The sign of f − the number whose encoding is `encoded` (srgb8).
int compare_decoded(float f, const Field& encoded) {
  const Field number = exact_field(f);
  if (encoded <= fraction_of(4045, 100000)) {
    return sign_of(Field(number - encoded * fraction_of(100, 1292)));
  }
  const Field base = (encoded + fraction_of(55, 1000)) * fraction_of(1000, 1055);
  // Both sides are monotone, and odd powers keep the sign.
  return sign_of(Field(power(number, 5) - power(base, 12)));
}

/// The sign of f − the number whose encoding is limit/(2^n − 1).
int compare_with_limit(Storage storage, float f, const Field& limit) {
  if (storage == Storage::srgb8) return compare_decoded(f, limit * fraction_of(1, 255));
  return sign_of(Field(exact_field(f) * Field(greatest_code(storage)) - limit));
}

/// The float nearest to a limit among the floats on its inner side. The limit itself is included
/// unless `is_strict`.
float float_within(Storage storage, const Field& limit, Side side, bool is_strict) {
  const double encoded = enclose(limit).lo / greatest_code(storage);
  const double near = storage != Storage::srgb8 ? encoded
                      : encoded <= 0.04045      ? encoded / 12.92
                                                : std::pow((encoded + 0.055) / 1.055, 2.4);
  auto f = static_cast<float>(near);
  const float inwards = side == Side::upper ? -kInfiniteFloat : kInfiniteFloat;
  const int inner = side == Side::upper ? -1 : 1;
  const auto is_within = [&](float one) {
    const int sign = compare_with_limit(storage, one, limit);
    return sign == inner || (sign == 0 && !is_strict);
  };
  while (!is_within(f)) f = std::nextafter(f, inwards);
  while (is_within(std::nextafter(f, -inwards))) f = std::nextafter(f, -inwards);
  return f;
}

StoredNumbers numbers_of_code(Storage storage, StoreRounding rounding, int code) {
  const bool is_strict = rounding == StoreRounding::either;
  StoredNumbers numbers{-kInfiniteFloat, kInfiniteFloat};
  if (code > 0) {
    numbers.least = float_within(storage, limit_of_code(storage, rounding, code, Side::lower),
                                 Side::lower, is_strict);
  }
  if (code < greatest_code(storage)) {
    numbers.greatest = float_within(storage, limit_of_code(storage, rounding, code, Side::upper),
                                    Side::upper, is_strict);
  }
  return numbers;
}

using CodeTable = std::array<StoredNumbers, 256>;

CodeTable make_table(Storage storage, StoreRounding rounding) {
  CodeTable table;
  for (int code = 0; code < 256; ++code) {
    table[static_cast<std::size_t>(code)] = numbers_of_code(storage, rounding, code);
  }
  return table;
}

/// The table of an 8-bit storage; made when first asked for.
const CodeTable& table_of(Storage storage, StoreRounding rounding) {
  if (storage == Storage::unorm8 && rounding == StoreRounding::nearest) {
    static const CodeTable kTable = make_table(Storage::unorm8, StoreRounding::nearest);
    return kTable;
  }
  if (storage == Storage::unorm8) {
    static const CodeTable kTable = make_table(Storage::unorm8, StoreRounding::either);
    return kTable;
  }
  if (rounding == StoreRounding::nearest) {
    static const CodeTable kTable = make_table(Storage::srgb8, StoreRounding::nearest);
    return kTable;
  }
  static const CodeTable kTable = make_table(Storage::srgb8, StoreRounding::either);
  return kTable;
}

/// numbers_of_code() for unorm16, in doubles that need no rounding: f · 65535 has 40 bits, and the
/// limits are multiples of 2^-23 below 2^17.
StoredNumbers numbers_of_unorm16(StoreRounding rounding, int code) {
  constexpr double kGreatest = 65535;
  const bool is_strict = rounding == StoreRounding::either;
  const double half = is_strict ? 1 : 0.5 + 0x1p-23 * (code + 1);
  const auto within = [&](Side side) {
    const double limit = side == Side::upper ? code + half : code - half;
    const float inwards = side == Side::upper ? -kInfiniteFloat : kInfiniteFloat;
    const auto is_within = [&](float f) {
      const double product = double{f} * kGreatest;
      if (product == limit) return !is_strict;
      return (product < limit) == (side == Side::upper);
    };
    auto f = static_cast<float>(limit / kGreatest);
    while (!is_within(f)) f = std::nextafter(f, inwards);
    while (is_within(std::nextafter(f, -inwards))) f = std::nextafter(f, -inwards);
    return f;
  };
  return {code > 0 ? within(Side::lower) : -kInfiniteFloat,
          code < kGreatest ? within(Side::upper) : kInfiniteFloat};
}

StoredNumbers numbers_of(Storage storage, StoreRounding rounding, int code) {
  if (storage == Storage::unorm16) return numbers_of_unorm16(rounding, code);
  return table_of(storage, rounding)[static_cast<std::size_t>(code)];
}

// --- float16 -------------------------------------------------------------------------------------

/// Half of the distance between a float16 and its neighbours of the same or a greater exponent.
float half_step(float half) {
  const int exponent = half == 0 ? -14 : std::max(std::ilogb(half), -14);
  return std::ldexp(1.0F, exponent - 11);
}

bool is_half(float value) {
  if (std::isinf(value)) return true;
  if (!(std::abs(value) <= kGreatestHalf)) return false;
  const float step = 2 * half_step(value);
  return std::fmod(value, step) == 0;
}

float next_half(float half, bool up) {
  if (std::isinf(half)) return (half > 0) == up ? half : std::copysign(kGreatestHalf, half);
  if (std::abs(half) == kGreatestHalf && (half > 0) == up)
    return std::copysign(kInfiniteFloat, half);
  if (half == 0) return up ? 0x1p-24F : -0x1p-24F;
  const bool grows = (half > 0) == up;
  // Below a power of two the step is that of the exponent below.
  const float at = grows ? half : std::nextafter(half, 0.0F);
  const float step = 2 * half_step(at);
  return up ? half + step : half - step;
}

StoredNumbers numbers_of_half(StoreRounding rounding, float half) {
  const float below = next_half(half, false);
  const float above = next_half(half, true);
  if (rounding == StoreRounding::either) {
    // An overflow may be rounded to the greatest number or to infinity.
    return {std::isinf(below) ? -kInfiniteFloat : std::nextafter(below, kInfiniteFloat),
            std::isinf(above) ? kInfiniteFloat : std::nextafter(above, -kInfiniteFloat)};
  }
  const auto middle = [](float a, float b) {
    constexpr float kOverflow = 65520;
    if (std::isinf(a) && std::isinf(b)) return a;
    if (std::isinf(a)) return std::copysign(kOverflow, a);
    if (std::isinf(b)) return std::copysign(kOverflow, b);
    return a + (b - a) / 2;
  };
  return {middle(half, below), middle(half, above)};
}

/// The greatest float16 that is at most f.
float half_below(float f) {
  if (std::isinf(f)) return f;
  if (f > kGreatestHalf) return kGreatestHalf;
  if (f < -kGreatestHalf) return -kInfiniteFloat;
  const float step = 2 * half_step(f);
  return std::floor(f / step) * step;
}

}  // namespace

std::optional<StoredNumbers> numbers_stored_as(Storage storage, StoreRounding rounding,
                                               float value) {
  if (std::isnan(value)) return std::nullopt;
  if (storage == Storage::float32) return StoredNumbers{value, value};
  if (storage == Storage::float16) {
    if (!is_half(value)) return std::nullopt;
    return numbers_of_half(rounding, value);
  }
  const auto greatest = static_cast<float>(greatest_code(storage));
  const bool is_code_of_it = value >= 0 && value <= greatest && value == std::floor(value);
  if (!is_code_of_it) return std::nullopt;
  return numbers_of(storage, rounding, static_cast<int>(value));
}

double number_of_stored(Storage storage, float value) {
  if (!is_code(storage)) return double{value};
  const double encoded = double{value} / greatest_code(storage);
  if (storage != Storage::srgb8) return encoded;
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

float next_stored(Storage storage, float value, bool up) {
  if (storage == Storage::float32)
    return std::nextafter(value, up ? kInfiniteFloat : -kInfiniteFloat);
  if (storage == Storage::float16) return next_half(value, up);
  return std::clamp(value + (up ? 1.0F : -1.0F), 0.0F, static_cast<float>(greatest_code(storage)));
}

namespace {

/// A stored value near a number, to begin a search with.
float stored_near(Storage storage, double number) {
  // Far beyond both ends of every integer storage.
  const double clamped = std::clamp(number, -2.0, 2.0);
  if (storage == Storage::float16) return half_below(static_cast<float>(number));
  const double encoded = storage != Storage::srgb8 ? clamped
                         : clamped <= 0.0031308    ? clamped * 12.92
                                                   : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
  const double greatest = greatest_code(storage);
  return static_cast<float>(std::clamp(std::round(encoded * greatest), 0.0, greatest));
}

/// Finds the outermost stored value that is not beyond a range's end, by steps from a value near
/// the end. `up` is true for the range's lower end; smaller values lie beyond this end.
template <typename IsBeyond>
float first_not(const IsBeyond& is_beyond, Storage storage, float value, bool up) {
  while (is_beyond(value)) value = next_stored(storage, value, up);
  while (true) {
    const float outer = next_stored(storage, value, !up);
    if (outer == value || is_beyond(outer)) return value;
    value = outer;
  }
}

}  // namespace

StoredNumbers values_stored_of(Storage storage, StoreRounding rounding,
                               const records::Enclosure& range) {
  if (storage == Storage::float32) {
    auto least = static_cast<float>(range.lo);
    auto greatest = static_cast<float>(range.hi);
    if (double{least} < range.lo) least = std::nextafter(least, kInfiniteFloat);
    if (double{greatest} > range.hi) greatest = std::nextafter(greatest, -kInfiniteFloat);
    // No float lies in a range that is too narrow: the neighbours then count.
    if (least > greatest) std::swap(least, greatest);
    return {least, greatest};
  }
  const auto numbers = [&](float value) { return *numbers_stored_as(storage, rounding, value); };
  const auto is_below = [&](float value) { return double{numbers(value).greatest} < range.lo; };
  const auto is_above = [&](float value) { return double{numbers(value).least} > range.hi; };
  return {first_not(is_below, storage, stored_near(storage, range.lo), true),
          first_not(is_above, storage, stored_near(storage, range.hi), false)};
}

double steps_between(Storage storage, float from, float to) {
  if (is_code(storage)) return double{to} - double{from};
  const auto rank = [](float f) {
    const auto bits = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(std::abs(f)));
    return std::signbit(f) ? -bits : bits;
  };
  if (storage == Storage::float32) return static_cast<double>(rank(to) - rank(from));
  // Between two powers of two, float16 has 2^10 numbers and float32 has 2^23, so ranks differ by a
  // factor of 2^13. Subnormal float16 numbers are multiples of 2^-24.
  const auto half_rank = [&rank](float f) {
    if (std::isinf(f)) f = std::copysign(65536.0F, f);  // the number after the greatest
    if (std::abs(f) < 0x1p-14F) return double{f} * 0x1p24;
    const double above = static_cast<double>(rank(std::abs(f)) - rank(0x1p-14F)) * 0x1p-13 + 1024;
    return f < 0 ? -above : above;
  };
  return half_rank(to) - half_rank(from);
}

float stored_depth(const Rational& depth, cases::DepthFormat format) {
  const int bits = cases::unorm_bits(format);
  if (bits == 0) return depth.nearest_float();
  const Field half = Field(1) / Field(2);
  const Field steps = std::clamp(to_field(depth), Field(0), Field(1)) * Field(steps_of(bits));
  return stored_float(static_cast<double>(floor_to_long(steps + half)), bits);
}

}  // namespace rastercheck::oracle
