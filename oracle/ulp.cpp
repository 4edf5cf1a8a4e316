#include "oracle/ulp.h"

#include <algorithm>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/rational_number.h"

namespace rastercheck::oracle {
namespace {

Field ulp_of(const Field& x) {
  return power_of_two(sign_of(x) == 0 ? kLeastUlpExponent : ulp_exponent_at(floor_log2(x)));
}

records::Enclosure error_in(const Field& unit, float computed, const Field& exact) {
  return enclose((exact_field(computed) - exact) / unit);
}

}  // namespace

Rational ulp(const Rational& x) { return to_rational(ulp_of(to_field(x))); }

records::Enclosure local_ulp_error(float computed, const Rational& exact) {
  return error_in(ulp_of(to_field(exact)), computed, to_field(exact));
}

records::Enclosure scale_ulp_error(float computed, const Rational& exact,
                                   const Rational& magnitude) {
  const Field scale = std::max(oracle::magnitude(to_field(exact)), to_field(magnitude));
  return error_in(ulp_of(scale), computed, to_field(exact));
}

}  // namespace rastercheck::oracle
