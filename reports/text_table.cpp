#include "reports/text_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/wrapped_text.h"

namespace rastercheck::reports {
namespace {

using Row = std::vector<std::string>;

bool is_wider_than(const std::string& table, std::size_t columns) {
  std::size_t begin = 0;
  while (begin < table.size()) {
    const std::size_t end = table.find('\n', begin);
    if (characters_in(std::string_view(table).substr(begin, end - begin)) > columns) return true;
    begin = end + 1;
  }
  return false;
}

std::string entry(const Row& header, const Row& row, std::size_t columns) {
  std::string values;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i].empty() || row[i] == "-" || row[i] == "–") continue;
    if (!values.empty()) values += "; ";
    const bool has_header = i < header.size() && !header[i].empty();
    values += has_header ? fmt::format("{}: {}", header[i], row[i]) : row[i];
  }
  const std::size_t indent = std::min(row.front().find_first_not_of(' '), row.front().size());
  const std::string below = values.empty() ? "" : wrapped("", indent + 2, values, columns);
  return wrapped("", indent, row.front().substr(indent), columns) + below;
}

}  // namespace

std::string text_table(const std::vector<Row>& rows, std::optional<std::size_t> columns) {
  std::string table = text_table(rows);
  if (!columns || rows.empty() || !is_wider_than(table, *columns)) return table;
  std::string text;
  for (std::size_t i = 1; i < rows.size(); ++i) text += entry(rows.front(), rows[i], *columns);
  return text;
}

std::string text_table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], characters_in(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i] + std::string(widths[i] - characters_in(row[i]) + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace rastercheck::reports
