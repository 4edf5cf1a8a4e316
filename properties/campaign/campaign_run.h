#pragma once

// A campaign in progress: checks corpus, saved counterexamples and random cases, then shrinks the
// counterexamples found. Saves progress in the run's folder as it goes (checkpoint.h), so that
// another process can resume after any interruption.

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "cases/error.h"
#include "properties/campaign/checkpoint.h"
#include "properties/campaign/run_folder.h"
#include "properties/campaign/workers.h"

namespace rastercheck::properties {

/// Runs tasks, in this process or in others.
using Execute = std::function<Result<void>(const std::vector<Task>&, const TaskDone&)>;
/// Called with progress: `done` of `all` cases or counterexamples.
using Progress = std::function<void(std::uint64_t done, std::uint64_t all)>;

/// Number of cases that violated their law, not counting known defects.
std::uint64_t violations_of(const Findings& findings);

class CampaignRun {
 public:
  /// Resumes from `start` in an existing folder. The tasks follow from the plan and from the
  /// `known` defects of its backends.
  CampaignRun(Checkpoint start, std::string directory, std::size_t corpus_size, Warn warn,
              const KnownByBackend& known = {});

  /// Writes the first checkpoint, to fail before the work rather than after it.
  Result<void> begin();

  /// Checks the remaining cases: the first cases of every law before further cases of any law.
  /// Stops at a fault of the oracle, which findings() then holds.
  Result<void> check_cases(const Execute& execute, const Progress& progress);

  /// Adds a scene's findings. The checkpoint does not keep these; a resumed run computes them anew.
  void add_scene(Findings scene);

  /// Shrinks the counterexamples. Results that are cut short by `is_to_end` go to the findings but
  /// not to the checkpoint, so a resumed run shrinks them again.
  Result<void> shrink(const Execute& execute, const IsToEnd& is_to_end, const Progress& progress);

  /// save() writes the checkpoint for a later run; remove() deletes it once all is done and
  /// reported.
  void save();
  void remove();

  const Findings& findings() const { return all_; }
  /// True if the run found a violation that the checkpoint it started from did not contain.
  bool has_new_violation() const { return violations_of(all_) > violations_at_start_; }
  /// Number of cases not checked.
  std::uint64_t cases_left() const;
  /// True if shrinking is complete: each counterexample is minimal or used up its budget.
  bool is_shrunk() const { return shrink_tasks(all_).empty() && !has_cut_short_; }

 private:
  Result<void> write();
  void write_if_due(bool is_news);

  Checkpoint checkpoint_;
  std::string directory_;
  std::vector<Task> tasks_;
  Warn warn_;
  Findings all_;  ///< includes the findings of the scene
  std::uint64_t violations_at_start_ = 0;
  bool has_cut_short_ = false;
  bool has_warned_ = false;
  std::chrono::steady_clock::time_point written_;
  std::chrono::steady_clock::duration write_time_{};  ///< how long the last write took
};

}  // namespace rastercheck::properties
