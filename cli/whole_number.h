#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace rastercheck::cli {

/// Accepts 0 … `most` in decimal digits, also with an exponent such as 1e9, which transform()
/// expands to digits. CLI11 alone takes "-1" for 2^64 − 1, and clamps numbers that are too large.
CLI::Validator whole_number(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// Returns the number written in decimal digits; empty if the text is anything else or too large.
std::optional<std::uint64_t> whole_number_in(std::string_view text);

/// Reads two such numbers around a separator: "2/7" with '/'.
std::optional<std::pair<std::uint64_t, std::uint64_t>> two_whole_numbers_in(std::string_view text,
                                                                            char between);

}  // namespace rastercheck::cli
