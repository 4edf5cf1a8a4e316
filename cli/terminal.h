#pragma once

#include <cstddef>
#include <optional>

namespace rastercheck::cli {

/// How many characters a line of standard output has room for; nothing where it is no terminal.
std::optional<std::size_t> terminal_columns();

}  // namespace rastercheck::cli
