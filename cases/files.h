#pragma once

#include <cstddef>
#include <string>

#include "cases/error.h"

namespace rastercheck::cases {

/// The largest input that read_text() accepts, in bytes: files without an end, as /dev/zero, fail.
inline constexpr std::size_t kMostBytes = std::size_t{1} << 30;

/// The whole of a file, or of standard input for "-".
Result<std::string> read_text(const std::string& file, std::size_t most = kMostBytes);

/// Writes a file whole or not at all: under another name first. The error names it.
Result<void> write_file(const std::string& name, const std::string& content);

}  // namespace rastercheck::cases
