#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cases/error.h"

namespace rastercheck::cli {

/// Prints on standard error, without allocating memory. Ignores failures (a full disk, a closed
/// terminal), as nobody could be told.
void print_problem(std::string_view text) noexcept;

/// Flushes standard output. Fails if it could not take everything (a full disk, a closed pipe), so
/// that nobody mistakes a truncated result for a whole one.
Result<void> flush_standard_output();

/// Fails if the output file would overwrite the input file, under whatever names.
Result<void> check_output_file(const std::string& output, const std::string& input);

/// Returns the closing line of a command that wrote a run's folder. The line names the page to look
/// at, or the folder if HTML is not among the formats.
std::string where_reports_are(const std::string& directory, std::span<const std::string> formats);

}  // namespace rastercheck::cli
