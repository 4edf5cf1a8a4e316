#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "reports/format.h"

namespace rastercheck::reports {

/// These files, and one for each report format that every run writes, sorted by name.
inline std::vector<std::string> with_reports(std::vector<std::string> files) {
  for (const Format& format : formats()) {
    if (!format.is_on_request) files.emplace_back(format.file_name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace rastercheck::reports
