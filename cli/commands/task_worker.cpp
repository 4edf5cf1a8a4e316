// `rastercheck task-worker`: the process to which `rastercheck run --jobs` hands tasks. Not for
// users.

#include <memory>

#include "cases/json_node.h"
#include "cli/command.h"
#include "cli/isolation.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/workers.h"
#include "records/plan_json.h"

namespace rastercheck::cli::task_worker_command {
namespace {

struct Options {
  std::string plan;  ///< records/plan_json.h
  std::string corpus;
  properties::KnownSources known;
};

ExitCode run(const Options& options) {
  const Result<records::Plan> plan =
      cases::read_json(options.plan, "--plan", &cases::read_as<records::Plan>);
  if (!plan) return fail(plan.error());
  std::vector<cases::Case> corpus;
  if (!options.corpus.empty()) {
    Result<std::vector<cases::Case>> read = properties::corpus_of(*plan, options.corpus);
    if (!read) return fail(read.error());
    corpus = *std::move(read);
  }
  properties::TaskRunner runner(*plan, std::move(corpus), options.known,
                                properties::factory_for(*plan, worker_program()));
  const Result<void> served = properties::serve_tasks(runner);
  if (!served) return fail_internally(served.error());
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.group("");  // not in --help
  app.add_option("--plan", options->plan)->required();
  app.add_option("--corpus", options->corpus);
  app.add_option("--known", options->known);
  return [options] { return run(*options); };
}

const Registration kRegistration("task-worker", "Run tasks of a campaign from standard input",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::task_worker_command
