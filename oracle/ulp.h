#pragma once

// Errors of computed float32 values against exact ones, in units in the last place (RULES §5).
//
//   ulp(x) = 2^(max(floor(log2|x|), −126) − 23), ulp(0) = 2^−149
//   error  = (computed − exact) / ulp, signed and fractional
//
// Near a zero of the exact value its own ulp shrinks without bound while the inputs' rounding does
// not: `local` errors say how many bits of the result are right, `scale` errors (measured in the
// ulp of the largest vertex value) how well the interpolation was done. Bounds are stated in the
// latter.

#include "oracle/rational.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// ulp(x) of float32, as an exact power of two.
Rational ulp(const Rational& x);

/// (computed − exact) / ulp(exact), certified. `computed` is finite.
records::Enclosure local_ulp_error(float computed, const Rational& exact);

/// (computed − exact) / ulp(max(|exact|, magnitude)), certified. `magnitude` is max |r_i| of an
/// attribute's vertex values, or max(|n|, |f|) of a depth. `computed` is finite.
records::Enclosure scale_ulp_error(float computed, const Rational& exact,
                                   const Rational& magnitude);

}  // namespace rastercheck::oracle
