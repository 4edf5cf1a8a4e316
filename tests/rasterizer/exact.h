#pragma once

// GMP's rationals, with which the tests compare the rasterizer's arithmetic and which share nothing
// with that arithmetic; and random numbers of every size.

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

namespace rastercheck::rasterizer {

using Rational = mpq_class;

/// 2^exponent.
inline Rational power_of_two(int exponent) {
  Rational power = 1;
  if (exponent >= 0) {
    mpq_mul_2exp(power.get_mpq_t(), power.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(power.get_mpq_t(), power.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return power;
}

/// floor(log2 |x|); x is not 0.
inline int floor_log2(const Rational& x) {
  const Rational size = abs(x);
  // The lengths of numerator and denominator in bits determine the result up to one.
  const int guess = static_cast<int>(mpz_sizeinbase(size.get_num_mpz_t(), 2)) -
                    static_cast<int>(mpz_sizeinbase(size.get_den_mpz_t(), 2));
  return size < power_of_two(guess) ? guess - 1 : guess;
}

/// The unit in the last place of float32 at x (by the project's RULES, 2^-149 at 0).
inline Rational float_ulp(const Rational& x) {
  return power_of_two((x == 0 ? -126 : std::max(floor_log2(x), -126)) - 23);
}

/// Random numbers, the same in every run.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// An integer from low to high, both included.
  int between(int low, int high) {
    const auto choices = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<int>(engine_() % choices);
  }
  bool one_in(int n) { return between(1, n) == 1; }

  template <typename T>
  T pick(std::initializer_list<T> choices) {
    return choices.begin()[between(0, static_cast<int>(choices.size()) - 1)];
  }

  /// A double of either sign with at most this many significant bits and an exponent in this range.
  double number(int bits, int low_exponent, int high_exponent) {
    const double fraction = static_cast<double>(engine_() >> (64 - bits) | 1);
    const double value = std::ldexp(fraction, between(low_exponent, high_exponent) - bits + 1);
    return one_in(2) ? value : -value;
  }

  /// A float, sometimes 0; subnormal if the exponent is.
  float real(int low_exponent, int high_exponent) {
    if (one_in(16)) return 0;
    return static_cast<float>(number(one_in(4) ? 3 : 24, low_exponent, high_exponent));
  }

  /// A finite float of any size.
  float any_real() { return real(-149, 126); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace rastercheck::rasterizer
