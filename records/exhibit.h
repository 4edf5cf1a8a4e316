#pragma once

// A case and what is wrong with a drawing of it, as plain data: what exporters hand on to people
// and programs that do not have RasterCheck.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "records/counterexample.h"
#include "records/inspection.h"

namespace rastercheck::records {

struct Exhibit {
  std::string file;  ///< the case's file, as the user named it
  /// The case as drawn: a camera, if any, is already applied.
  cases::Case source;
  std::string backend;                ///< specification: "vulkan:lavapipe"
  std::string description;            ///< what draws, in the backend's own words; may be empty
  std::string property;               ///< id of the property that was checked
  std::string sentence;               ///< the property, as a sentence without a full stop
  std::vector<std::string> rules;     ///< "Vulkan 1.3, Basic Polygon Rasterization"
  std::vector<std::string> known;     ///< what known defects say of it, a sentence each
  std::uint64_t violation_count = 0;  ///< 0 if the property holds
  std::vector<Violation> violations;
  /// The first violation's sample, or the worst one, with the pixels around; empty if the case
  /// cannot be drawn or has no sample to show.
  std::optional<Inspection> inspection;
  std::vector<std::string> pixels;  ///< the pixels around, as signs, line by line
  std::string found_with;           ///< name and version of this program
  std::string replay;               ///< the command that checks it again
};

}  // namespace rastercheck::records
