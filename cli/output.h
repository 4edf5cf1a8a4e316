#pragma once

#include <span>
#include <string>

#include "cases/error.h"

namespace rastercheck::cli {

/// Pushes out what was printed. Fails where standard output could not take it all (a full disk, a
/// closed pipe), so that a cut result is never taken for a whole one.
Result<void> flush_standard_output();

/// The line that ends a command that wrote a run's folder: the page to look at, or, where HTML is
/// not among the formats, the folder.
std::string where_reports_are(const std::string& directory, std::span<const std::string> formats);

}  // namespace rastercheck::cli
