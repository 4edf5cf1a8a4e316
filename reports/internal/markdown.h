#pragma once

#include <string>
#include <string_view>

namespace rastercheck::reports {

/// A text that Markdown shows as it is, on one line and within a table's cell.
std::string markdown(std::string_view text);

/// A command in a block of its own. No text can end the block, as line breaks are escaped.
std::string command_block(std::string_view command);

}  // namespace rastercheck::reports
