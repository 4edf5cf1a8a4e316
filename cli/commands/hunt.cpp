// `rastercheck hunt`: searches for the worst cases of a property on a backend.

#include "properties/campaign/hunt.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>
#include <utility>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/json.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/conduct.h"
#include "cli/contract_option.h"
#include "cli/corpus_folder.h"
#include "cli/environment.h"
#include "cli/hunt_results.h"
#include "cli/hunt_starts.h"
#include "cli/interrupt.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "cli/whole_number.h"
#include "gate/hunted_cases.h"
#include "gate/side.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/plan_run.h"
#include "records/baseline_json.h"
#include "records/run.h"

namespace rastercheck::cli::hunt_command {
namespace {

using properties::Guide;
using Clock = std::chrono::steady_clock;

/// Limits of --max-time: a millisecond and a day.
constexpr double kLeastSeconds = 0.001;
constexpr double kMostSeconds = 86400;

/// Seconds from a signal until the process ends, whatever is being drawn.
constexpr unsigned kGraceSeconds = 10;

/// Ways to draw, as in `rastercheck replay`: hunted cases say themselves whether they have a depth
/// test.
constexpr auto kWays = names_of(cases::DrawBy());

struct Options {
  RunOptions run;  ///< of which this command has backend, property, seed, corpus and the like
  std::string backend = "cpu";
  std::string property{properties::kValuesLaw};
  std::uint64_t steps = 10000;
  std::uint64_t shrink_tries = 300;
  Guide guide = Guide::share;
  bool compares_sampling = false;
  std::vector<std::string> starts;  ///< folders of earlier hunts and runs
  std::string baseline;             ///< file; empty: none
};

/// The hunt, and how it is carried out.
struct Prepared {
  records::Plan plan;
  const properties::Law* law = nullptr;
  properties::HuntPlan hunt;
  properties::Conduct conduct;
  std::vector<cases::Case> corpus;
  /// For contracts and shrinking; tasks have backends of their own.
  std::unique_ptr<backends::Backend> backend;
  std::optional<properties::KnownDefects> known;
  std::optional<gate::Side> baseline;
  /// Of the baseline; its worst cases of earlier hunts are the first of hunt.given.
  gate::CaseSet before;
};

/// Reads the baseline, if given, and adopts the terms by which its cases are judged, so that its
/// figures and those of the hunt's cases are of one kind.
Result<void> take_baseline(const IsGiven& is_given, Options& options, Prepared& prepared) {
  if (options.baseline.empty()) return {};
  Result<gate::Side> side = gate::read_side(options.baseline);
  if (!side) return tl::unexpected(side.error());
  if (side->run) {
    return tl::unexpected(Error{options.baseline, "",
                                "is a run; `rastercheck baseline save` makes a baseline of it"});
  }
  Result<gate::CaseSet> set = gate::case_set_for(*side, {options.backend}, environment(1, 0));
  if (!set) return tl::unexpected(set.error());
  prepared.before = *std::move(set);
  prepared.baseline = *std::move(side);
  return take_terms(is_given, prepared.before, options.run);
}

Result<records::Plan> plan_of(const Options& options) {
  RunOptions run = options.run;
  run.plan.backends = {options.backend};
  run.plan.properties = {options.property};
  run.plan.shrinking.tries = options.shrink_tries;
  return make_plan(run).and_then([&](const records::Plan& plan) -> Result<records::Plan> {
    if (plan.laws.size() == 1) return plan;
    return tl::unexpected(
        Error{"--property", cases::printable(options.property),
              fmt::format("matches {} properties; a hunt needs one", plan.laws.size())});
  });
}

/// Reads and makes what the hunt needs, except the backend.
Result<Prepared> prepare(const IsGiven& is_given, Options options) {
  Prepared prepared;
  if (auto taken = take_baseline(is_given, options, prepared); !taken) {
    return tl::unexpected(taken.error());
  }
  Result<records::Plan> plan = plan_of(options);
  if (!plan) return tl::unexpected(plan.error());
  prepared.plan = *std::move(plan);
  if (const auto same = check_contract(prepared.before, prepared.plan); !same) {
    return tl::unexpected(same.error());
  }
  prepared.law = properties::find_law(prepared.plan.laws.front());
  prepared.conduct = conduct_of(prepared.plan, options.run.output, options.run.jobs);
  Result<std::vector<cases::Case>> corpus = properties::read_corpus(prepared.conduct.corpus);
  if (!corpus) return tl::unexpected(corpus.error());
  prepared.corpus = *std::move(corpus);
  prepared.hunt.given = prepared.before.plan.hunted;
  for (const std::string& folder : options.starts) {
    Result<std::vector<cases::Case>> worst = read_starts(folder, prepared.plan);
    if (!worst) return tl::unexpected(worst.error());
    std::move(worst->begin(), worst->end(), std::back_inserter(prepared.hunt.given));
  }
  if (prepared.hunt.given.size() > options.steps) {
    return tl::unexpected(Error{
        "--steps", std::to_string(options.steps),
        fmt::format("is too few for the {} cases to begin with", prepared.hunt.given.size())});
  }
  std::error_code why;
  std::filesystem::create_directories(options.run.output, why);
  if (why) {
    return tl::unexpected(Error{options.run.output, "", "cannot be created: " + why.message()});
  }
  return prepared;
}

/// Makes the backend and sets what depends on it.
Result<void> make_backend(const Options& options, Prepared& prepared) {
  auto backend = prepared.conduct.backends.make(options.backend);
  if (!backend) return tl::unexpected(backend.error());
  prepared.backend = *std::move(backend);
  auto known =
      properties::read_known_defects(prepared.conduct.known, options.backend, *prepared.backend);
  if (!known) return tl::unexpected(known.error());
  prepared.known = *std::move(known);
  // The corpus stays with this process: each task has its case.
  prepared.conduct.corpus.clear();
  prepared.hunt.law = prepared.law->id;
  prepared.hunt.backend = options.backend;
  prepared.hunt.seed = prepared.plan.seed;
  prepared.hunt.steps = options.steps;
  prepared.hunt.guide = options.guide;
  prepared.hunt.fail_fast = options.run.fail_fast;
  prepared.hunt.capabilities = properties::capabilities_of(*prepared.backend);
  return {};
}

/// Runs tasks in this process, or in --jobs processes.
class Executor {
 public:
  explicit Executor(const Prepared& prepared)
      : prepared_(&prepared),
        runner_(prepared.plan, {}, prepared.conduct.known, prepared.conduct.backends),
        processes_(task_worker_of(prepared.conduct, prepared.plan), prepared.conduct.jobs) {}

