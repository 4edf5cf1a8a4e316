#pragma once

#include <string>
#include <string_view>

namespace rastercheck::reports {

/// Escapes a text so that Markdown shows it unchanged, on one line and within a table's cell.
std::string markdown(std::string_view text);

/// A command as a block of code. No text can end the block early, as line breaks are escaped.
std::string command_block(std::string_view command);

}  // namespace rastercheck::reports
