#include "records/enclosure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rastercheck::records {
namespace {

std::string in_decimals(double value, int digits) {
  // An enclosed zero has no sign.
  return fmt::format("{:.{}g}", value == 0 ? 0.0 : value, digits);
}

}  // namespace

bool contains(const Enclosure& enclosure, double value) {
  return enclosure.lo <= value && value <= enclosure.hi;
}

Enclosure magnitude(const Enclosure& enclosure) {
  const double a = std::abs(enclosure.lo);
  const double b = std::abs(enclosure.hi);
  return {contains(enclosure, 0) ? 0 : std::min(a, b), std::max(a, b)};
}

std::optional<std::string> certain_decimal(const Enclosure& enclosure, int digits) {
  for (; digits > 0; --digits) {
    std::string text = in_decimals(enclosure.lo, digits);
    if (text == in_decimals(enclosure.hi, digits)) return text;
  }
  return std::nullopt;
}

std::string to_decimal(const Enclosure& enclosure, int digits) {
  return certain_decimal(enclosure, digits)
      .value_or("[" + in_decimals(enclosure.lo, 17) + ", " + in_decimals(enclosure.hi, 17) + "]");
}

}  // namespace rastercheck::records
