#pragma once

#include <CLI/CLI.hpp>

namespace rastercheck::cli {

/// Accepts 0 … 2^64 − 1 in decimal digits. By itself CLI11 takes "-1" for 2^64 − 1, and what is too
/// large for the largest.
CLI::Validator whole_number();

}  // namespace rastercheck::cli