  Result<void> operator()(const std::vector<properties::Task>& tasks,
                          const properties::TaskDone& done) {
    const properties::Conduct& conduct = prepared_->conduct;
    if (conduct.jobs == 1) return run_tasks(runner_, tasks, done, conduct.is_over);
    return processes_.run(tasks, done, conduct.is_over);
  }

 private:
  const Prepared* prepared_;
  properties::TaskRunner runner_;
  properties::TaskProcesses processes_;  ///< kept from round to round
};

/// Searches, with a bar of progress.
Result<properties::HuntOutcome> search(const Prepared& prepared, bool is_guided,
                                       const properties::Execute& execute, ProgressBar& bar) {
  properties::HuntPlan plan = prepared.hunt;
  plan.is_guided = is_guided;
  const char* const what = is_guided ? "steps" : "steps of sampling";
  return properties::hunt(
      plan, prepared.corpus, *prepared.backend, execute,
      [&bar, what](std::uint64_t done, std::uint64_t all) { bar.show(done, all, what); });
}

/// The worst of each niche, shrunk.
void take_trophies(const Prepared& prepared, HuntResults& results, ProgressBar& bar) {
  const auto& niches = results.hunted.archive.niches();
  const properties::ShrinkLimits limits{prepared.plan.shrinking.tries, prepared.conduct.is_over};
  for (const auto& [niche, entries] : niches) {
    bar.show(results.trophies.size(), niches.size(), "worst cases shrunk");
    results.trophies.push_back(properties::trophy_of(*prepared.law, prepared.hunt, entries.front(),
                                                     *prepared.backend, limits,
                                                     prepared.known ? &*prepared.known : nullptr));
  }
}

Result<void> shrink_counterexamples(HuntResults& results, const properties::Execute& execute) {
  properties::Findings findings;
  findings.counterexamples = results.hunted.counterexamples;
  const std::vector<properties::Task> tasks = properties::shrink_tasks(findings);
  Result<void> done = execute(tasks, [&](std::size_t /*task*/, properties::Findings found) {
    merge(findings, std::move(found));
    return !findings.fault;
  });
  if (!done) return done;
  if (findings.fault) results.hunted.fault = findings.fault;
  results.counterexamples = std::move(findings.counterexamples);
  return {};
}

/// Writes a case into a folder that is made if necessary; if that fails, writing the file does too.
Result<void> write_case(const std::filesystem::path& file, const cases::Case& c) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  return cases::write_file(file.string(), cases::to_json(c));
}

/// The file of a trophy. Seed and step are part of the name, so that another hunt with the same
/// folder leaves it alone.
std::string file_of(const properties::HuntTrophy& trophy, std::uint64_t seed) {
  const properties::HuntedError& error = trophy.entry.error;
  return fmt::format("worst/{}-{}-seed-{}-step-{}.json", records::to_string(error.kind),
                     records::file_word(records::to_string(error.stratum)), seed,
                     trophy.entry.step);
}

Result<void> write_files(const Options& options, const Prepared& prepared, HuntResults& results) {
  const std::filesystem::path folder(options.run.output);
  for (properties::HuntTrophy& trophy : results.trophies) {
    const std::filesystem::path file = folder / file_of(trophy, prepared.plan.seed);
    trophy.entry.source.name = file.stem().string();
    if (auto written = write_case(file, trophy.entry.source); !written) return written;
    results.trophy_files.push_back(file.string());
  }
  for (const records::Counterexample& one : results.counterexamples) {
    const std::filesystem::path file = folder / records::file_of(one);
    if (auto written = write_case(file, one.source); !written) return written;
    results.counterexample_files.push_back(file.string());
  }
  return {};
}

/// The worst cases that the baseline lacks, as cases of a corpus. Leaves out those that do not err
/// again, as print_hunt() says of each.
std::vector<cases::Case> new_cases(const Prepared& prepared, HuntResults& results) {
  std::vector<cases::Case> worst;
  for (const properties::HuntTrophy& trophy : results.trophies) {
    const properties::HuntEntry& entry = trophy.entry;
    // The first given cases are the baseline's.
    if (entry.made_by == properties::HuntSource::given &&
        entry.step < prepared.before.plan.hunted.size()) {
      ++results.in_baseline->there;
      continue;
    }
    if (!trophy.errs_again) continue;
    worst.push_back(entry.source);
    worst.back().found.reset();
  }
  return worst;
}

/// Adds the worst cases to the baseline, if given: to the backend's section, and to those of other
/// backends that had the same cases, so that one run can still be compared with all.
Result<void> add_to_baseline(const Options& options, Prepared& prepared, HuntResults& results) {
  if (!prepared.baseline) return {};
  results.in_baseline = HuntResults::InBaseline{options.baseline};
  const std::vector<cases::Case> worst = new_cases(prepared, results);
  if (worst.empty()) return {};
  const auto facts = environment(1, 0);
  records::Baseline& baseline = prepared.baseline->sections;
  for (records::BaselineSection& section : baseline.sections) {
    const std::string& backend = section.key.backend == records::section_name(options.backend)
                                     ? options.backend
                                     : section.taken.backend;
    const Result<gate::CaseSet> set = gate::case_set_for(*prepared.baseline, {backend}, facts);
    const bool is_alike =
        set && set->section == to_string(section.key) && set->plan == prepared.before.plan;
    if (!is_alike) continue;
    properties::Conduct conduct = prepared.conduct;
    conduct.corpus = corpus_folder_of(prepared.plan);
    if (auto added = gate::add_hunted(section, backend, worst, conduct); !added) return added;
  }
  results.in_baseline->added = worst.size();
  return cases::write_file(options.baseline, records::to_json(baseline));
}

ExitCode code_of(const Options& options, const HuntResults& results) {
  if (results.hunted.violations > 0 || (results.sampled && results.sampled->violations > 0)) {
    return ExitCode::violated;
  }
  if (is_interrupted() && results.hunted.steps < options.steps) return ExitCode::interrupted;
  return results.hunted.archive.niches().empty() ? ExitCode::nothing_checked : ExitCode::ok;
}

ExitCode run(const Options& options, const IsGiven& is_given) {
  const Clock::time_point start = Clock::now();
  Result<Prepared> prepared = prepare(is_given, options);
  if (!prepared) return fail(prepared.error());
  if (const ExitCode code = check_backends(prepared->conduct.backends, {options.backend});
      code != ExitCode::ok) {
    return code;
  }
  if (const auto made = make_backend(options, *prepared); !made) return fail(made.error());
  const InterruptWatch watch("\nrastercheck: stopping; press Ctrl-C again to stop at once.\n",
                             kGraceSeconds,
                             "rastercheck: stopped before the results were written.\n");
  Clock::time_point end = Clock::time_point::max();
  if (options.run.max_time) {
    end = start + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>(*options.run.max_time));
  }
  prepared->conduct.is_over = [end] { return is_interrupted() || Clock::now() >= end; };

