#include <algorithm>

#include "reports/format.h"

namespace rastercheck::reports {
namespace {

std::vector<Format>& registry() {
  static std::vector<Format> formats;
  return formats;
}

}  // namespace

FormatRegistration::FormatRegistration(const Format& format) {
  // The order in which files register is the linker's; lists have one of their own.
  const auto after =
      std::find_if(registry().begin(), registry().end(),
                   [&format](const Format& other) { return other.name > format.name; });
  registry().insert(after, format);
}

const std::vector<Format>& formats() { return registry(); }

Result<Format> find_format(std::string_view name) {
  std::string known;
  for (const Format& format : registry()) {
    if (format.name == name) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  return tl::unexpected(
      Error{std::string(name), "", "no report format of that name; there are: " + known});
}

}  // namespace rastercheck::reports
