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
// A case's name is a digest of everything that is drawn, so that laws find the drawing of a case
// that they make.

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
  std::string program;  ///< version that made the cases
  /// Its only backend is the one whose promises the drawings are judged by.
  records::Plan plan;
};

/// The name of a case without a camera: 16 hexadecimal digits.
std::string drawn_name(const cases::Case& c);

Result<DrawnCampaign> read_drawn_campaign(const std::string& folder);

/// How many of a folder's cases have a drawing.
struct DrawnCount {
  std::size_t cases = 0;
  std::size_t drawn = 0;
};
Result<DrawnCount> count_drawn(const std::string& folder);

/// Reads the drawing of a case. Fails as `unsupported` if there is none, or if it says that the
/// case is not supported.
Result<cases::Fragments> read_drawing(const std::string& folder, const cases::Case& c);

/// The abilities of a backend that another machine, which only draws fragments, shares: the
/// promises and limits, but not the driver, because the machine's driver may have other known
/// defects.
About drawn_about(About promiser);

/// Fills a folder with cases.
class CaseFolder {
 public:
  /// Makes the folder. Fails if it exists and is not empty.
  static Result<CaseFolder> make(const std::string& folder);

  /// Writes a case, unless the folder has it already. `promised` is the promise for the case of
  /// whoever draws it.
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
