#pragma once

// Carries out a plan: runs the campaign, in this process or in several, and makes the run's record.

#include <functional>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/campaign_run.h"
#include "properties/campaign/checkpoint.h"
#include "properties/campaign/known_defects.h"
#include "properties/campaign/run_folder.h"
#include "properties/campaign/workers.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Returns the ids of laws that match one of the patterns, or of all laws if no pattern is given;
/// "@(this|that)" matches either. Fails if a pattern matches no law.
Result<std::vector<std::string>> laws_matching(const std::vector<std::string>& patterns);

/// How a plan is carried out.
struct Conduct {
  std::string directory;  ///< the run's existing folder, which holds the checkpoint
  std::string corpus;     ///< folder of the corpus
  KnownSources known;     ///< lists of known defects
  backends::BackendFactory backends = {};
  int jobs = 1;  ///< number of parallel processes
  /// The command that starts a worker process: a program that calls serve_tasks(), and its first
  /// arguments. `--plan`, `--corpus` and `--known` are appended.
  std::vector<std::string> task_worker = {};
  Warn warn = [](const Error& /*error*/) {};
  /// Returns true to end the run early; called from any thread.
  IsToEnd is_over = [] { return false; };
  bool fail_fast = false;  ///< the first violation ends the run
  /// Called after the search is complete or has ended, before the checkpoint is saved.
  std::function<void()> on_found = [] {};
  /// Makes the callback for progress on `what`: cases or counterexamples.
  std::function<Progress(const char* what)> progress = [](const char* /*what*/) {
    return Progress();
  };
  /// Judges a scene with `jobs` processors, in parallel with the campaign if several are available.
  std::function<Result<Findings>(const KnownByBackend& known, unsigned jobs)> judge_scene = {};
};

/// Returns the command that starts a worker process for tasks of the plan (workers.h).
std::vector<std::string> task_worker_of(const Conduct& conduct, const records::Plan& plan);

class PlanRun {
 public:
  /// Makes backends, reads their known defects and writes the first checkpoint. With `resumes` the
  /// run continues from `start`, and fails if corpus or known defects have changed.
  static Result<PlanRun> prepare(Checkpoint start, std::vector<cases::Case> corpus, Conduct conduct,
                                 bool resumes = false);

  const Checkpoint& start() const { return start_; }
  const std::vector<cases::Case>& corpus() const { return runner_.corpus(); }
  const KnownByBackend& known() const { return known_; }
  const std::vector<records::BackendPromises>& promises() const { return promises_; }

  /// Checks the cases until all are done or the run is to end, then shrinks the counterexamples.
  /// Call once. The checkpoint holds the results as well. Fails if a worker or the oracle fails.
  Result<records::Run> carry_out();

  /// True if the run is complete: nothing is left for a resumed run.
  bool is_whole() const { return campaign_.cases_left() == 0 && campaign_.is_shrunk(); }
  /// Removes the checkpoint.
  void remove_checkpoint() { campaign_.remove(); }

 private:
  PlanRun(Checkpoint start, TaskRunner runner, KnownByBackend known, Conduct conduct);

  Result<void> execute(const std::vector<Task>& tasks, const TaskDone& done,
                       const IsToEnd& is_to_end);
  Result<void> check_all();
  Result<void> find();

  Checkpoint start_;
  TaskRunner runner_;
  KnownByBackend known_;
  Conduct conduct_;
  std::vector<records::BackendPromises> promises_;
  CampaignRun campaign_;
};

}  // namespace rastercheck::properties
