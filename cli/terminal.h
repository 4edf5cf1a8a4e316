#pragma once

#include <cstddef>
#include <optional>

namespace rastercheck::cli {

/// Returns the number of characters in a line of standard output; empty if that is no terminal.
std::optional<std::size_t> terminal_columns();

/// True if the environment variable is set and not empty.
bool is_set(const char* variable);

/// True if the file descriptor is a terminal that understands control sequences.
bool is_capable_terminal(int descriptor);

/// True if standard output takes colours: is_capable_terminal() is true for it, and the user has
/// not set NO_COLOR (no-color.org).
bool has_color();

}  // namespace rastercheck::cli
