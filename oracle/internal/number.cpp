#include "oracle/internal/number.h"

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rastercheck::oracle {
namespace {

/// An integer with GMP's lifetime rules wrapped up.
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

/// An MPFR number that an exact value is rounded into, in a given direction. 64 bits are enough:
/// every result is rounded once more, in the same direction, into a double, and rounding twice in
/// one direction is still a bound. Where a double holds the value, 64 bits hold it too, so that
/// both directions give that double.
class Rounded {
 public:
  Rounded(const Field& value, mpfr_rnd_t direction) : direction_(direction) {
    mpfr_init2(value_, 64);
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
  constexpr long kLeastExponent = std::numeric_limits<float>::min_exponent - 1;  // −126
  constexpr long kFractionBits = std::numeric_limits<float>::digits - 1;         // 23
  const long exponent = floor_log2(value);
  if (exponent > std::numeric_limits<float>::max_exponent) {
    return std::copysign(std::numeric_limits<float>::infinity(),
                         static_cast<float>(sign_of(value)));
  }
  const long ulp_exponent = std::max(exponent, kLeastExponent) - kFractionBits;
  const Field in_ulps = magnitude(value) * power_of_two(-ulp_exponent);
  long count = floor_to_long(in_ulps);
  const Field rest = in_ulps - Field(count);
  const Field half = Field(1, 2);
  if (rest > half || (rest == half && count % 2 != 0)) ++count;
  // count <= 2^24, so the double is exact; it is a float32, or 2^128, which converts to infinity.
  const double rounded = std::ldexp(static_cast<double>(count), static_cast<int>(ulp_exponent));
  const float nearest = rounded > double{std::numeric_limits<float>::max()}
                            ? std::numeric_limits<float>::infinity()
                            : static_cast<float>(rounded);
  return sign_of(value) < 0 ? -nearest : nearest;
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

std::optional<FieldRange> hull(const std::optional<FieldRange>& a,
                               const std::optional<FieldRange>& b) {
  if (!a) return b;
  if (!b) return a;
  return FieldRange{std::min(a->lo, b->lo), std::max(a->hi, b->hi)};
}

}  // namespace rastercheck::oracle
