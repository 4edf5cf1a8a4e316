#pragma once

// Errors in ULP (RULES §5) as exact numbers, evaluated only as precisely as a question needs:
//
//   (f − n/d) / 2^k  =  (f d − n) / (d 2^k),      d > 0,  2^k = ulp(max(|n/d|, magnitude))
//
// Numerator and denominator stay in the ring. A quotient is first formed in doubles, certified by
// the conversion's own bounds. It is formed exactly only if doubles leave a question open.

#include <optional>

#include "oracle/internal/number.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// An exact value; the denominator is positive.
struct Fraction {
  Ring numerator{0};
  Ring denominator{1};

  Field value() const { return quotient(numerator, denominator); }
};

/// A closed interval of exact values.
struct FractionRange {
  Fraction lo;
  Fraction hi;
};

/// The smallest range that holds both; either may be missing.
std::optional<FractionRange> hull(const std::optional<FractionRange>& a,
                                  const std::optional<FractionRange>& b);

/// Converts a computed value, which must not be NaN, exactly; ±infinity becomes ±2^128.
Ring computed_ring(float computed);

/// The sign of computed − exact.
int compare(const Ring& computed, const Fraction& exact);
/// The sign of a − b.
int compare(const Fraction& a, const Fraction& b);
/// The smaller and the larger of two; the first if equal.
Fraction least(const Fraction& a, const Fraction& b);
Fraction greatest(const Fraction& a, const Fraction& b);

/// The sum of two; over their common denominator, if it is one number.
Fraction sum(const Fraction& a, const Fraction& b);

/// Certified doubles around n/d, a few units in the last place apart.
records::Enclosure enclose(const Fraction& value);

/// The exponent that scale ULP are based on: floor(log2(magnitude)); empty for magnitude 0.
using ScaleExponent = std::optional<long>;
ScaleExponent scale_exponent(const Ring& magnitude);

class UlpError {
 public:
  /// An error of 0, for a value within a range that the contract leaves open.
  UlpError() = default;
  UlpError(const Ring& computed, Fraction exact, const ScaleExponent& scale);

  bool is_zero() const { return sign_of(difference_) == 0; }
  /// Certified, a few units in the last place wide; [0, 0] exactly if the error is zero.
  records::Enclosure enclosure() const;
  /// The error itself.
  Field value() const;
  /// The exact value that the error refers to.
  const Fraction& exact() const { return exact_; }

 private:
  Fraction exact_;
  Ring difference_{0};  ///< (f d − n)
  long ulp_exponent_ = 0;
};

}  // namespace rastercheck::oracle
