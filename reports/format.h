#pragma once

// The forms in which a run is written. A format is one file in reports/formats/ that registers
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
  std::string_view name;       ///< as on the command line, "html"
  std::string_view file_name;  ///< within the run's folder, "report.html"
  /// The whole file, UTF-8. Depends on nothing but the run; texts of the run may be any bytes.
  std::string (*write)(const records::Run& run);
  bool is_on_request = false;  ///< written only where it is asked for by name
  bool needs_cases = false;    ///< of runs that keep what each case gave (Run::cases) only
};

/// All formats, in the order of their names.
const std::vector<Format>& formats();

/// The same, "html" and so on.
std::vector<std::string> format_names();
/// Those that every run writes.
std::vector<std::string> default_format_names();

/// The error names those there are.
Result<Format> find_format(std::string_view name);

struct FormatRegistration {
  explicit FormatRegistration(const Format& format);
};

}  // namespace rastercheck::reports
