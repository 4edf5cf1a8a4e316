#include "reports/internal/exact_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "cases/json.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

/// "0.333333333" for "1/3", with the digits of float32. Empty if the text is not a fraction, or if
/// its value is beyond the range of doubles.
std::string decimal_of(const std::string& fraction) {
  if (fraction.find_first_not_of("-0123456789/") != std::string::npos) return "";
  const std::size_t slash = fraction.find('/');
  double value = std::strtod(fraction.c_str(), nullptr);
  if (slash != std::string::npos) value /= std::strtod(fraction.c_str() + slash + 1, nullptr);
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "";
}

}  // namespace

std::string exact_text(const std::string& exact, std::size_t most) {
  std::string text = most == 0 ? cases::printable(exact) : cases::printable(elided(exact, most));
  if (exact.find('/') == std::string::npos) return text;
  const std::size_t comma = exact.find(", ");
  if (!exact.starts_with('[') || !exact.ends_with(']') || comma == std::string::npos) {
    const std::string decimal = decimal_of(exact);
    return decimal.empty() ? text : fmt::format("{} (about {})", text, decimal);
  }
  const std::string low = decimal_of(exact.substr(1, comma - 1));
  const std::string high = decimal_of(exact.substr(comma + 2, exact.size() - comma - 3));
  if (low.empty() || high.empty()) return text;
  return fmt::format("{} (about {} to {})", text, low, high);
}

}  // namespace rastercheck::reports
