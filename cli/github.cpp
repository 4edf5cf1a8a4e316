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

/// Appends the result of `text` to the summary of the job's step, if it has one.
template <typename Text>
Result<void> append_summary(const Text& text) {
  const std::string summary(variable("GITHUB_STEP_SUMMARY"));
  if (summary.empty()) return {};
  // Other steps of the job append to the file as well.
  std::ofstream file(summary, std::ios::app | std::ios::binary);
  file << text() << std::flush;
  if (file) return {};
  return tl::unexpected(
      Error{summary, "", fmt::format("cannot be written to: {}", std::strerror(errno))});
}

bool is_in_actions() { return variable("GITHUB_ACTIONS") == "true"; }

}  // namespace

Result<void> tell_github(const records::Run& run, const std::string& directory, bool prints) {
  if (prints && is_in_actions()) fmt::print("{}", reports::github_annotations(run, directory));
  return reports::find_format("markdown").and_then([&run](const reports::Format& format) {
    return append_summary([&] { return format.write(run); });
  });
}

Result<void> tell_github(const reports::Gate& gate, bool prints) {
  if (prints && is_in_actions()) fmt::print("{}", reports::github_annotations(gate));
  return reports::find_compare_format("markdown")
      .and_then([&gate](const reports::CompareFormat& format) {
        return append_summary([&] { return format.write(gate); });
      });
}

}  // namespace rastercheck::cli
