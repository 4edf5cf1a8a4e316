// `rastercheck bisect GOOD BAD -- BUILD…`: the first commit of the user's repository that is worse.

#include "gate/bisect.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "cli/command.h"
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
  gate::BisectPlan plan;
  std::string repository = ".";
  std::string program;
  std::vector<std::string> backends{"cpu"};
  std::uint64_t cases = 100;
  std::uint64_t seed = 1;
  std::string contract;
  std::string corpus;
  KnownOption known;
  double timeout = kDefaultTimeout;
  int jobs = 1;
  bool json = false;
  bool quiet = false;
};

/// This program for other processes, as long as this one lives: its file may be built anew.
std::string program_of_others() { return fmt::format("/proc/{}/exe", ::getpid()); }

/// `rastercheck run`, as the options have it.
std::vector<std::string> run_words(const Options& options) {
  std::vector<std::string> words{options.program.empty() ? program_of_others() : options.program,
                                 "run"};
  const auto add = [&words](const char* name, const std::string& value) {
    words.insert(words.end(), {name, value});
  };
  const auto add_file = [&add](const char* name, const std::string& file) {
    add(name, std::filesystem::absolute(file).string());
  };
  for (const std::string& backend : options.backends) add("--backend", backend);
  add("--cases", std::to_string(options.cases));
  add("--seed", std::to_string(options.seed));
  if (!options.contract.empty()) add_file("--contract", options.contract);
  add_file("--corpus", options.corpus.empty() ? corpus_folder() : options.corpus);
  if (options.known.is_none) {
    words.emplace_back("--no-known");
  } else {
    add_file("--known", options.known.folder());
  }
  add("--timeout", fmt::format("{}", options.timeout));
  add("--jobs", std::to_string(options.jobs));
  return words;
}

ExitCode run(Options options) {
  const Result<std::string> top = gate::work_tree_of(options.repository);
  if (!top) return fail(top.error());
  gate::BisectPlan& plan = options.plan;
  plan.run = run_words(options);
  plan.step = {program_of_others(), "bisect-step"};
  if (!plan.folder.empty()) plan.folder = std::filesystem::absolute(plan.folder).string();
  std::filesystem::current_path(*top);
  // Not the results of a step of CI: each of the runs would add its own to them.
  ::unsetenv("GITHUB_STEP_SUMMARY");

  const InterruptWatch watch("\nrastercheck: ending; what was checked out is checked out again\n");
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
  app.add_option("GOOD", options->plan.good, "A commit that others are held against")->required();
  app.add_option("BAD", options->plan.bad, "A later one that is worse")->required();
  app.add_option("BUILD", options->plan.build,
                 "After --: the command that builds what is judged, at the top of the repository")
      ->required();
  app.add_option("--repository", options->repository, "A folder of the repository")
      ->type_name(kFolder)
      ->capture_default_str();
  app.add_option("--program", options->program,
                 "The rastercheck that BUILD makes, where that is what is judged; without it this "
                 "one runs")
      ->type_name(kFile);
  app.add_option("--backend", options->backends,
                 "What is checked, paths from the top of the repository; may be given several "
                 "times")
      ->type_name(kBackend)
      ->capture_default_str()
      ->allow_extra_args(false);
  app.add_option("--property", options->plan.laws, "Only properties whose id matches, as '*edge*'")
      ->type_name(kProperty)
      ->capture_default_str();
  app.add_option("--cases", options->cases, "Random cases of each property")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--seed", options->seed, "Seed of the random cases")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  add_contract(app, options->contract);
  app.add_option("--corpus", options->corpus,
                 "Folder of case files that every property is checked on first; without it the "
                 "one that comes with the program")
      ->type_name(kFolder);
  add_known(app, options->known);
  app.add_option("--output", options->plan.folder,
                 "Folder, not there yet, that keeps what was drawn and said, and the cases whose "
                 "errors grew")
      ->type_name(kFolder);
  add_timeout(app, options->timeout);
  app.add_option("--jobs", options->jobs, "Processes that work side by side")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  app.add_flag("--json", options->json, "Prints the result as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Says nothing of the commits on the way");
  app.footer(
      "The work tree has to be without changes. GOOD and BAD are built and judged first; git then "
      "bisects between them, on the properties that are worse. What cannot be built or judged is "
      "skipped.\n\n"
      "Example:\n"
      "  rastercheck bisect --backend plugin:./build/mine.so v1.0 HEAD -- make");
  return [options] { return run(*options); };
}

const Registration kRegistration("bisect", "Finds the first commit of a repository that is worse",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::bisect_command
