#include "properties/inspect/elided.h"

#include <algorithm>
#include <string_view>

namespace rastercheck::properties {
namespace {

std::size_t digits_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

/// Shortens one number, which may have a sign.
std::string shortened(std::string_view number) {
  constexpr std::size_t kKept = kMostDigits / 4;  // at either end
  if (digits_of(number) <= 2 * kKept) return std::string(number);
  const std::size_t first = number.size() - digits_of(number) + kKept;
  return std::string(number.substr(0, first)) + "…" +
         std::string(number.substr(number.size() - kKept));
}

}  // namespace

std::string elided(const oracle::Rational& value) {
  std::string text = value.to_string();
  if (digits_of(text) <= kMostDigits) return text;
  const std::string_view all = text;
  const std::size_t slash = all.find('/');
  if (slash == std::string_view::npos) return shortened(all);
  return shortened(all.substr(0, slash)) + "/" + shortened(all.substr(slash + 1));
}

std::string elided(const oracle::ValueRange& range) {
  if (range.lo == range.hi) return elided(range.lo);
  return "[" + elided(range.lo) + ", " + elided(range.hi) + "]";
}

}  // namespace rastercheck::properties
