#pragma once

// The forms in which comparisons are written. A form is one file in reports/compare_formats/ that
// registers itself:
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

/// All that reports of a gate are made from.
struct Gate {
  std::vector<records::Comparison> comparisons;  ///< one for each backend
  records::PolicyReview policy;
  std::string baseline_file;  ///< as the user named it
  std::string current_file;   ///< likewise
  /// Folder of the comparison's files that the listed cases are saved in, each as file_of(growth);
  /// empty where they are not saved.
  std::string folder;
  /// The runs behind both sides, where they are runs; nullptr of a baseline file.
  const records::Run* before_run = nullptr;
  const records::Run* after_run = nullptr;
  /// The baseline, for what else it keeps of its run; may be nullptr.
  const records::Baseline* baseline = nullptr;
  /// Cases drawn again and looked at, of all comparisons: of each those of its current backend.
  std::vector<records::CloserLook> looks = {};
};

struct CompareFormat {
  std::string_view name;       ///< "html"
  std::string_view file_name;  ///< within the folder, "compare.html"
  std::string (*write)(const Gate& gate);
};

/// All of them, in the order of their names.
const std::vector<CompareFormat>& compare_formats();

/// That of a name; the error names those there are.
Result<CompareFormat> find_compare_format(std::string_view name);

struct CompareFormatRegistration {
  explicit CompareFormatRegistration(const CompareFormat& format);
};

/// The file that a grown case is saved as, within the folder: "grown/LAW-random-12.json", with what
/// is neither letter nor digit made '-'.
std::string file_of(const records::Comparison& comparison, const records::CaseGrowth& growth);

/// Writes all forms into the folder, which is made where it is missing, each file whole or not at
/// all.
Result<void> write_comparison(const Gate& gate, const std::string& directory);

}  // namespace rastercheck::reports
