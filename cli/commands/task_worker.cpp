// `rastercheck task-worker`: the process that `rastercheck run --jobs` hands its tasks to. Not for
// users.

#include <memory>

#include "backends/held_backend.h"
#include "cases/contract_json.h"
#include "cli/command.h"
#include "cli/isolation.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/workers.h"

namespace rastercheck::cli::task_worker_command {
namespace {

struct Options {
  std::uint64_t seed = 0;
  std::string corpus;
  std::string known;
  std::string contract;  ///< the text of a contract file
  properties::ShrinkBudget shrinking;
  bool keeps_cases = false;
  double timeout = kDefaultTimeout;
};

ExitCode run(const Options& options) {
  isolate_foreign_backends(options.timeout);
  if (!options.contract.empty()) {
    const Result<cases::ContractTerms> terms =
        cases::parse_contract(options.contract, "--contract");
    if (!terms) return fail(terms.error());
    backends::hold_backends_to(*terms);
  }
  std::vector<cases::Case> corpus;
  if (!options.corpus.empty()) {
    Result<std::vector<cases::Case>> read = properties::read_corpus(options.corpus);
    if (!read) return fail(read.error());
    corpus = *std::move(read);
  }
  properties::TaskRunner runner(options.seed, std::move(corpus), options.shrinking, options.known,
                                options.keeps_cases);
  const Result<void> served = properties::serve_tasks(runner);
  if (!served) return fail_internally(served.error());
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.group("");  // not in --help
  app.add_option("--seed", options->seed)->required();
  app.add_option("--corpus", options->corpus);
  app.add_option("--known", options->known);
  app.add_option("--contract", options->contract);
  app.add_option("--shrink-tries", options->shrinking.tries);
  app.add_option("--shrink-seconds", options->shrinking.seconds);
  app.add_flag("--keep-cases", options->keeps_cases);
  add_timeout(app, options->timeout);
  return [options] { return run(*options); };
}

const Registration kRegistration("task-worker", "Runs tasks of a campaign from standard input",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::task_worker_command
