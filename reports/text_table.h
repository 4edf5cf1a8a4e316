#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rastercheck::reports {

/// A table for a terminal. Columns are as wide as their widest cell, with two spaces between
/// columns and none at the end of a line. The header is a row like the others. Cells are UTF-8.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// The same table if it fits into `columns`, or if `columns` is empty. Otherwise each row becomes
/// an entry: its first cell, then a line for each other cell that is not empty, after the column's
/// header from the first row.
std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       std::optional<std::size_t> columns);

}  // namespace rastercheck::reports
