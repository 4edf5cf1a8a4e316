#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cases/error.h"

namespace rastercheck::cli {

/// Prints on standard error. Where that takes nothing (a full disk, a closed terminal) there is
/// nobody to tell. Wants no memory.
void print_problem(std::string_view text) noexcept;

/// Pushes out what was printed. Fails where standard output could not take it all (a full disk, a
/// closed pipe), so that a cut result is never taken for a whole one.
Result<void> flush_standard_output();

/// Refuses to write a file over the one that is read, by whatever names.
Result<void> check_output_file(const std::string& output, const std::string& input);

/// The line that ends a command that wrote a run's folder: the page to look at, or, where HTML is
/// not among the formats, the folder.
std::string where_reports_are(const std::string& directory, std::span<const std::string> formats);

}  // namespace rastercheck::cli
