#pragma once

#include "oracle/internal/number.h"
#include "oracle/internal/values.h"
#include "oracle/rational.h"

namespace rastercheck::oracle {

struct Rational::Number {
  Field value;
};

inline Rational to_rational(Field value) {
  return Rational(std::make_shared<const Rational::Number>(Rational::Number{std::move(value)}));
}

inline const Field& to_field(const Rational& rational) { return rational.number().value; }

inline std::optional<ValueRange> to_public(const std::optional<OpenValue>& value) {
  if (!value) return std::nullopt;
  return ValueRange{to_rational(value->range.lo.value()), to_rational(value->range.hi.value()),
                    value->is_open};
}

}  // namespace rastercheck::oracle
