#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"

namespace rastercheck::cli {

/// A text as a JSON string, quotes included; bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

/// Pushes out what was printed. Fails where standard output could not take it all (a full disk, a
/// closed pipe), so that a cut result is never taken for a whole one.
Result<void> flush_standard_output();

/// A table for people: columns as wide as their widest cell, the header first.
std::string table(const std::vector<std::vector<std::string>>& rows);

}  // namespace rastercheck::cli
