#include "reports/compare_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "cases/files.h"

namespace rastercheck::reports {
namespace {

std::vector<CompareFormat>& compare_registry() {
  static std::vector<CompareFormat> formats;
  return formats;
}

}  // namespace

CompareFormatRegistration::CompareFormatRegistration(const CompareFormat& format) {
  // Files register in the order of linking; the list is kept sorted by name.
  const auto after =
      std::find_if(compare_registry().begin(), compare_registry().end(),
                   [&format](const CompareFormat& other) { return other.name > format.name; });
  compare_registry().insert(after, format);
}

const std::vector<CompareFormat>& compare_formats() { return compare_registry(); }

Result<CompareFormat> find_compare_format(std::string_view name) {
  std::vector<std::string_view> names;
  for (const CompareFormat& format : compare_registry()) {
    if (format.name == name) return format;
    names.push_back(format.name);
  }
  return tl::unexpected(
      Error{std::string(name), "",
            fmt::format("unknown form of comparisons; the forms are: {}", fmt::join(names, ", "))});
}

std::string file_of(const records::Comparison& comparison, const records::CaseGrowth& growth) {
  return fmt::format("grown/{}-{}-{}-{}.json", records::file_word(growth.law),
                     records::file_word(comparison.key.backend), to_string(growth.origin),
                     growth.index);
}

Result<void> write_comparison(const Gate& gate, const std::string& directory) {
  std::error_code why;
  std::filesystem::create_directories(directory, why);
  if (why) return tl::unexpected(Error{directory, "", "cannot be made: " + why.message()});
  for (const CompareFormat& format : compare_registry()) {
    const std::string file = (std::filesystem::path(directory) / format.file_name).string();
    if (Result<void> written = cases::write_file(file, format.write(gate)); !written) {
      return written;
    }
  }
  return {};
}

}  // namespace rastercheck::reports
