#pragma once

#include <string>
#include <vector>

namespace rastercheck::reports {

/// A table for a terminal: columns as wide as their widest cell, two spaces between them, none at
/// the end of a line; the header is a row like the others. Cells are UTF-8.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace rastercheck::reports
