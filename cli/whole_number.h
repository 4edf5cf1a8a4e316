#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace rastercheck::cli {

/// Accepts 0 … `most` in decimal digits, also with an exponent, as 1e9, which transform() makes
/// digits. By itself CLI11 takes "-1" for 2^64 − 1, and what is too large for the largest.
CLI::Validator whole_number(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// The number that decimal digits say; nothing where there is anything else, or too much of them.
std::optional<std::uint64_t> whole_number_in(std::string_view text);

/// Two of them and what stands between: "2/7" with '/'.
std::optional<std::pair<std::uint64_t, std::uint64_t>> two_whole_numbers_in(std::string_view text,
                                                                            char between);

}  // namespace rastercheck::cli
