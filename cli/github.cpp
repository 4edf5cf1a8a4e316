#include "cli/github.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>

#include "reports/annotations.h"
#include "reports/format.h"

namespace rastercheck::cli {
namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

Result<void> tell_github(const records::Run& run, const std::string& directory, bool prints) {
  if (prints && variable("GITHUB_ACTIONS") == "true") {
    fmt::print("{}", reports::github_annotations(run, directory));
  }
  const std::string summary(variable("GITHUB_STEP_SUMMARY"));
  if (summary.empty()) return {};
  return reports::find_format("markdown").and_then([&](const reports::Format& format) {
    // Other steps of the job write to it as well.
    std::ofstream file(summary, std::ios::app | std::ios::binary);
    file << format.write(run) << std::flush;
    if (file) return Result<void>();
    return Result<void>(tl::unexpected(
        Error{summary, "", fmt::format("cannot be written to: {}", std::strerror(errno))}));
  });
}

}  // namespace rastercheck::cli
