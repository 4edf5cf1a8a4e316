#include <fmt/format.h>

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
  // Files register in the order of linking; the list is kept sorted by name.
  const auto after =
      std::find_if(registry().begin(), registry().end(),
                   [&format](const Format& other) { return other.name > format.name; });
  registry().insert(after, format);
}

const std::vector<Format>& formats() { return registry(); }

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const Format& format : registry()) names.emplace_back(format.name);
  return names;
}

std::vector<std::string> default_format_names() {
  std::vector<std::string> names;
  for (const Format& format : registry()) {
    if (!format.is_on_request) names.emplace_back(format.name);
  }
  return names;
}

Result<Format> find_format(std::string_view name) {
  for (const Format& format : registry()) {
    if (format.name == name) return format;
  }
  return tl::unexpected(Error{
      std::string(name), "",
      fmt::format("unknown report format; the formats are: {}", fmt::join(format_names(), ", "))});
}

}  // namespace rastercheck::reports
