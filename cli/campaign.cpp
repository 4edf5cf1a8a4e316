#include "cli/campaign.h"

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
#include "cases/json.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/commit.h"
#include "cli/conduct.h"
#include "cli/corpus_folder.h"
#include "cli/environment.h"
#include "cli/gate.h"
#include "cli/github.h"
#include "cli/interrupt.h"
#include "cli/isolation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "cli/run_results.h"
#include "cli/scene.h"
#include "cli/shard_option.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/plan_run.h"
#include "properties/campaign/side_by_side.h"
#include "properties/inspect/looks.h"
#include "records/run.h"
#include "records/share.h"
#include "records/summary.h"
#include "reports/format.h"
#include "reports/summary_table.h"
#include "reports/write.h"

namespace rastercheck::cli {
namespace {

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
  Work work{*std::move(start), {}, std::nullopt};
  const records::Plan& plan = work.start.plan;
  Result<std::vector<cases::Case>> corpus = properties::corpus_of(plan, corpus_folder_of(plan));
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
Result<std::optional<RunGate>> prepare_gate(const IsGiven& is_given, RunOptions& options) {
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
            .and_then(
                [&](const gate::CaseSet& set) { return take_case_set(is_given, set, options); });
    if (!taken) return tl::unexpected(taken.error());
  }
  return read_policy(options.policy).map([&baseline](gate::Policy policy) {
    return std::optional(RunGate{*std::move(baseline), std::move(policy)});
  });
}

/// Checks the run's contract (check_contract), if there is a baseline.
Result<void> check_gate(const std::optional<RunGate>& gate, const records::Plan& plan) {
  if (!gate || !plan.contract) return {};
  return gate::case_set_for(gate->baseline, plan.backends, environment(1, 0))
      .and_then([&plan](const gate::CaseSet& set) { return check_contract(set, plan); });
}

/// Compares the run with the baseline, if given.
ExitCode hold_run(const RunOptions& options, const std::optional<RunGate>& gate,
                  const records::Run& run) {
  if (!gate) return ExitCode::ok;
  if (run.shard) {
    if (!options.json && !options.quiet) {
      fmt::print(
          "\nA shard can be compared with the baseline once it is merged: rastercheck merge, then "
          "rastercheck compare.\n");
    }
    return ExitCode::ok;
  }
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
ExitCode tell_results(const RunOptions& options, const records::Run& run,
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

}  // namespace

ExitCode run_campaign(RunOptions options, const IsGiven& is_given) {
  const Clock::time_point start = Clock::now();
  if (!options.rerun_failed.empty()) {
    if (const Result<void> taken = take_failed(options); !taken) return fail(taken.error());
  }
  const Result<std::optional<RunGate>> gate = prepare_gate(is_given, options);
  if (!gate) return fail(gate.error());
  Result<Work> work = prepare(options);
  if (!work) return fail(work.error());
  if (const auto same = check_gate(*gate, work->start.plan); !same) {
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

  const ExitCode told = tell_results(options, run, prepared->promises(), seconds.count());
  if (told == ExitCode::usage) return told;
  const ExitCode code = first_of(told, hold_run(options, *gate, run));
  if (is_whole) prepared->remove_checkpoint();
  return is_interrupted() && !is_whole ? first_of(code, ExitCode::interrupted) : code;
}

}  // namespace rastercheck::cli
