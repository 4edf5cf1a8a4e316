// `rastercheck run`: runs a campaign and writes a folder with its findings.

#include "records/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "backends/factory.h"
#include "cases/contract_json.h"
#include "cases/json.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/commit.h"
#include "cli/conduct.h"
#include "cli/contract_option.h"
#include "cli/corpus_folder.h"
#include "cli/environment.h"
#include "cli/format_option.h"
#include "cli/gate.h"
#include "cli/github.h"
#include "cli/interrupt.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "cli/run_results.h"
#include "cli/scene.h"
#include "cli/shard_option.h"
#include "cli/whole_number.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/plan_run.h"
#include "properties/campaign/side_by_side.h"
#include "properties/inspect/looks.h"
#include "records/share.h"
#include "records/summary.h"
#include "reports/format.h"
#include "reports/summary_table.h"
#include "reports/write.h"

namespace rastercheck::cli::run_command {
namespace {

/// Limits of the values of --shrink-seconds and --max-time: one millisecond and one day.
constexpr double kLeastSeconds = 0.001;
constexpr double kMostSeconds = 86400;
/// Seconds from a signal until the process ends, whatever is being drawn. The checkpoint has the
/// finished work.
constexpr unsigned kGraceSeconds = 2;

using Clock = std::chrono::steady_clock;

/// Returns the time at which the run must end; the latest possible time if it has no limit.
Clock::time_point end_of(const RunOptions& options, Clock::time_point start) {
  if (!options.max_time) return Clock::time_point::max();
  const std::chrono::duration<double> most(*options.max_time);
  return start + std::chrono::duration_cast<Clock::duration>(most);
}

/// Checks that reports can be written, before the work rather than after it.
Result<void> check_output(const RunOptions& options, bool keeps_cases) {
  for (const std::string& name : options.formats) {
    const auto format = reports::find_format(name);
    if (!format) return tl::unexpected(format.error());
    if (format->needs_cases && !keeps_cases) {
      return tl::unexpected(Error{"--format", name, "needs --keep-cases"});
    }
  }
  std::error_code why;
  std::filesystem::create_directories(options.output, why);
  if (why) return tl::unexpected(Error{options.output, "", "cannot be created: " + why.message()});
  return {};
}

/// The work to do, and the files read for it.
struct Work {
  properties::Checkpoint start;
  std::vector<cases::Case> corpus;
  std::optional<cases::Case> scene;
};

Result<Work> prepare(const RunOptions& options) {
  const auto warn = [](const Error& error) { fail(error); };
  Result<properties::Checkpoint> start =
      options.resume
          ? properties::resume_run(options.output, RASTERCHECK_VERSION)
          : make_plan(options).and_then([&](const records::Plan& plan) {
              return properties::begin_run(plan, options.output, warn, options.rerun_failed);
            });
  if (!start) return tl::unexpected(start.error());
  // A new time-out is allowed: it changes only which drawings count as hung.
  if (options.resume && options.plan.timeout != records::Plan().timeout) {
    start->plan.timeout = options.plan.timeout;
  }
  const Result<void> same_shard = check_shard(start->plan, options.shard);
  if (!same_shard) return tl::unexpected(same_shard.error());
  if (!options.baseline.empty() && start->plan.shard) {
    return tl::unexpected(
        Error{"--baseline", "",
              "cannot be used with a shard; merge the shards, then compare the merged run"});
  }
  Work work{*std::move(start), {}, std::nullopt};
  const records::Plan& plan = work.start.plan;
  Result<std::vector<cases::Case>> corpus = properties::read_corpus(corpus_folder_of(plan));
  if (!corpus) return tl::unexpected(corpus.error());
  work.corpus = *std::move(corpus);
  if (!options.resume) work.start.program = RASTERCHECK_VERSION;
  // Only the first shard draws the scene.
  if (!plan.scene.empty() && plan.shard.value_or(records::ShardNumber()).index == 1) {
    Result<cases::Case> scene = read_scene(plan);
    if (!scene) return tl::unexpected(scene.error());
    work.scene = *std::move(scene);
  }
  return work;
}

/// The baseline and policy that the run will be judged by.
struct RunGate {
  gate::Side baseline;
  gate::Policy policy;
};

/// Reads the baseline, if given, and adopts its case set; a resumed run keeps its own.
Result<std::optional<RunGate>> prepare_gate(const CLI::App& app, RunOptions& options) {
  if (options.baseline.empty()) return std::nullopt;
  Result<gate::Side> baseline = gate::read_side(options.baseline);
  if (!baseline) return tl::unexpected(baseline.error());
  const auto inputs = std::to_array<std::string>({baseline->file, options.policy});
  const Result<void> checked =
      check_output_file(options.output + "/run.json", baseline->file).and_then([&] {
        return check_comparison_files(options.output, inputs);
      });
  if (!checked) return tl::unexpected(checked.error());
  if (!options.resume) {
    const auto taken =
        gate::case_set_for(*baseline, options.plan.backends, environment(options.jobs, 0))
            .and_then([&](const gate::CaseSet& set) { return take_case_set(app, set, options); });
    if (!taken) return tl::unexpected(taken.error());
  }
  return read_policy(options.policy).map([&baseline](gate::Policy policy) {
    return std::optional(RunGate{*std::move(baseline), std::move(policy)});
  });
}

/// Checks that the run's contract equals the baseline's, as far as known, before the work rather
/// than after it.
Result<void> check_contract(const std::optional<RunGate>& gate, const records::Plan& plan) {
  if (!gate || !plan.contract) return {};
  const Result<gate::CaseSet> set =
      gate::case_set_for(gate->baseline, plan.backends, environment(1, 0));
  if (!set) return tl::unexpected(set.error());
  if (!set->plan.contract) return {};
  const std::uint64_t digest = cases::digest_of(plan.contract->terms);
  const std::uint64_t then = cases::digest_of(set->plan.contract->terms);
  if (then == digest) return {};
  return tl::unexpected(Error{plan.contract->file, "",
                              fmt::format("differs from the contract of the baseline's section {}: "
                                          "the digest of its terms was {:016x} and is {:016x}",
                                          set->section, then, digest)});
}

/// Compares the run with the baseline, if given.
ExitCode hold_run(const RunOptions& options, const std::optional<RunGate>& gate,
                  const records::Run& run) {
  if (!gate) return ExitCode::ok;
  if (run.cases_left > 0) return ExitCode::interrupted;
  Result<gate::Side> current = gate::side_of(run, options.output);
  if (!current) return fail(current.error());
  gate::set_commit(*current, commit_of(""));
  if (!options.json) fmt::print("\n");
  return hold_against(
      gate->baseline, *current,
      {gate->policy, options.output, false, options.quiet, !options.json, run.plan.timeout});
}

/// Ends a run whose results cannot be written; the terminal already shows its findings.
ExitCode fail_to_write(const RunOptions& options, const Error& error) {
  const ExitCode code = fail(error);
  print_problem(
      fmt::format("rastercheck: the results are printed above but not saved; once the file can be "
                  "written, `rastercheck run --resume --output {}` saves them\n",
                  options.output));
  return code;
}

/// Writes and prints the findings. Returns the exit code of the run alone.
ExitCode tell(const RunOptions& options, const records::Run& run,
              const std::vector<records::BackendPromises>& promises, double seconds) {
  const std::vector<records::LawSummary> rows = records::summarize(run);
  const Result<void> written = reports::write_reports(run, options.output, options.formats);
  if (options.json) {
    fmt::print("{}\n", reports::summary_json(run, rows));
  } else {
    print_results(run, rows, options.output, detail_of(options.quiet, options.all));
    if (!options.quiet) {
      fmt::print("Seed {}, {:.1f} s.{}", run.plan.seed, seconds,
                 written ? " " + where_reports_are(options.output, options.formats) : "\n");
    }
  }
  if (!written) return fail_to_write(options, written.error());
  // For shards, the merge reports to GitHub.
  if (run.shard) return exit_code_of_shard(rows);
  if (const auto told = tell_github(run, options.output, !options.json); !told) fail(told.error());
  return exit_code_of(run, rows, promises);
}

ExitCode run_campaign(RunOptions options, const CLI::App& app) {
  const Clock::time_point start = Clock::now();
  if (!options.rerun_failed.empty()) {
    if (const Result<void> taken = take_failed(options); !taken) return fail(taken.error());
  }
  const Result<std::optional<RunGate>> gate = prepare_gate(app, options);
  if (!gate) return fail(gate.error());
  Result<Work> work = prepare(options);
  if (!work) return fail(work.error());
  if (const auto same = check_contract(*gate, work->start.plan); !same) {
    return fail(same.error());
  }
  const records::Plan& plan = work->start.plan;
  if (const auto can_write = check_output(options, plan.keeps_cases); !can_write) {
    return fail(can_write.error());
  }
  // Checked last, because unreadable input takes precedence over backends that cannot run.
  properties::Conduct conduct = conduct_of(plan, options.output, options.jobs);
  if (const ExitCode code = check_backends(conduct.backends, plan.backends); code != ExitCode::ok) {
    return code;
  }
  ProgressBar bar(options.quiet);
  conduct.is_over = [end = end_of(options, start)] {
    return is_interrupted() || Clock::now() >= end;
  };
  conduct.fail_fast = options.fail_fast;
  conduct.on_found = &InterruptWatch::let_it_end;
  conduct.progress = [&bar](const char* what) {
    return [&bar, what](std::uint64_t done, std::uint64_t all) { bar.show(done, all, what); };
  };
  JudgedScene judged;
  if (work->scene) {
    conduct.judge_scene = [&](const properties::KnownByBackend& known, unsigned jobs) {
      return judge_scene_of(plan, *work->scene, conduct.backends, jobs, known)
          .map([&judged](JudgedScene&& scene) {
            judged = std::move(scene);
            return std::exchange(judged.findings, {});
          });
    };
  }
  Result<properties::PlanRun> prepared =
      properties::PlanRun::prepare(work->start, work->corpus, conduct, options.resume);
  if (!prepared) return fail(prepared.error());
  const std::string goes_on =
      fmt::format("`rastercheck run --resume --output {}` continues the run.\n", options.output);
  const InterruptWatch watch(
      "\nrastercheck: stopping; press Ctrl-C again to stop at once. " + goes_on, kGraceSeconds,
      "rastercheck: stopped before its reports were written. " + goes_on);
  Result<records::Run> carried_out = prepared->carry_out();
  if (!carried_out) return fail_internally(carried_out.error());
  records::Run& run = *carried_out;
  run.scenes = std::move(judged.results);
  run.pictures = std::move(judged.pictures);
  run.shard = shard_of(prepared->start(), prepared->promises(), work->scene);
  const bool is_whole = prepared->is_whole();
  if (run.shard) run.shard->is_whole = is_whole;
  run.differences = properties::differences_of(run, work->corpus);
  // Draws cases once more for inspections, however long that takes. An interrupted run gets its
  // inspections when it is resumed.
  if (is_whole || !is_interrupted()) {
    const cases::Case* scene = work->scene ? &*work->scene : nullptr;
    properties::look_closely(run, {work->corpus, work->start.saved, prepared->known(), scene},
                             conduct.backends);
  }
  const std::chrono::duration<double> seconds = Clock::now() - start;
  run.environment = environment_of(run.plan, conduct.backends, options.jobs, seconds.count());
  bar.erase();

  const ExitCode told = tell(options, run, prepared->promises(), seconds.count());
  if (told == ExitCode::usage) return told;
  const ExitCode code = first_of(told, hold_run(options, *gate, run));
  if (is_whole) prepared->remove_checkpoint();
  return is_interrupted() && !is_whole ? first_of(code, ExitCode::interrupted) : code;
}

/// Adds the options that decide how much a "held" means.
void add_scrutiny(CLI::App& app, records::Plan& plan) {
  app.add_option("--power", plan.power,
                 "Damage the drawing of one in N random cases in every way, to see what is "
                 "noticed; 0: of no case")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--require-cases", plan.require_cases,
                 "Exit with code 5 if a property is judged on fewer than N cases")
      ->transform(whole_number())
      ->type_name("N");
}

void add_early_ends(CLI::App& app, RunOptions& options) {
  app.add_flag("--fail-fast", options.fail_fast, "Stop at the first violation");
  app.add_option("--max-time", options.max_time,
                 "Stop checking after this many seconds, with all properties checked about equally "
                 "often, and report what was found; a scene and the reports take extra time; "
                 "--resume continues the run")
      ->check(CLI::Range(kLeastSeconds, kMostSeconds))
      ->type_name("SECONDS");
}

void add_shrinking(CLI::App& app, records::ShrinkBudget& shrinking) {
  app.add_option("--shrink-tries", shrinking.tries,
                 "Smaller cases to try for each counterexample; 0 leaves it as found")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--shrink-seconds", shrinking.seconds,
                 "Time limit for shrinking each counterexample, in seconds; default: none")
      ->check(CLI::Range(kLeastSeconds, kMostSeconds))
      ->type_name("SECONDS");
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<RunOptions>();
  records::Plan& plan = options->plan;
  app.add_option(
         "--backend", plan.backends,
         "Backend to check (see rastercheck list backends); may be repeated, to see several "
         "side by side")
      ->type_name(kBackend)
      ->capture_default_str();
  app.add_option("--property", plan.properties,
                 "Only properties whose id matches, such as '*edge*' (see rastercheck list "
                 "properties); may be repeated")
      ->type_name(kProperty);
  app.add_option("--cases", plan.cases_per_law,
                 "Random cases per property, in addition to the corpus")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--seed", options->seed,
                 "Seed of the random cases; the same seed gives the same cases; default: random")
      ->transform(whole_number())
      ->type_name("N");
  add_shard(app, options->shard);
  app.add_option("--scene", plan.scene, "Mesh or case file to draw and judge as a whole, as well")
      ->type_name(kFile);
  app.add_option("--scene-size", plan.scene_size, "Width and height of a mesh's picture, in pixels")
      ->check(CLI::Range(1, cases::kMaxSize))
      ->type_name("N")
      ->capture_default_str();
  add_contract(app, options->contract);
  add_promise(app, plan.promise);
  add_draw_by(app, plan.draw_by, names_of(cases::DrawBy()))
      ->description(
          "How drivers with several ways to draw do so: append, shaders append fragments to a "
          "buffer; layers, each triangle into a layer of its own; frame, the scene in one draw "
          "with a depth test; default: the way that reads back the least");
  app.add_option(
         "--corpus", plan.corpus,
         "Folder of case files to check first; default: the corpus that comes with the program")
      ->type_name(kFolder);
  add_known(app, plan);
  app.add_option("--output", options->output, "Folder for the results")
      ->type_name(kFolder)
      ->capture_default_str();
  add_formats(app, options->formats);
  add_shrinking(app, plan.shrinking);
  add_timeout(app, plan.timeout);
  add_scrutiny(app, plan);
  app.add_flag("--keep-cases", plan.keeps_cases,
               "Keep the result of each case in run.json, for a baseline and for --format cases");
  add_early_ends(app, *options);
  CLI::Option* rerun = app.add_option("--rerun-failed", options->rerun_failed,
                                      "Check the properties that the run in this folder found "
                                      "violated, with its cases and settings")
                           ->type_name(kFolder);
  CLI::Option* baseline = app.add_option("--baseline", options->baseline,
                                         "Compare the run with this baseline (rastercheck baseline "
                                         "save), using its seed and cases")
                              ->type_name(kFile);
  app.add_option("--policy", options->policy,
                 "With --baseline: file that says what may be worse, why and until when")
      ->needs(baseline)
      ->type_name(kFile);
  CLI::Option* resume =
      app.add_flag("--resume", options->resume,
                   "Continue the interrupted run in the --output folder, with its options");
  for (const char* settled :
       {"--backend", "--property", "--cases", "--seed", "--scene", "--scene-size", "--contract",
        "--promise", "--draw-by", "--corpus", "--known", "--no-known", "--shrink-tries",
        "--shrink-seconds", "--power", "--require-cases", "--keep-cases"}) {
    resume->excludes(settled);
    rerun->excludes(settled);
  }
  rerun->excludes(resume)->excludes(baseline)->excludes("--timeout");
  // A partial run cannot be compared.
  baseline->excludes("--max-time")->excludes("--fail-fast");
  app.add_option("--jobs", options->jobs, "Number of parallel processes")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  app.add_flag("--json", options->json, "Print the table as JSON");
  CLI::Option* quiet = app.add_flag("-q,--quiet", options->quiet,
                                    "Print only the table's rows, and no progress bar");
  app.add_flag("--all", options->all, kAllHelp)->excludes(quiet);
  app.footer(
      "Exit code 0 if every property held or was violated in known ways only, 1 if one was "
      "violated otherwise, 3 if one is worse than the baseline, 4 if a backend cannot run here, 5 "
      "if one checked nothing, 130 if the run was interrupted. If a run ends early, the code says "
      "what was found until then.\n\n"
      "Examples:\n"
      "  rastercheck run --backend vulkan:lavapipe --cases 100 --jobs 4\n"
      "  rastercheck run --backend plugin:./mine.so --property '*edge*' --seed 1\n"
      "  rastercheck run --backend gl:llvmpipe --backend gl:softpipe   (side by side)\n"
      "  rastercheck run --scene bunny.obj");
  return [options, &app] { return run_campaign(*options, app); };
}

const Registration kRegistration("run", "Check every property on the corpus and on random cases",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::run_command
