#include "cli/number_list.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <system_error>

#include "cases/json.h"

namespace rastercheck::cli {

std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  const char* at = std::to_address(text.begin());
  const char* const end = std::to_address(text.end());
  while (true) {
    double number = 0;
    const auto [stop, problem] = std::from_chars(at, end, number);
    // The comparison is false for NaN.
    if (problem != std::errc() || !(std::abs(number) <= std::numeric_limits<float>::max())) {
      return std::nullopt;
    }
    numbers.push_back(number);
    if (stop == end) return numbers;
    if (*stop != ',') return std::nullopt;
    at = stop + 1;
  }
}

CLI::Validator number_list(std::size_t count, const std::string& shape) {
  return {[count, shape](std::string& text) -> std::string {
            const auto numbers = numbers_in(text);
            if (numbers && numbers->size() == count) return "";
            return fmt::format("'{}' is not {} of finite numbers", cases::printable(text), shape);
          },
          ""};
}

}  // namespace rastercheck::cli
