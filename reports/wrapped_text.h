#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rastercheck::reports {

/// Characters per terminal line.
inline constexpr std::size_t kTerminalWidth = 80;

/// Returns `label`, then the text from column `indent` on, broken at spaces into lines of at most
/// `columns` characters. Both are UTF-8. A word that is too long for a line gets a line of its own.
std::string wrapped(std::string_view label, std::size_t indent, std::string_view text,
                    std::size_t columns = kTerminalWidth);

/// The number of characters in a UTF-8 text.
std::size_t characters_in(std::string_view text);

}  // namespace rastercheck::reports
