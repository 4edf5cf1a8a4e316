#pragma once

// The checkpoint file of a campaign, from which an interrupted run resumes.
//
// The file is replaced atomically whenever a new counterexample is found and at least once a second
// (campaign_run.h), so a process may be killed at any moment. Findings not yet written are found
// again, as case i of a law depends on the seed alone. The file holds merged findings, not those of
// each task, so it does not grow with the campaign, except for the outcomes of cases on several
// backends, which are ranges of numbers (records/case_outcomes.h).

#include <cstddef>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/campaign.h"
#include "records/plan.h"

namespace rastercheck::properties {

struct Checkpoint {
  records::Plan plan;
  std::string corpus_digest;       ///< of the corpus' cases (digest_of)
  std::string known_digest;        ///< of the backends' lists of known defects; empty: none
  std::string program;             ///< the program's version
  std::vector<cases::Case> saved;  ///< counterexamples of earlier runs to check again
  /// [task of tasks_of()] whether the task is done.
  std::vector<bool> is_done;
  Findings findings;
  bool operator==(const Checkpoint&) const = default;
};

/// Returns all tasks except shrinking (campaign.h). With a contract file the cases of known-defect
/// lists are left out: a list describes how a driver breaks its own promises, and the driver may
/// well obey the contract file.
std::vector<Task> tasks_of(const Checkpoint& checkpoint, std::size_t corpus_size,
                           const KnownByBackend& known);

/// A 64-bit digest of the cases, every bit included, in hexadecimal.
std::string digest_of(const std::vector<cases::Case>& cases);

/// Returns the path of the checkpoint file in a run's folder.
std::string checkpoint_file(const std::string& directory);

std::string to_json(const Checkpoint& checkpoint);
/// Refuses unknown and missing keys, and inconsistent content.
Result<Checkpoint> parse_checkpoint(std::string_view text, const std::string& file);

}  // namespace rastercheck::properties
