#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::cli {

/// The numbers of a text such as "0.5,-1,2e3"; empty if it is anything else. All are finite and at
/// most as large as the largest float32.
std::optional<std::vector<double>> numbers_in(std::string_view text);

/// Requires a text of `count` numbers; errors name `shape`, such as "X,Y,Z".
CLI::Validator number_list(std::size_t count, const std::string& shape);

/// Adds an option whose value is a list of numbers.
template <typename Number, std::size_t count>
CLI::Option* add_number_list(CLI::App& app, const std::string& name,
                             std::optional<std::array<Number, count>>& value,
                             const std::string& help, const std::string& shape) {
  return app
      .add_option_function<std::string>(
          name,
          [&value](const std::string& text) {
            const std::vector<double> numbers = numbers_in(text).value_or(std::vector<double>());
            std::array<Number, count>& list = value.emplace();
            for (std::size_t i = 0; i < numbers.size() && i < count; ++i) {
              list[i] = static_cast<Number>(numbers[i]);
            }
          },
          help)
      ->check(number_list(count, shape))
      ->type_name(shape);
}

}  // namespace rastercheck::cli
