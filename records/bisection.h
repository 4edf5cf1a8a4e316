#pragma once

// The result of a search for the first commit that is worse (gate/bisect.h).

#include <cstdint>
#include <string>
#include <vector>

#include "records/comparison.h"

namespace rastercheck::records {

/// Identifies a commit for people.
struct CommitTitle {
  std::string hash;
  std::string date;  ///< the author's date, "2026-11-23"
  std::string author;
  std::string subject;
  bool operator==(const CommitTitle&) const = default;
};

struct BisectOutcome {
  bool is_interrupted = false;  ///< if true, no other member is known
  CommitTitle good;
  CommitTitle bad;
  /// The figures that are worse in `bad`, over all requested laws.
  std::vector<Comparison> of_bad;
  /// The first commit that is worse. Several candidates, newest first, if the commits between
  /// cannot be judged. Empty if `bad` is not worse.
  std::vector<CommitTitle> first;
  /// The figures that are worse in that commit, over the laws that are worse in `bad`. Empty if
  /// `first` has several candidates.
  std::vector<Comparison> of_first;
  /// Files of the runs of `good` and of the first worse commit; only if the plan names a folder.
  std::string good_run;
  std::string first_run;
  /// Folder that holds the saved cases of `of_first` (reports/compare_format.h); empty if not
  /// saved.
  std::string comparison;
  std::uint64_t commits = 0;  ///< number of commits after `good` up to `bad`
  std::uint64_t tried = 0;    ///< drawn and judged, including `good` and `bad`
  std::uint64_t skipped = 0;
};

}  // namespace rastercheck::records
