#include "cli/whole_number.h"

#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <string>
#include <system_error>

namespace rastercheck::cli {

CLI::Validator whole_number(std::uint64_t most) {
  return {[most](std::string& text) -> std::string {
            const auto value = whole_number_in(text);
            if (value && *value <= most) return "";
            return fmt::format("Value {} is no whole number from 0 to {}", text, most);
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
