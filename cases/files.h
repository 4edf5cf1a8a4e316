#pragma once

#include <cstddef>
#include <string>

#include "cases/error.h"

namespace rastercheck::cases {

/// The largest input that read_text() accepts, in bytes: endless files, such as /dev/zero, fail.
inline constexpr std::size_t kMostBytes = std::size_t{1} << 30;

/// Reads all of a file, or of standard input for "-".
Result<std::string> read_text(const std::string& file, std::size_t most = kMostBytes);

/// Writes a file completely or not at all, by writing to a temporary name first. The error names
/// the file.
Result<void> write_file(const std::string& name, const std::string& content);

}  // namespace rastercheck::cases
