#include "cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace rastercheck::cli {

void print_problem(std::string_view text) noexcept {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

Result<void> flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
  const std::error_code why(errno, std::generic_category());
  return tl::unexpected(Error{"standard output", "",
                              why ? "cannot be written: " + why.message() : "cannot be written"});
}

Result<void> check_output_file(const std::string& output, const std::string& input) {
  std::error_code is_not_there;
  if (!std::filesystem::equivalent(output, input, is_not_there)) return {};
  return tl::unexpected(
      Error{output, "", "is the input and would be overwritten; write to another file"});
}

std::string where_reports_are(const std::string& directory, std::span<const std::string> formats) {
  const bool has_page = std::find(formats.begin(), formats.end(), "html") != formats.end();
  return fmt::format("Report: {}{}\n", directory, has_page ? "/report.html" : "");
}

}  // namespace rastercheck::cli
