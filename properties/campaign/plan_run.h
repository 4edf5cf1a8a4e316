#pragma once

// A plan carried out: the campaign, in this process or in several, and the run that comes of it.

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

/// The ids of the laws that match one of the patterns, of all laws without any; "@(this|that)"
/// matches either. Fails where a pattern matches none.
Result<std::vector<std::string>> laws_matching(const std::vector<std::string>& patterns);

/// How a plan is carried out.
struct Conduct {
  std::string directory;  ///< of the run, which is there: the checkpoint is kept in it
  std::string corpus;     ///< folder of the cases that come first
  KnownSources known;     ///< lists of what is known of backends
  backends::BackendFactory backends = {};
  int jobs = 1;  ///< processes that work side by side
  /// Starts one of several such processes: a program that calls serve_tasks(), and its first
  /// arguments. `--plan`, `--corpus` and `--known` are added.
  std::vector<std::string> task_worker = {};
  Warn warn = [](const Error& /*error*/) {};
  /// Ends it early; called from any thread.
  IsToEnd is_over = [] { return false; };
  bool fail_fast = false;  ///< a violation ends it, too
  /// Called when all is found, or it has ended, before that is kept in the checkpoint.
  std::function<void()> on_found = [] {};
  /// Makes what is told of the cases, or counterexamples, that are done.
  std::function<Progress(const char* what)> progress = [](const char* /*what*/) {
    return Progress();
  };
  /// Judges a scene on so many processors, side by side with the campaign if there are several.
  std::function<Result<Findings>(const KnownByBackend& known, unsigned jobs)> judge_scene = {};
};

class PlanRun {
 public:
  /// Makes backends, reads what is known of them and writes the first checkpoint. With `resumes`
  /// the run goes on from `start`, and fails where corpus or known defects are other ones.
  static Result<PlanRun> prepare(Checkpoint start, std::vector<cases::Case> corpus, Conduct conduct,
                                 bool resumes = false);

  const Checkpoint& start() const { return start_; }
  const std::vector<cases::Case>& corpus() const { return runner_.corpus(); }
  const KnownByBackend& known() const { return known_; }
  const std::vector<records::BackendPromises>& promises() const { return promises_; }

  /// Checks all cases, or as many as it may, and makes smaller what was found; once. Its results
  /// are in the checkpoint as well. Fails where a worker or the oracle does.
  Result<records::Run> carry_out();

  /// Whether nothing is left for another run to go on with.
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
