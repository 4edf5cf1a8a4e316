#include "oracle/internal/ulp_error.h"

#include <cmath>
#include <limits>

#include "oracle/internal/float_ulp.h"

namespace rastercheck::oracle {
namespace {

/// The value that an infinity counts as: the number after the largest float32.
constexpr double kBeyondFloat = 0x1p128;

Ring ring_power_of_two(long exponent) { return {std::ldexp(1.0, static_cast<int>(exponent))}; }

/// The exponent of ulp(max(|exact|, magnitude)).
long ulp_exponent(const Fraction& exact, const ScaleExponent& scale) {
  const Ring size = magnitude(exact.numerator);
  long exponent = scale.value_or(kLeastExponent);
  // The magnitude is below 2^(exponent + 1), so an exact value below 2^(exponent + 1) does not
  // change the exponent.
  if (size >= exact.denominator * ring_power_of_two(exponent + 1)) {
    exponent = floor_log2(quotient(size, exact.denominator));
  }
  return ulp_exponent_at(exponent);
}

/// Computes doubles around n/d from doubles around n and d. The division is faithful in every
/// rounding mode, so one step to either side certifies it. Empty if the quotient comes near the
/// ends of the doubles' range, or if a rounded number is not normal.
std::optional<records::Enclosure> quick_quotient(const Ring& n, const Ring& d) {
  constexpr double kLeast = 0x1p-960;
  constexpr double kMost = 0x1p960;
  const auto [n_lo, n_hi] = n.to_interval();
  const auto [d_lo, d_hi] = d.to_interval();
  const auto is_normal = [](double x) { return std::abs(x) > kLeast && std::abs(x) < kMost; };
  if (!is_normal(n_lo) || !is_normal(n_hi) || !is_normal(d_lo) || !is_normal(d_hi)) {
    return std::nullopt;
  }
  const double lo = n_lo / (n_lo > 0 ? d_hi : d_lo);
  const double hi = n_hi / (n_hi > 0 ? d_lo : d_hi);
  if (!is_normal(lo) || !is_normal(hi)) return std::nullopt;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return records::Enclosure{std::nextafter(lo, -kInfinity), std::nextafter(hi, kInfinity)};
}

}  // namespace

Ring computed_ring(float computed) {
  if (std::isinf(computed)) return {computed > 0 ? kBeyondFloat : -kBeyondFloat};
  return exact_ring(computed);
}

std::optional<FractionRange> hull(const std::optional<FractionRange>& a,
                                  const std::optional<FractionRange>& b) {
  if (!a || !b) return a ? a : b;
  return FractionRange{least(a->lo, b->lo), greatest(a->hi, b->hi)};
}

Fraction least(const Fraction& a, const Fraction& b) { return compare(b, a) < 0 ? b : a; }

Fraction greatest(const Fraction& a, const Fraction& b) { return compare(a, b) < 0 ? b : a; }

Fraction sum(const Fraction& a, const Fraction& b) {
  if (a.denominator == b.denominator) return {a.numerator + b.numerator, a.denominator};
  return {a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator};
}

int compare(const Ring& computed, const Fraction& exact) {
  return sign_of(computed * exact.denominator - exact.numerator);
}

int compare(const Fraction& a, const Fraction& b) {
  return sign_of(a.numerator * b.denominator - b.numerator * a.denominator);
}

records::Enclosure enclose(const Fraction& value) {
  if (sign_of(value.numerator) == 0) return {0, 0};
  if (const auto quick = quick_quotient(value.numerator, value.denominator)) return *quick;
  return enclose(value.value());
}

ScaleExponent scale_exponent(const Ring& magnitude) {
  if (sign_of(magnitude) == 0) return std::nullopt;
  return floor_log2(Field(magnitude));
}

UlpError::UlpError(const Ring& computed, Fraction exact, const ScaleExponent& scale)
    : exact_(std::move(exact)),
      difference_(computed * exact_.denominator - exact_.numerator),
      ulp_exponent_(ulp_exponent(exact_, scale)) {}

records::Enclosure UlpError::enclosure() const {
  if (is_zero()) return {0, 0};
  return enclose(Fraction{difference_, exact_.denominator * ring_power_of_two(ulp_exponent_)});
}

Field UlpError::value() const {
  return quotient(difference_, exact_.denominator * ring_power_of_two(ulp_exponent_));
}

}  // namespace rastercheck::oracle
