#pragma once

// Errors of computed float32 values against exact ones, in units in the last place (RULES §5).
//
//   ulp(x) = 2^(max(floor(log2|x|), −126) − 23), ulp(0) = 2^−149
//   error  = (computed − exact) / ulp, signed and fractional
//
// Two units, because the ulp of the exact value shrinks without bound near zero while the rounding
// of the inputs does not: `local` errors use the ulp of the exact value and say how many bits of
// the result are right; `scale` errors use the ulp of the largest vertex value and say how accurate
// the interpolation was. Contracts state their bounds in scale ULP.

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
