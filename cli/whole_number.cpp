#include "cli/whole_number.h"

#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <string>
#include <system_error>

namespace rastercheck::cli {

namespace {

/// Writes out the zeros of a number such as "1e9", if a number can have that many; returns any
/// other text unchanged.
std::string without_exponent(const std::string& text) {
  const std::size_t mark = text.find_first_of("eE");
  if (mark == std::string::npos || mark == 0) return text;
  const auto zeros = whole_number_in(std::string_view(text).substr(mark + 1));
  constexpr std::uint64_t kMostZeros = std::numeric_limits<std::uint64_t>::digits10;
  if (!zeros || *zeros > kMostZeros) return text;
  return text.substr(0, mark) + std::string(*zeros, '0');
}

}  // namespace

CLI::Validator whole_number(std::uint64_t most) {
  return {[most](std::string& text) -> std::string {
            const auto value = whole_number_in(without_exponent(text));
            if (value && *value <= most) {
              text = std::to_string(*value);
              return "";
            }
            return fmt::format("{} is not an integer between 0 and {}", text, most);
          },
          ""};
}

std::optional<std::uint64_t> whole_number_in(std::string_view text) {
  std::uint64_t value = 0;
  const char* const end = std::to_address(text.end());
  const auto [stop, problem] = std::from_chars(std::to_address(text.begin()), end, value);
  return stop == end && problem == std::errc() ? std::optional(value) : std::nullopt;
}

std::optional<std::pair<std::uint64_t, std::uint64_t>> two_whole_numbers_in(std::string_view text,
                                                                            char between) {
  const std::size_t middle = text.find(between);
  if (middle == std::string_view::npos) return std::nullopt;
  const auto first = whole_number_in(text.substr(0, middle));
  const auto second = whole_number_in(text.substr(middle + 1));
  return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

}  // namespace rastercheck::cli
