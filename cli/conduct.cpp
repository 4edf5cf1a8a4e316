#include "cli/conduct.h"

#include <chrono>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/corpus_folder.h"
#include "cli/environment.h"
#include "cli/isolation.h"
#include "cli/own_program.h"
#include "cli/run_options.h"
#include "properties/campaign/corpus.h"
#include "properties/inspect/looks.h"

namespace rastercheck::cli {

properties::Conduct conduct_of(const records::Plan& plan, const std::string& directory, int jobs) {
  properties::Conduct conduct;
  conduct.directory = directory;
  conduct.corpus = corpus_folder_of(plan);
  conduct.known = known_sources_of(plan);
  conduct.backends = properties::factory_for(plan, worker_program());
  conduct.jobs = jobs;
  conduct.task_worker = {kOwnProgram, "task-worker"};
  conduct.warn = [](const Error& error) { fail(error); };
  return conduct;
}

Result<records::Run> run_plan(const records::Plan& asked_for, const std::string& directory,
                              int jobs, const properties::IsToEnd& is_to_end) {
  const auto start = std::chrono::steady_clock::now();
  RunOptions options;
  options.plan = asked_for;
  options.seed = asked_for.seed;
  const Result<records::Plan> plan = make_plan(options);
  if (!plan) return tl::unexpected(plan.error());
  properties::Conduct conduct = conduct_of(*plan, directory, jobs);
  conduct.is_over = is_to_end;
  Result<std::vector<cases::Case>> corpus = properties::corpus_of(*plan, conduct.corpus);
  if (!corpus) return tl::unexpected(corpus.error());
  properties::Checkpoint begin;
  begin.plan = *plan;
  begin.program = RASTERCHECK_VERSION;
  Result<properties::PlanRun> prepared =
      properties::PlanRun::prepare(std::move(begin), *std::move(corpus), conduct);
  if (!prepared) return tl::unexpected(prepared.error());
  Result<records::Run> run = prepared->carry_out();
  prepared->remove_checkpoint();
  if (!run || run->cases_left > 0) return run;
  properties::look_closely(*run, {prepared->corpus(), {}, prepared->known(), nullptr},
                           conduct.backends);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  run->environment = environment_of(run->plan, conduct.backends, jobs, seconds.count());
  return run;
}

}  // namespace rastercheck::cli
