#include "cli/commit.h"

#include <cstdlib>
#include <string_view>

#include "cases/child_process.h"

namespace rastercheck::cli {

std::string commit_of(const std::string& given) {
  if (!given.empty()) return given;
  for (const char* name : {"GITHUB_SHA", "CI_COMMIT_SHA"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') return value;
  }
  constexpr std::uint64_t kMostOutput = 1000;
  const auto asked = cases::run_child({"git", "rev-parse", "HEAD"}, kMostOutput);
  if (!asked || asked->end.signal != 0 || asked->end.exit_code != 0) return "";
  const std::string& said = asked->output;
  return said.substr(0, said.find('\n'));
}

}  // namespace rastercheck::cli
