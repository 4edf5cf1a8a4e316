#include "reports/internal/exact_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "cases/json.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

/// The finite number that starts at `at`; moves `at` to its end.
std::optional<double> read_number(const char*& at) {
  char* end = nullptr;
  const double value = std::strtod(at, &end);
  if (end == at || !std::isfinite(value)) return std::nullopt;
  at = end;
  return value;
}

/// The value of "1/3", "2" or "0.5 (0x1p-1)".
std::optional<double> number_in(const std::string& text) {
  const char* at = text.c_str();
  const std::optional<double> numerator = read_number(at);
  if (!numerator) return std::nullopt;
  if (*at == '/') {
    const std::optional<double> denominator = read_number(++at);
    if (!denominator || *denominator == 0 || *at != '\0') return std::nullopt;
    return *numerator / *denominator;
  }
  const bool is_all = *at == '\0' || std::string_view(at).starts_with(" (0x") ||
                      std::string_view(at).starts_with(" (-0x");
  return is_all ? numerator : std::nullopt;
}

}  // namespace

std::optional<NumberRange> numbers_in(const std::string& text) {
  const std::size_t comma = text.find(", ");
  if (!text.starts_with('[') || !text.ends_with(']') || comma == std::string::npos) {
    const std::optional<double> number = number_in(text);
    return number ? std::optional(NumberRange{*number, *number}) : std::nullopt;
  }
  const std::optional<double> lo = number_in(text.substr(1, comma - 1));
  const std::optional<double> hi = number_in(text.substr(comma + 2, text.size() - comma - 3));
  return lo && hi ? std::optional(NumberRange{*lo, *hi}) : std::nullopt;
}

std::string exact_text(const std::string& exact, std::size_t most) {
  std::string text = most == 0 ? cases::printable(exact) : cases::printable(elided(exact, most));
  if (exact.find('/') == std::string::npos) return text;
  const std::optional<NumberRange> numbers = numbers_in(exact);
  if (!numbers) return text;
  // Nine digits tell all float32 numbers apart.
  if (!exact.starts_with('[')) return fmt::format("{} (about {:.9g})", text, numbers->lo);
  return fmt::format("{} (about {:.9g} to {:.9g})", text, numbers->lo, numbers->hi);
}

int distinct_digits(double drawn, const NumberRange& right) {
  constexpr int kFewest = 3;
  constexpr int kMost = 17;  // these tell any two doubles apart
  const auto text = [](double value, int digits) { return fmt::format("{:.{}g}", value, digits); };
  for (int digits = kFewest; digits < kMost; ++digits) {
    const std::string lo = text(right.lo, digits);
    const std::string hi = text(right.hi, digits);
    const std::string actual = text(drawn, digits);
    const bool is_range_told = right.lo == right.hi || lo != hi;
    if (actual != lo && actual != hi && is_range_told) return digits;
  }
  return kMost;
}

}  // namespace rastercheck::reports
