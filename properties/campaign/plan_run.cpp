#include "properties/campaign/plan_run.h"

#include <fnmatch.h>

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "cases/json.h"
#include "properties/campaign/causes.h"
#include "properties/law.h"
#include "records/plan_json.h"

namespace rastercheck::properties {
namespace {

bool matches(const std::string& name, const std::string& pattern) {
  return ::fnmatch(pattern.c_str(), name.c_str(), FNM_EXTMATCH) == 0;
}

/// Returns the run's record before anything is checked.
records::Run planned(const records::Plan& plan, const KnownByBackend& known) {
  records::Run run;
  run.plan = plan;
  for (const std::string& id : plan.laws) {
    if (const Law* law = find_law(id)) run.sentences[id] = law->sentence;
  }
  for (const auto& [backend, defects] : known) {
    run.known.insert(run.known.end(), defects.lists.begin(), defects.lists.end());
  }
  return run;
}

}  // namespace

Result<std::vector<std::string>> laws_matching(const std::vector<std::string>& patterns) {
  for (const std::string& pattern : patterns) {
    const auto is_meant = [&](const Law& law) { return matches(std::string(law.id), pattern); };
    if (std::none_of(laws().begin(), laws().end(), is_meant)) {
      return tl::unexpected(Error{"--property", cases::printable(pattern),
                                  "no property is called this; use stars to match part of a name, "
                                  "such as '*edge*' (see rastercheck list properties)"});
    }
  }
  std::vector<std::string> ids;
  for (const Law& law : laws()) {
    std::string id(law.id);
    const auto is_of = [&](const std::string& pattern) { return matches(id, pattern); };
    const bool is_chosen = patterns.empty() || std::any_of(patterns.begin(), patterns.end(), is_of);
    if (is_chosen) ids.push_back(std::move(id));
  }
  return ids;
}

std::vector<std::string> task_worker_of(const Conduct& conduct, const records::Plan& plan) {
  std::vector<std::string> command = conduct.task_worker;
  command.insert(command.end(),
                 {"--plan", cases::json_line(cases::json_of(plan)), "--corpus", conduct.corpus});
  for (const std::string& source : conduct.known) {
    command.insert(command.end(), {"--known", source});
  }
  return command;
}

Result<PlanRun> PlanRun::prepare(Checkpoint start, std::vector<cases::Case> corpus, Conduct conduct,
                                 bool resumes) {
  TaskRunner runner(start.plan, std::move(corpus), conduct.known, conduct.backends);
  Result<KnownByBackend> known = runner.known();
  if (!known) return tl::unexpected(known.error());
  if (resumes) {
    const Result<void> same = check_same(start, runner.corpus(), *known);
    if (!same) return tl::unexpected(same.error());
  } else {
    start.corpus_digest = digest_of(runner.corpus());
    start.known_digest = digest_of_known(*known);
    start.plan.capabilities = runner.capabilities();
    runner.make_cases_for(start.plan.capabilities);
  }
  PlanRun run(std::move(start), std::move(runner), *std::move(known), std::move(conduct));
  if (const Result<void> begun = run.campaign_.begin(); !begun) {
    return tl::unexpected(begun.error());
  }
  return run;
}

PlanRun::PlanRun(Checkpoint start, TaskRunner runner, KnownByBackend known, Conduct conduct)
    : start_(std::move(start)),
      runner_(std::move(runner)),
      known_(std::move(known)),
      conduct_(std::move(conduct)),
      promises_(runner_.promises()),
      campaign_(start_, conduct_.directory, runner_.corpus().size(), conduct_.warn, known_) {}

Result<records::Run> PlanRun::carry_out() {
  const Result<void> found = find();
  conduct_.on_found();
  campaign_.save();
  if (!found) return tl::unexpected(found.error());
  const Findings& findings = campaign_.findings();
  if (findings.fault) return tl::unexpected(Error{"the oracle", "", *findings.fault});
  records::Run run = planned(start_.plan, known_);
  run.records = findings.records;
  run.cases = findings.cases;
  run.outcomes = findings.outcomes;
  run.counterexamples = findings.counterexamples;
  run.causes = causes_of(run.counterexamples);
  run.unexpected = findings.unexpected;
  for (const records::BackendPromises& of_backend : promises_) {
    if (of_backend.promise) run.held_to[of_backend.backend] = *of_backend.promise;
  }
  run.cases_left = campaign_.cases_left();
  // A shard alone cannot tell which labels all shards reach, or which laws always hold.
  if (start_.plan.shard) return run;
  run.unreached = unreached_labels(start_.plan.laws, promises_, run.records);
  if (run.cases_left == 0) add_unexpected_passes(run);
  return run;
}

Result<void> PlanRun::execute(const std::vector<Task>& tasks, const TaskDone& done,
                              const IsToEnd& is_to_end) {
  if (conduct_.jobs == 1) return run_tasks(runner_, tasks, done, is_to_end);
  return run_tasks_in_processes(task_worker_of(conduct_, start_.plan), conduct_.jobs, tasks, done,
                                is_to_end);
}

/// Checks the campaign's cases and the scene, in parallel if several processes may run.
Result<void> PlanRun::check_all() {
  const IsToEnd is_to_end = [this] {
    return conduct_.is_over() || (conduct_.fail_fast && campaign_.has_new_violation());
  };
  const auto check_cases = [&] {
    return campaign_.check_cases(
        [&](const std::vector<Task>& tasks, const TaskDone& done) {
          return execute(tasks, done, is_to_end);
        },
        conduct_.progress("cases"));
  };
  const auto jobs = static_cast<unsigned>(conduct_.jobs);
  if (!conduct_.judge_scene) return check_cases();
  if (jobs == 1) {
    Result<Findings> of_scene = conduct_.judge_scene(known_, 1);
    if (!of_scene) return tl::unexpected(of_scene.error());
    campaign_.add_scene(*std::move(of_scene));
    return check_cases();
  }
  auto dispatched = std::async(std::launch::async, check_cases);
  Result<Findings> of_scene = conduct_.judge_scene(known_, jobs);
  Result<void> checked = dispatched.get();
  if (!of_scene) return tl::unexpected(of_scene.error());
  campaign_.add_scene(*std::move(of_scene));
  return checked;
}

Result<void> PlanRun::find() {
  if (Result<void> checked = check_all(); !checked) return checked;
  if (campaign_.findings().fault) return {};
  return campaign_.shrink(
      [this](const std::vector<Task>& tasks, const TaskDone& done) {
        return execute(tasks, done, conduct_.is_over);
      },
      conduct_.is_over, conduct_.progress("counterexamples shrunk"));
}

}  // namespace rastercheck::properties
