#pragma once

// The formats in which comparisons are written. Each format is a file in reports/compare_formats/
// that registers itself:
//
//   const CompareFormatRegistration kRegistration({"name", "compare.name", &write});

#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "records/closer_look.h"
#include "records/comparison.h"
#include "records/run.h"

namespace rastercheck::reports {

/// The data from which the reports of a gate are made.
struct Gate {
  std::vector<records::Comparison> comparisons;  ///< one per backend
  records::PolicyReview policy;
  std::string baseline_file;  ///< as the user named it
  std::string current_file;   ///< also as the user named it
  /// The folder of the comparison's files, in which each listed case is saved as file_of(growth).
  /// Empty if the cases are not saved.
  std::string folder;
  /// The runs behind both sides; nullptr for a side that is a baseline file.
  const records::Run* before_run = nullptr;
  const records::Run* after_run = nullptr;
  /// The baseline itself, which has data about its run that the comparisons leave out; may be
  /// nullptr.
  const records::Baseline* baseline = nullptr;
  /// The cases, of all comparisons, that were drawn again with their current backends and
  /// inspected.
  std::vector<records::CloserLook> looks = {};
};

struct CompareFormat {
  std::string_view name;       ///< "html"
  std::string_view file_name;  ///< within the folder, "compare.html"
  std::string (*write)(const Gate& gate);
};

/// All formats, sorted by name.
const std::vector<CompareFormat>& compare_formats();

/// Returns the format with that name. The error lists the existing names.
Result<CompareFormat> find_compare_format(std::string_view name);

struct CompareFormatRegistration {
  explicit CompareFormatRegistration(const CompareFormat& format);
};

/// The file of a grown case within the folder: "grown/LAW-random-12.json", with '-' in place of
/// every character that is neither a letter nor a digit.
std::string file_of(const records::Comparison& comparison, const records::CaseGrowth& growth);

/// Writes all formats into the folder, which is created if missing. Each file is written either
/// whole or not at all.
Result<void> write_comparison(const Gate& gate, const std::string& directory);

}  // namespace rastercheck::reports
