#include "oracle/judged_number.h"

#include <cmath>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/rational_number.h"

namespace rastercheck::oracle {
namespace {

using records::FragmentClass;

/// True if a result that may differ from `exact` by `allowed` may round to infinity of this sign.
bool is_infinite(const Field& exact, const Field& allowed, bool is_negative) {
  // Magnitudes of at least 2^128 − 2^103 (half an ulp below 2^128) round to infinity.
  const Field least = Field(0x1p128) - Field(0x1p103) - allowed;
  return (is_negative ? Field(-exact) : exact) >= least;
}

}  // namespace

JudgedNumber judge_number(const Rational& exact, const Rational& allowed, float f) {
  const Field& value = to_field(exact);
  const Field& beyond = to_field(allowed);
  JudgedNumber judged;
  judged.exact = exact;
  if (std::isnan(f)) {
    judged.fragment_class = FragmentClass::not_a_number;
    return judged;
  }
  if (std::isinf(f)) {
    if (!is_infinite(value, beyond, std::signbit(f))) {
      judged.fragment_class = FragmentClass::infinite;
    }
    return judged;
  }
  const int exponent = ulp_exponent(f);
  const Field half_ulp = power_of_two(exponent - 1);
  const Field error = exact_field(f) - value;
  const Field bound = beyond + half_ulp;
  if (bound < magnitude(error)) judged.fragment_class = FragmentClass::beyond_bound;
  const Field per_ulp = power_of_two(-exponent);
  judged.error = enclose(Field(error * per_ulp));
  judged.bound = enclose(Field(bound * per_ulp));
  judged.is_cancelled = half_ulp < beyond;
  return judged;
}

}  // namespace rastercheck::oracle
