#pragma once

#include <optional>
#include <string>

namespace rastercheck::records {

/// A certified interval: the enclosed exact number lies in [lo, hi], both ends included. An
/// infinite end means that no double bounds it on that side.
struct Enclosure {
  double lo = 0;
  double hi = 0;
  bool operator==(const Enclosure&) const = default;
};

/// True if `value` may be the enclosed number.
bool contains(const Enclosure& enclosure, double value);

/// An enclosure of |x| for the enclosed number x.
Enclosure magnitude(const Enclosure& enclosure);

/// The enclosed number in at most `digits` significant decimals, all certain; empty if no digit is
/// certain.
std::optional<std::string> certain_decimal(const Enclosure& enclosure, int digits);

/// certain_decimal(), or both ends as "[lo, hi]" if no digit is certain.
std::string to_decimal(const Enclosure& enclosure, int digits);

}  // namespace rastercheck::records
