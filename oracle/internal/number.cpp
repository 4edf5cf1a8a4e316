#include "oracle/internal/number.h"

#include <mpfr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "oracle/internal/float_ulp.h"

namespace rastercheck::oracle {
namespace {

constexpr std::uint32_t kFractionMask = (1U << kFractionBits) - 1;
constexpr std::uint32_t kSignBit = 1U << 31;
constexpr std::uint32_t kInfinityBits = 0xffU << kFractionBits;

/// A GMP integer that frees itself.
class Integer {
 public:
  Integer() { mpz_init(value_); }
  Integer(const Integer&) = delete;
  Integer& operator=(const Integer&) = delete;
  ~Integer() { mpz_clear(value_); }
  mpz_ptr get() { return value_; }

 private:
  mpz_t value_;
};

/// An exact value rounded to an MPFR number in a given direction. Every result is rounded again, in
/// the same direction, to a double. Rounding twice in one direction still gives a bound, and for
/// the value itself the tightest one. A function of the rounded value differs from the function of
/// the exact value by a few units in the last of kBits bits; if a double lies between the two
/// results, the bound is one double wider than necessary. For square roots of p/q with p, q < 2^60
/// this does not happen: a double d is either the root itself, or d² differs from p/q by at least
/// 2^-(2·53 + 60) relative, which is more than the error in kBits bits. If a double holds the
/// result, kBits bits hold it as well, and both directions give that double.
class Rounded {
 public:
  static constexpr mpfr_prec_t kBits = 192;

  Rounded(const Field& value, mpfr_rnd_t direction) : direction_(direction) {
    mpfr_init2(value_, kBits);
    mpfr_set_q(value_, value.mpq(), direction);
  }
  Rounded(const Rounded&) = delete;
  Rounded& operator=(const Rounded&) = delete;
  ~Rounded() { mpfr_clear(value_); }

  /// Both functions are increasing, so a bound of the argument gives a bound of the result.
  Rounded& sqrt() {
    mpfr_sqrt(value_, value_, direction_);
    return *this;
  }
  Rounded& log2() {
    mpfr_log2(value_, value_, direction_);
    return *this;
  }
  double to_double() const { return mpfr_get_d(value_, direction_); }

 private:
  mpfr_t value_;
  mpfr_rnd_t direction_;
};

}  // namespace

/// Converts a subnormal by its bits: an integer times 2^-149, which no mode of the processor
/// flushes.
double exact_double(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const bool is_subnormal_or_zero = (bits & ~kSignBit) <= kFractionMask;
  if (!is_subnormal_or_zero) return double{value};
  const double magnitude = static_cast<double>(bits & kFractionMask) * 0x1p-149;
  return (bits & kSignBit) != 0 ? -magnitude : magnitude;
}

Ring exact_ring(float value) { return {exact_double(value)}; }

Field exact_field(float value) { return {exact_double(value)}; }

int sign_of(const Ring& value) { return static_cast<int>(value.sign()); }

int sign_of(const Field& value) { return mpq_sgn(value.mpq()); }

Ring magnitude(const Ring& value) { return sign_of(value) < 0 ? -value : value; }

Field magnitude(const Field& value) { return sign_of(value) < 0 ? -value : value; }

Field quotient(const Ring& numerator, const Ring& denominator) {
  return Field(numerator) / Field(denominator);
}

Field power_of_two(long exponent) {
  Field result(1);
  if (exponent >= 0) {
    mpq_mul_2exp(result.mpq(), result.mpq(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(result.mpq(), result.mpq(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return result;
}

Field floor_of(const Field& value) {
  Field result(0);
  mpz_fdiv_q(mpq_numref(result.mpq()), mpq_numref(value.mpq()), mpq_denref(value.mpq()));
  return result;
}

long floor_to_long(const Field& value) {
  Integer result;
  mpz_fdiv_q(result.get(), mpq_numref(value.mpq()), mpq_denref(value.mpq()));
  return mpz_get_si(result.get());
}

long ceil_to_long(const Field& value) { return -floor_to_long(-value); }

long floor_log2(const Field& value) {
  // With n in [2^(a-1), 2^a) and d in [2^(b-1), 2^b), n/d lies in (2^(a-b-1), 2^(a-b+1)).
  const auto bits = [](mpz_srcptr z) { return static_cast<long>(mpz_sizeinbase(z, 2)); };
  const long guess = bits(mpq_numref(value.mpq())) - bits(mpq_denref(value.mpq()));
  return magnitude(value) < power_of_two(guess) ? guess - 1 : guess;
}

float nearest_float(const Field& value) {
  if (sign_of(value) == 0) return 0;
  const std::uint32_t sign = sign_of(value) < 0 ? kSignBit : 0;
  const long exponent = floor_log2(value);
  if (exponent > std::numeric_limits<float>::max_exponent) {
    return std::bit_cast<float>(sign | kInfinityBits);
  }
  const long ulp_exponent = ulp_exponent_at(exponent);
  const Field in_ulps = magnitude(value) * power_of_two(-ulp_exponent);
  long count = floor_to_long(in_ulps);
  const Field rest = in_ulps - Field(count);
  const Field half = Field(1, 2);
  if (rest > half || (rest == half && count % 2 != 0)) ++count;
  // A count below 2^23 is a subnormal's fraction. From 2^23 on, its leading bit adds one to the
  // exponent field, which therefore counts from 2^-149; a count of 2^24 carries into the next
  // exponent, and after the last one into infinity.
  const auto exponent_field = static_cast<std::uint32_t>(ulp_exponent - kLeastUlpExponent);
  const auto bits = std::min((exponent_field << kFractionBits) + static_cast<std::uint32_t>(count),
                             kInfinityBits);
  return std::bit_cast<float>(sign | bits);
}

records::Enclosure enclose(const Ring& value) {
  // CGAL's to_interval() puts any number of more than one limb strictly between two doubles. Near
  // or below the least doubles its interval is wrong when rounding upwards: it multiplies by a
  // power of two that ldexp makes at least 2^-1074.
  const auto [lo, hi] = value.to_interval();
  if (lo > -0x1p-1000 && hi < 0x1p-1000 && sign_of(value) != 0) return enclose(Field(value));
  const auto is_at = [&value](double end) { return std::isfinite(end) && value == Ring(end); };
  if (lo == hi || is_at(lo)) return {lo, lo};
  if (is_at(hi)) return {hi, hi};
  return {lo, hi};
}

records::Enclosure enclose(const Field& value) {
  return {Rounded(value, MPFR_RNDD).to_double(), Rounded(value, MPFR_RNDU).to_double()};
}

records::Enclosure enclose_sqrt(const Field& value) {
  return {Rounded(value, MPFR_RNDD).sqrt().to_double(),
          Rounded(value, MPFR_RNDU).sqrt().to_double()};
}

records::Enclosure enclose_log2(const Field& value) {
  return {Rounded(value, MPFR_RNDD).log2().to_double(),
          Rounded(value, MPFR_RNDU).log2().to_double()};
}

bool has_normal_products(double near, const Ring& exact) {
  constexpr double kLeast = 0x1p-480;
  constexpr double kMost = 0x1p480;
  const double size = std::abs(near);
  return near == 0 ? sign_of(exact) == 0 : size > kLeast && size < kMost;
}

}  // namespace rastercheck::oracle
