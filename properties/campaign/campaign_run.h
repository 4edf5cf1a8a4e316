#pragma once

// A campaign on its way: the corpus, saved counterexamples, random cases, and then what was found
// made smaller. What is done is kept in the run's folder as it goes (checkpoint.h), so that nothing
// is lost whatever ends the process, and another one can go on.

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
/// Told of what is done: so many cases, or counterexamples, of so many.
using Progress = std::function<void(std::uint64_t done, std::uint64_t all)>;

/// Cases that violated their law, those of known defects aside.
std::uint64_t violations_of(const Findings& findings);

class CampaignRun {
 public:
  /// Goes on from `start`, whose tasks are those of its plan and of what is `known` of its
  /// backends, into a folder that is there.
  CampaignRun(Checkpoint start, std::string directory, std::size_t corpus_size, Warn warn,
              const KnownByBackend& known = {});

  /// Writes the checkpoint; fails where it cannot be. Asked before the work rather than after it.
  Result<void> begin();

  /// Checks the cases that are not done, the first ones of each law before further ones of any. A
  /// fault of the oracle ends it: findings() has it.
  Result<void> check_cases(const Execute& execute, const Progress& progress);

  /// Adds what is not kept in the checkpoint, as it is found anew each time.
  void add_scene(Findings scene);

  /// Makes smaller what was found. What comes of it once `is_to_end` says so is among the findings,
  /// and not in the checkpoint: who goes on begins with it again.
  Result<void> shrink(const Execute& execute, const IsToEnd& is_to_end, const Progress& progress);

  /// Writes the checkpoint for whoever goes on, or, where all is done and reported, removes it.
  void save();
  void remove();

  const Findings& findings() const { return all_; }
  /// Whether it has found a violation that it did not begin with.
  bool has_new_violation() const { return violations_of(all_) > violations_at_start_; }
  /// Cases that were not checked.
  std::uint64_t cases_left() const;
  /// Whether every counterexample has been made as small as it gets, or its time was up.
  bool is_shrunk() const { return shrink_tasks(all_).empty() && !has_cut_short_; }

 private:
  Result<void> write();
  void write_if_due(bool is_news);

  Checkpoint checkpoint_;
  std::string directory_;
  std::vector<Task> tasks_;
  Warn warn_;
  Findings all_;  ///< with the scene's
  std::uint64_t violations_at_start_ = 0;
  bool has_cut_short_ = false;
  bool has_warned_ = false;
  std::chrono::steady_clock::time_point written_;
};

}  // namespace rastercheck::properties
