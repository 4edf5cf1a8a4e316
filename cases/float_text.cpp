#include "cases/float_text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace rastercheck::cases {
namespace {

/// The parts of a hex float.
struct HexParts {
  bool is_negative = false;
  std::string_view whole;     ///< digits
  std::string_view fraction;  ///< digits
  std::string_view number;    ///< everything after "0x", as std::from_chars needs it
};

std::string_view take_digits(std::string_view& text, std::string_view digits) {
  const std::string_view taken = text.substr(0, text.find_first_not_of(digits));
  text.remove_prefix(taken.size());
  return taken;
}

std::optional<HexParts> split(std::string_view text) {
  constexpr std::string_view kHexDigits = "0123456789abcdefABCDEF";
  HexParts parts;
  if (text.starts_with('-') || text.starts_with('+')) {
    parts.is_negative = text.front() == '-';
    text.remove_prefix(1);
  }
  if (!text.starts_with("0x") && !text.starts_with("0X")) return std::nullopt;
  text.remove_prefix(2);
  parts.number = text;
  parts.whole = take_digits(text, kHexDigits);
  if (parts.whole.empty()) return std::nullopt;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    parts.fraction = take_digits(text, kHexDigits);
    if (parts.fraction.empty()) return std::nullopt;
  }
  if (text.empty()) return parts;
  if (text.front() != 'p' && text.front() != 'P') return std::nullopt;
  text.remove_prefix(1);
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  if (take_digits(text, kHexDigits.substr(0, 10)).empty() || !text.empty()) return std::nullopt;
  return parts;
}

}  // namespace

bool is_hex_float(std::string_view text) { return split(text).has_value(); }

std::optional<float> float_from_hex(std::string_view text) {
  const std::optional<HexParts> parts = split(text);
  if (!parts) return std::nullopt;

  // Leading and trailing zeros carry no bits. More digits than a double holds would be rounded
  // silently; no float32 needs as many.
  std::string digits(parts->whole);
  digits += parts->fraction;
  const std::size_t first = digits.find_first_not_of('0');
  if (first == std::string::npos) return parts->is_negative ? -0.0F : 0.0F;
  constexpr std::size_t kMostDigits = 7;  // 24 bits touch at most 7 hex digits
  if (digits.find_last_not_of('0') - first >= kMostDigits) return std::nullopt;

  double magnitude = 0;
  const std::string_view number = parts->number;
  const auto read =
      std::from_chars(number.begin(), number.end(), magnitude, std::chars_format::hex);
  if (read.ec != std::errc() || read.ptr != number.end()) return std::nullopt;
  return exact_float(parts->is_negative ? -magnitude : magnitude);
}

std::optional<float> exact_float(double value) {
  if (!std::isfinite(value) || std::abs(value) > double{std::numeric_limits<float>::max()}) {
    return std::nullopt;
  }
  const auto candidate = static_cast<float>(value);
  if (double{candidate} != value) return std::nullopt;
  return candidate;
}

std::string to_hex(float value) {
  const std::string_view sign = std::signbit(value) ? "-" : "";
  if (!std::isfinite(value)) return fmt::format("{}{}", sign, std::isnan(value) ? "nan" : "inf");
  // As a double, no float32 is subnormal. Avoids fmt's own hex format, because versions of fmt
  // write zero differently.
  constexpr std::size_t kLongest = 16;  // 1.fffffep+127
  std::array<char, kLongest> digits{};
  const auto end =
      std::to_chars(digits.begin(), digits.end(), std::abs(double{value}), std::chars_format::hex)
          .ptr;
  return fmt::format("{}0x{}", sign, std::string_view(digits.begin(), end));
}

}  // namespace rastercheck::cases
