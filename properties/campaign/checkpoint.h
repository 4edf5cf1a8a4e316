#pragma once

// How far a campaign has come, as a file: what an interrupted run goes on from.
//
// The file is written anew, whole or not at all, whenever there is a new counterexample and at
// least once a second (campaign_run.h), so that a process may be killed at any moment: what it had
// found is there, and what it had not yet written is found again, as case i of a law depends on the
// seed alone. It holds the findings merged, not what each task found, and so does not grow with the
// campaign.

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
  std::string program;             ///< version
  std::vector<cases::Case> saved;  ///< counterexamples of earlier runs that are checked again
  /// Of tasks_of() the plan, the corpus and `saved`: whether it is done.
  std::vector<bool> is_done;
  Findings findings;
  bool operator==(const Checkpoint&) const = default;
};

/// All that the run does but for shrinking (tasks_of of its campaign). Lists of known defects are
/// of what drivers promise by themselves: held to a contract file they may well be right, and the
/// cases of these lists are left out.
std::vector<Task> tasks_of(const Checkpoint& checkpoint, std::size_t corpus_size,
                           const KnownByBackend& known);

/// A word that tells cases apart that differ in a bit: 64 bits, in hexadecimal.
std::string digest_of(const std::vector<cases::Case>& cases);

/// The file in a run's folder.
std::string checkpoint_file(const std::string& directory);

std::string to_json(const Checkpoint& checkpoint);
/// Refuses unknown and missing keys, and whatever does not go together.
Result<Checkpoint> parse_checkpoint(std::string_view text, const std::string& file);

}  // namespace rastercheck::properties
