#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "reports/format.h"

namespace rastercheck::reports {

/// These files and one for each report format, in the order of their names.
inline std::vector<std::string> with_reports(std::vector<std::string> files) {
  for (const Format& format : formats()) files.emplace_back(format.file_name);
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace rastercheck::reports
