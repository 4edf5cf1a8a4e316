#pragma once

// The formats in which a run is written. Each format is a file in reports/formats/ that registers
// itself:
//
//   const FormatRegistration kRegistration({"name", "file.name", &write});
//
// docs/adding-a-report-format.md walks through it.

#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "records/run.h"

namespace rastercheck::reports {

struct Format {
  std::string_view name;       ///< as on the command line, such as "html"
  std::string_view file_name;  ///< within the run's folder, such as "report.html"
  /// Returns the content of the whole file, in UTF-8. Depends only on the run, whose texts may hold
  /// any bytes.
  std::string (*write)(const records::Run& run);
  bool is_on_request = false;  ///< written only if asked for by name
  bool needs_cases = false;    ///< requires a run that keeps each case's results (Run::cases)
};

/// All formats, sorted by name.
const std::vector<Format>& formats();

/// The names of all formats, such as "html".
std::vector<std::string> format_names();
/// The names of the formats that every run writes.
std::vector<std::string> default_format_names();

/// Returns the format with that name. The error lists the existing names.
Result<Format> find_format(std::string_view name);

struct FormatRegistration {
  explicit FormatRegistration(const Format& format);
};

}  // namespace rastercheck::reports
