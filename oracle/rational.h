#pragma once

#include <compare>
#include <memory>
#include <optional>
#include <string>

#include "records/enclosure.h"

namespace rastercheck::oracle {

/// An exact rational number, in lowest terms; immutable and cheap to copy.
class Rational {
 public:
  /// The number type the oracle computes with; defined inside the oracle only.
  struct Number;

  /// Converts `value`, which must be finite, exactly.
  explicit Rational(double value = 0);
  explicit Rational(std::shared_ptr<const Number> number) : number_(std::move(number)) {}

  /// "p/q", or "p" if q = 1.
  std::string to_string() const;
  /// The closest doubles around the value; both are equal if a double holds the value exactly.
  records::Enclosure enclosure() const;
  /// The double nearest to the value; a tie goes to the smaller one; ±infinity beyond the doubles.
  double nearest_double() const;
  /// The float32 nearest to the value, ties to even; ±infinity beyond float32.
  float nearest_float() const;

  std::strong_ordering operator<=>(const Rational& other) const;
  bool operator==(const Rational& other) const;

  const Number& number() const { return *number_; }

 private:
  std::shared_ptr<const Number> number_;
};

/// A closed range of exact values: all that the rules allow for the depth or an attribute of a
/// fragment. `is_open` marks a value that the rules leave open, even if both ends happen to be
/// equal.
struct ValueRange {
  Rational lo;
  Rational hi;
  bool is_open = false;
};

/// Formats a range for readers: one fraction if it is a single value, else "[fraction, fraction]";
/// "undefined" for nullopt.
std::string to_string(const std::optional<ValueRange>& range);

}  // namespace rastercheck::oracle
