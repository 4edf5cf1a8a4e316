#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rastercheck::reports {

/// A table for a terminal: columns as wide as their widest cell, two spaces between them, none at
/// the end of a line; the header is a row like the others. Cells are UTF-8.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// The same where it fits into that many columns, or nothing says how many there are. Else one
/// entry for each row: its first cell, and in the lines below all others that say something, each
/// behind its column's header, the first row.
std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       std::optional<std::size_t> columns);

}  // namespace rastercheck::reports