  ProgressBar bar(options.run.quiet || options.run.json);
  Executor executor(*prepared);
  const properties::Execute execute = std::ref(executor);
  HuntResults results;
  Result<properties::HuntOutcome> hunted = search(*prepared, true, execute, bar);
  if (!hunted) return fail_internally(hunted.error());
  results.hunted = *std::move(hunted);
  if (options.compares_sampling && !results.hunted.fault) {
    Result<properties::HuntOutcome> sampled = search(*prepared, false, execute, bar);
    if (!sampled) return fail_internally(sampled.error());
    results.sampled = *std::move(sampled);
  }
  take_trophies(*prepared, results, bar);
  const Result<void> shrunk = shrink_counterexamples(results, execute);
  bar.erase();
  if (!shrunk) return fail_internally(shrunk.error());
  if (results.hunted.fault) {
    return fail_internally({"the oracle", "", *results.hunted.fault});
  }
  if (const auto written = write_files(options, *prepared, results); !written) {
    return fail(written.error());
  }
  // The table is printed even if the baseline cannot be changed.
  const Result<void> added = add_to_baseline(options, *prepared, results);
  if (!added) results.in_baseline.reset();
  if (options.run.json) {
    print_hunt_json(prepared->hunt, results);
  } else {
    print_hunt(prepared->hunt, results, options.run.quiet);
  }
  return added ? code_of(options, results) : fail(added.error());
}

