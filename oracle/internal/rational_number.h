#pragma once

#include <memory>
#include <utility>

#include "oracle/internal/number.h"
#include "oracle/rational.h"

namespace rastercheck::oracle {

struct Rational::Number {
  Field value;
};

inline Rational to_rational(Field value) {
  return Rational(std::make_shared<const Rational::Number>(Rational::Number{std::move(value)}));
}

inline const Field& to_field(const Rational& rational) { return rational.number().value; }

}  // namespace rastercheck::oracle
