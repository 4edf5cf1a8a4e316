#include "cases/float_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rastercheck::cases {
namespace {

/// The parts of a hex float; value = ±digits · 16^(-fraction length) · 2^exponent.
struct HexParts {
  bool negative = false;
  std::string_view whole;
  std::string_view fraction;
  long exponent = 0;
};

/// Beyond this the exponent text cannot name a float32, however many digits stand before it: a
/// mantissa shifts it by 4 bits a character, and files are far shorter than this.
constexpr long kExponentLimit = 1L << 40;

std::string_view take_hex_digits(std::string_view& text) {
  const std::size_t end = text.find_first_not_of("0123456789abcdefABCDEF");
  const std::string_view digits = text.substr(0, end);
  text.remove_prefix(digits.size());
  return digits;
}

std::optional<HexParts> split(std::string_view text) {
  HexParts parts;
  if (text.starts_with('-') || text.starts_with('+')) {
    parts.negative = text.front() == '-';
    text.remove_prefix(1);
  }
  if (!text.starts_with("0x") && !text.starts_with("0X")) return std::nullopt;
  text.remove_prefix(2);
  parts.whole = take_hex_digits(text);
  if (parts.whole.empty()) return std::nullopt;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    parts.fraction = take_hex_digits(text);
    if (parts.fraction.empty()) return std::nullopt;
  }
  if (text.empty()) return parts;
  if (text.front() != 'p' && text.front() != 'P') return std::nullopt;
  text.remove_prefix(1);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  const auto [end, error] = std::from_chars(text.begin(), text.end(), parts.exponent);
  if (end != text.end() || end == text.begin()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    parts.exponent = text.front() == '-' ? -kExponentLimit : kExponentLimit;
  }
  return parts;
}

int digit_value(char c) {
  if (c <= '9') return c - '0';
  return (c | 0x20) - 'a' + 10;
}

}  // namespace

bool is_hex_float(std::string_view text) { return split(text).has_value(); }

std::optional<float> float_from_hex(std::string_view text) {
  const std::optional<HexParts> parts = split(text);
  if (!parts) return std::nullopt;

  // Leading and trailing zeros carry no bits; what is left must fit float32's 24.
  std::string digits(parts->whole);
  digits += parts->fraction;
  const std::size_t first = digits.find_first_not_of('0');
  if (first == std::string::npos) return parts->negative ? -0.0F : 0.0F;
  const std::size_t last = digits.find_last_not_of('0');
  constexpr std::size_t kMostDigits = 7;  // 24 bits touch at most 7 hex digits
  if (last - first >= kMostDigits) return std::nullopt;

  std::uint32_t mantissa = 0;
  for (std::size_t i = first; i <= last; ++i) {
    mantissa = mantissa * 16 + static_cast<std::uint32_t>(digit_value(digits[i]));
  }
  const long clamped_exponent = std::clamp(parts->exponent, -kExponentLimit, kExponentLimit);
  const long exponent =
      clamped_exponent + 4 * (static_cast<long>(parts->whole.size()) - static_cast<long>(last) - 1);
  // A float32 lies in 2^-149…2^128; a mantissa of up to 28 bits needs no more than this.
  if (exponent < -256 || exponent > 256) return std::nullopt;
  const double magnitude = std::ldexp(static_cast<double>(mantissa), static_cast<int>(exponent));
  return exact_float(parts->negative ? -magnitude : magnitude);
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
  // As a double no float32 is subnormal. fmt's own has another zero in each version.
  constexpr std::size_t kLongest = 16;  // 1.fffffep+127
  std::array<char, kLongest> digits{};
  const auto end =
      std::to_chars(digits.begin(), digits.end(), std::abs(double{value}), std::chars_format::hex)
          .ptr;
  return fmt::format("{}0x{}", sign, std::string_view(digits.begin(), end));
}

}  // namespace rastercheck::cases
