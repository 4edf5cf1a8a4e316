#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>

namespace rastercheck::cli {

/// Accepts 0 … `most` in decimal digits. By itself CLI11 takes "-1" for 2^64 − 1, and what is too
/// large for the largest.
CLI::Validator whole_number(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

}  // namespace rastercheck::cli
