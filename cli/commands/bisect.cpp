// `rastercheck bisect GOOD BAD -- BUILD…`: finds the first commit of the user's repository that is
// worse.

#include "gate/bisect.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "cases/contract_json.h"
#include "cli/command.h"
#include "cli/conduct.h"
#include "cli/contract_option.h"
#include "cli/corpus_folder.h"
#include "cli/interrupt.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/output.h"
#include "cli/own_program.h"
#include "cli/whole_number.h"
#include "reports/bisect_text.h"

namespace rastercheck::cli::bisect_command {
namespace {

struct Options {
  gate::BisectPlan bisection;
  std::string repository = ".";
  std::string contract;  ///< file
  bool json = false;
  bool quiet = false;
};

/// Returns a path by which other processes can run this program while this process lives, even if
/// the program's file is rebuilt.
std::string program_of_others() { return fmt::format("/proc/{}/exe", ::getpid()); }

/// Makes the options' file names absolute, from the current folder, and reads the contract.
Result<void> settle_files(Options& options) {
  records::Plan& plan = options.bisection.plan;
  const auto absolute = [](const std::string& file) {
    return std::filesystem::absolute(file).string();
  };
  plan.corpus = absolute(corpus_folder_of(plan));
  plan.known = known_sources_of(plan);
  for (std::string& source : plan.known) source = absolute(source);
  if (!options.bisection.folder.empty()) {
    options.bisection.folder = absolute(options.bisection.folder);
  }
  options.bisection.draw = &run_plan;
  if (options.contract.empty()) return {};
  return cases::read_contract(options.contract).map([&](const cases::ContractTerms& terms) {
    plan.contract = {options.contract, terms};
  });
}

ExitCode run(Options options) {
  const Result<std::string> top = gate::work_tree_of(options.repository);
  if (!top) return fail(top.error());
  if (const Result<void> settled = settle_files(options); !settled) return fail(settled.error());
  gate::BisectPlan& plan = options.bisection;
  plan.step = {program_of_others(), "bisect-step"};
  std::filesystem::current_path(*top);
  // Runs must not report to the CI step: each would append its own results.
  ::unsetenv("GITHUB_STEP_SUMMARY");

  const InterruptWatch watch(
      "\nrastercheck: stopping; restoring the commit that was checked out\n");
  const auto report = [&options](const std::string& line) {
    if (!options.quiet) print_problem(line + "\n");
  };
  Result<records::BisectOutcome> outcome = gate::bisect(plan, {&is_interrupted, report});
  if (!outcome) return fail(outcome.error());
  if (outcome->is_interrupted) return ExitCode::interrupted;
  if (!plan.folder.empty() && outcome->first.size() == 1) {
    if (const Result<void> saved = gate::save_comparison(plan, *outcome, corpus_folder()); !saved) {
      return fail(saved.error());
    }
  }
  fmt::print("{}{}", options.json ? reports::bisect_json(*outcome) : reports::bisect_text(*outcome),
             options.json ? "\n" : "");
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  gate::BisectPlan& bisection = options->bisection;
  records::Plan& plan = bisection.plan;
  plan.cases_per_law = 100;
  plan.seed = 1;
  app.add_option("GOOD", bisection.good, "Commit that others are compared with")->required();
  app.add_option("BAD", bisection.bad, "Later commit that is worse")->required();
  app.add_option("BUILD", bisection.build,
                 "After --: command that builds what is judged, run at the top of the repository")
      ->required();
  app.add_option("--repository", options->repository, "Any folder of the repository")
      ->type_name(kFolder)
      ->capture_default_str();
  app.add_option(
         "--program", bisection.program,
         "The rastercheck that BUILD creates, if rastercheck itself is judged; default: this one")
      ->type_name(kFile);
  app.add_option("--backend", plan.backends,
                 "Backend to check, with paths from the top of the repository; may be repeated")
      ->type_name(kBackend)
      ->capture_default_str()
      ->allow_extra_args(false);
  app.add_option("--property", plan.properties,
                 "Only properties whose id matches, such as '*edge*'")
      ->type_name(kProperty)
      ->allow_extra_args(false);
  app.add_option("--cases", plan.cases_per_law, "Random cases per property")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--seed", plan.seed, "Seed of the random cases")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  add_contract(app, options->contract);
  add_promise(app, plan.promise);
  app.add_option(
         "--corpus", plan.corpus,
         "Folder of case files to check first; default: the corpus that comes with the program")
      ->type_name(kFolder);
  add_known(app, plan);
  app.add_option("--output", bisection.folder,
                 "New folder for drawings, logs and the cases whose errors grew")
      ->type_name(kFolder);
  add_timeout(app, plan.timeout);
  app.add_option("--jobs", bisection.jobs, "Number of parallel processes")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  app.add_flag("--json", options->json, "Print the result as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print no progress for each commit");
  app.footer(
      "The work tree must have no changes. GOOD and BAD are built and judged first; git then "
      "bisects between them on the properties that are worse. Commits that cannot be built or "
      "judged are skipped.\n\n"
      "Example:\n"
      "  rastercheck bisect --backend plugin:./build/mine.so v1.0 HEAD -- make");
  return [options] { return run(*options); };
}

const Registration kRegistration("bisect", "Find the first commit of a repository that is worse",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::bisect_command
