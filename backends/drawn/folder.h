#pragma once

// A folder that one machine fills with cases and another with drawings of them:
//
//   campaign.json       what the cases are for (DrawnCampaign)
//   list.txt            the names of all cases, one on each line
//   cases/NAME.json     a case file
//   cases/NAME.draw     the same as arrays of numbers (draw_file.h)
//   drawn/NAME.drawn    its drawing (drawn_file.h); or NAME.json, as `rastercheck render --json`
//                       writes it; or NAME.npy or NAME.exr (fragment_picture.h)
//
// A case's name is a digest of everything that affects the drawing. So when a law makes the same
// case again, its drawing is found.

#include <set>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "records/plan.h"

namespace rastercheck::backends {

struct DrawnCampaign {
  std::string program;  ///< version of the program that made the cases
  /// Has exactly one backend: the drawings are judged by its promises.
  records::Plan plan;
};

/// Returns the name that a case without a camera has in the folder: 16 hexadecimal digits.
std::string drawn_name(const cases::Case& c);

Result<DrawnCampaign> read_drawn_campaign(const std::string& folder);

/// How many of a folder's cases have a drawing.
struct DrawnCount {
  std::size_t cases = 0;
  std::size_t drawn = 0;
};
Result<DrawnCount> count_drawn(const std::string& folder);

/// Reads the drawing of a case. Fails as `unsupported` if the folder has no drawing of it, or if
/// the drawing says that the case is not supported.
Result<cases::Fragments> read_drawing(const std::string& folder, const cases::Case& c);

/// Turns the description of the backend that makes the promises into that of a machine that draws
/// fragments in its place. Removes the driver, because the machine's driver may have other known
/// defects.
About drawn_about(About promiser);

/// Fills a folder with cases.
class CaseFolder {
 public:
  /// Creates the folder. Fails if the folder exists and is not empty.
  static Result<CaseFolder> make(const std::string& folder);

  /// Writes a case, unless the folder already has it. `promised` is what the backend that will draw
  /// the case promises about it.
  Result<void> add(const cases::Case& c, const cases::Contract& promised);

  /// Writes the list and the campaign.
  Result<void> finish(const DrawnCampaign& campaign) const;

  std::size_t size() const { return names_.size(); }

 private:
  explicit CaseFolder(std::string folder) : folder_(std::move(folder)) {}

  std::string folder_;
  std::vector<std::string> names_;  ///< in the order of their first use
  std::set<std::string> known_;
};

}  // namespace rastercheck::backends
