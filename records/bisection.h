#pragma once

// The result of a search for the first commit that is worse (gate/bisect.h).

#include <cstdint>
#include <string>
#include <vector>

#include "records/comparison.h"

namespace rastercheck::records {

/// What people know a commit by.
struct CommitTitle {
  std::string hash;
  std::string date;  ///< of its author, "2026-11-23"
  std::string author;
  std::string subject;
  bool operator==(const CommitTitle&) const = default;
};

struct BisectOutcome {
  bool is_interrupted = false;  ///< nothing else is known then
  CommitTitle good;
  CommitTitle bad;
  /// What is worse of `bad`; of all laws that were asked for.
  std::vector<Comparison> of_bad;
  /// The first commit that is worse; several where it is one of them, as those between cannot be
  /// judged, the newest first; none where `bad` is not worse.
  std::vector<CommitTitle> first;
  /// What is worse of it; of the laws that are worse of `bad`. Nothing where it is one of several.
  std::vector<Comparison> of_first;
  /// Files of the runs of `good` and of the first, where the plan's folder has a name.
  std::string good_run;
  std::string first_run;
  /// Folder in which the cases of `of_first` are saved (reports/compare_format.h); empty where they
  /// are not.
  std::string comparison;
  std::uint64_t commits = 0;  ///< after `good` up to `bad`
  std::uint64_t tried = 0;    ///< drawn and judged, `good` and `bad` among them
  std::uint64_t skipped = 0;
};

}  // namespace rastercheck::records