void add_judging(CLI::App& app, Options& options) {
  records::Plan& plan = options.run.plan;
  add_contract(app, options.run.contract);
  add_promise(app, plan.promise);
  add_draw_by(app, plan.draw_by, std::span(kWays).first(2))
      ->description("How drivers with several ways to draw do so (see rastercheck run --help)");
  add_known(app, plan);
  add_timeout(app, plan.timeout);
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("--backend", options->backend,
                 "Backend to hunt on (see rastercheck list backends)")
      ->type_name(kBackend)
      ->capture_default_str();
  app.add_option("--property", options->property,
                 "The property whose check measures errors (see rastercheck list properties)")
      ->type_name(kProperty)
      ->capture_default_str();
  app.add_option("--steps", options->steps, "Cases to check; the same number gives the same result")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--max-time", options->run.max_time,
                 "Stop after this many seconds, with the result of as many whole rounds of steps")
      ->check(CLI::Range(kLeastSeconds, kMostSeconds))
      ->type_name("SECONDS");
  app.add_option("--seed", options->run.seed,
                 "Seed of the hunt and of its random cases; default: random")
      ->transform(whole_number())
      ->type_name("N");
  app.add_option_function<std::string>(
         "--guide",
         [options](const std::string& name) { options->guide = *cases::from_name<Guide>(name); },
         "The quantity to raise: share, the error beyond what the contract leaves open as a share "
         "of the bound, or error, the error against the exact triangle; default: share")
      ->check(CLI::IsMember({"share", "error"}))
      ->type_name("GUIDE");
  app.add_flag("--compare-sampling", options->compares_sampling,
               "Also check as many random cases, without a guide, and show their worst");
  app.add_option("--corpus", options->run.plan.corpus,
                 "Folder of case files to start from, besides random cases; default: the corpus "
                 "that comes with the program")
      ->type_name(kFolder);
  app.add_option("--start", options->starts,
                 "Output folders of earlier hunts or runs; the first steps check their worst cases")
      ->type_name(kFolder);
  app.add_option("--baseline", options->baseline,
                 "Baseline to which the worst cases are added; runs with --baseline check them")
      ->type_name(kFile);
  app.add_flag("--fail-fast", options->run.fail_fast,
               "Stop at the first violation that is not a known defect");
  app.add_option("--shrink-tries", options->shrink_tries,
                 "Smaller cases to try for each worst case and counterexample; 0 leaves them as "
                 "found")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  options->run.output = "rastercheck-out/hunt";
  app.add_option("--output", options->run.output, "Folder for the cases found")
      ->type_name(kFolder)
      ->capture_default_str();
  add_judging(app, *options);
  app.add_option("--jobs", options->run.jobs, "Number of parallel processes")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  app.add_flag("--json", options->run.json, "Print the result as JSON");
  app.add_flag("-q,--quiet", options->run.quiet,
               "Print only the table's rows, and no progress bar");
  app.footer(
      "Exit code 0 if the worst cases are within their bounds, or violations are known; 1 if a "
      "case violated the property otherwise; 4 if the backend cannot run here; 5 if no error was "
      "measured; 130 if the hunt was interrupted.\n\n"
      "Example:\n"
      "  rastercheck hunt --backend cpu:precision=float32 --steps 20000 --seed 1");
  return [options, &app] {
    return run(*options, [&app](const char* option) { return app.count(option) > 0; });
  };
}

const Registration kRegistration("hunt", "Search for the worst cases of a property", &set_up);

}  // namespace
}  // namespace rastercheck::cli::hunt_command
