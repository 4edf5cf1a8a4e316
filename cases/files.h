#pragma once

#include <cstddef>
#include <string>

#include "cases/error.h"

namespace rastercheck::cases {

/// The most that read_text() takes, in bytes: what has no end, as /dev/zero, is refused there.
inline constexpr std::size_t kMostBytes = std::size_t{1} << 30;

/// The whole of a file, or of standard input for "-".
Result<std::string> read_text(const std::string& file);

/// Writes a file whole or not at all: under another name first. The error names it.
Result<void> write_file(const std::string& name, const std::string& content);

}  // namespace rastercheck::cases
