#include "oracle/rational.h"

#include <cmath>

#include "oracle/internal/rational_number.h"

namespace rastercheck::oracle {

Rational::Rational(double value) : number_(std::make_shared<const Number>(Number{Field(value)})) {}

std::string Rational::to_string() const {
  const mpq_srcptr q = number_->value.mpq();
  // mpq_get_str() asks for this size: the digits, a sign, a slash and the terminating NUL.
  std::string text(mpz_sizeinbase(mpq_numref(q), 10) + mpz_sizeinbase(mpq_denref(q), 10) + 3, '\0');
  mpq_get_str(text.data(), 10, q);
  text.resize(text.find('\0'));
  return text;
}

records::Enclosure Rational::enclosure() const { return enclose(number_->value); }

double Rational::nearest_double() const {
  const records::Enclosure around = enclosure();
  if (!std::isfinite(around.lo)) return around.lo;
  if (!std::isfinite(around.hi)) return around.hi;
  const Field& value = number_->value;
  return value - Field(around.lo) <= Field(around.hi) - value ? around.lo : around.hi;
}

float Rational::nearest_float() const { return oracle::nearest_float(number_->value); }

std::strong_ordering Rational::operator<=>(const Rational& other) const {
  return mpq_cmp(number_->value.mpq(), other.number_->value.mpq()) <=> 0;
}

bool Rational::operator==(const Rational& other) const { return (*this <=> other) == 0; }

std::string to_string(const std::optional<ValueRange>& range) {
  if (!range) return "undefined";
  if (range->lo == range->hi) return range->lo.to_string();
  return "[" + range->lo.to_string() + ", " + range->hi.to_string() + "]";
}

}  // namespace rastercheck::oracle
