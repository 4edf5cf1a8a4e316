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
  /// What the oracle computes with; defined inside the oracle only.
  struct Number;

  /// Exactly the value, which is finite.
  explicit Rational(double value = 0);
  explicit Rational(std::shared_ptr<const Number> number) : number_(std::move(number)) {}

  /// "p/q", or "p" where q = 1.
  std::string to_string() const;
  /// Doubles around the value, equal where a double holds it.
  records::Enclosure enclosure() const;
  /// The double nearest to the value; of two equally near ones the smaller; ±infinity beyond
  /// doubles.
  double nearest_double() const;
  /// The float32 nearest to the value, ties to even; ±infinity beyond float32.
  float nearest_float() const;

  std::strong_ordering operator<=>(const Rational& other) const;
  bool operator==(const Rational& other) const;

  const Number& number() const { return *number_; }

 private:
  std::shared_ptr<const Number> number_;
};

/// A closed range of exact values: what the rules leave open of one fragment's value. `is_open`
/// tells a range by kind, whose ends may still be equal, from a single value.
struct ValueRange {
  Rational lo;
  Rational hi;
  bool is_open = false;
};

/// A range for readers: one fraction where it is one value, else "[fraction, fraction]";
/// "undefined" of nothing.
std::string to_string(const std::optional<ValueRange>& range);

}  // namespace rastercheck::oracle
