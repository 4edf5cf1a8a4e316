#include "cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

namespace rastercheck::cli {

Result<void> flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
  const std::error_code why(errno, std::generic_category());
  return tl::unexpected(Error{"standard output", "",
                              why ? "cannot be written: " + why.message() : "cannot be written"});
}

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += fmt::format("{:<{}}  ", row[i], widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string where_reports_are(const std::string& directory, std::span<const std::string> formats) {
  const bool has_page = std::find(formats.begin(), formats.end(), "html") != formats.end();
  return fmt::format("Report: {}{}\n", directory, has_page ? "/report.html" : "");
}

}  // namespace rastercheck::cli
