#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rastercheck::reports {

/// Characters of a line on a terminal.
inline constexpr std::size_t kTerminalWidth = 80;

/// `label`, then the text from column `indent` on, broken at spaces wherever a line of `columns`
/// characters ends. Both are UTF-8; a word that fits no line stands on one of its own.
std::string wrapped(std::string_view label, std::size_t indent, std::string_view text,
                    std::size_t columns = kTerminalWidth);

/// How many characters a text in UTF-8 has.
std::size_t characters_in(std::string_view text);

}  // namespace rastercheck::reports
