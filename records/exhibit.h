#pragma once

// A case and what is wrong with a drawing of it, as plain data: what exporters hand on to people
// and programs that do not have RasterCheck.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/sample_place.h"
#include "records/counterexample.h"
#include "records/float_range.h"
#include "records/inspection.h"
#include "records/verdict.h"

namespace rastercheck::records {

/// The numbers that the depth or an attribute may have at a sample.
struct PermittedValue {
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; empty for depth
  FloatRange numbers;
  bool is_right = true;  ///< whether the backend drew one of them
};

/// A sample of a triangle and what may be drawn there.
struct JudgedPlace {
  cases::SamplePlace place = {};
  Verdict verdict = Verdict::forbidden;
  std::vector<PermittedValue> values;  ///< those that are promised, if it is drawn
  bool has_right_count = true;  ///< whether the backend drew it as often as it must: once, never,
                                ///< or at most once if it is `permitted`
};

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
  /// The samples of the inspected part, by triangle, y, x, sample; of the inspected triangle only,
  /// if there are very many. Omits samples where any result is allowed.
  std::vector<JudgedPlace> places;
  /// The grid that the contract places vertices on; empty if they are not rounded.
  std::optional<int> subpixel_bits;
  std::vector<std::string> pixels;  ///< the pixels around, as signs, line by line
  std::string found_with;           ///< name and version of this program
  std::string replay;               ///< the command that checks it again
};

}  // namespace rastercheck::records
