#pragma once

#include <optional>
#include <string>

namespace rastercheck::records {

/// A certified interval: the exact number it stands for lies in [lo, hi], both ends included. An
/// infinite end means that no double bounds it on that side.
struct Enclosure {
  double lo = 0;
  double hi = 0;
  bool operator==(const Enclosure&) const = default;
};

/// Whether `value` may be the enclosed number.
bool contains(const Enclosure& enclosure, double value);

/// |x| of the enclosed x.
Enclosure magnitude(const Enclosure& enclosure);

/// The enclosed number in at most `digits` significant decimals, all of which are certain; nothing
/// where not even one is.
std::optional<std::string> certain_decimal(const Enclosure& enclosure, int digits);

/// The same; the two ends, as "[lo, hi]", where no digit is certain.
std::string to_decimal(const Enclosure& enclosure, int digits);

}  // namespace rastercheck::records
