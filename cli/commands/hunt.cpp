// `rastercheck hunt`: searches for the worst cases of a property on a backend.

#include "properties/campaign/hunt.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <utility>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "cases/json.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/conduct.h"
#include "cli/contract_option.h"
#include "cli/interrupt.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "cli/terminal.h"
#include "cli/whole_number.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/plan_run.h"
#include "records/run.h"
#include "reports/commands.h"
#include "reports/counterexample_text.h"
#include "reports/text_table.h"

namespace rastercheck::cli::hunt_command {
namespace {

using nlohmann::ordered_json;
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

/// Significant digits of errors in the table. Enclosures are far narrower.
constexpr int kDigits = 4;

struct Options {
  RunOptions run;  ///< of which this command has backend, property, seed, corpus and the like
  std::string backend = "cpu";
  std::string property{properties::kValuesLaw};
  std::uint64_t steps = 10000;
  std::uint64_t shrink_tries = 300;
  Guide guide = Guide::share;
  bool compares_sampling = false;
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
};

/// What was found, with the files.
struct Results {
  properties::HuntOutcome hunted;
  std::optional<properties::HuntOutcome> sampled;  ///< for --compare-sampling
  std::vector<properties::HuntTrophy> trophies;
  std::vector<std::string> trophy_files;
  std::vector<records::Counterexample> counterexamples;  ///< shrunk
  std::vector<std::string> counterexample_files;
};

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
Result<Prepared> prepare(const Options& options) {
  Result<records::Plan> plan = plan_of(options);
  if (!plan) return tl::unexpected(plan.error());
  Prepared prepared;
  prepared.plan = *std::move(plan);
  prepared.law = properties::find_law(prepared.plan.laws.front());
  prepared.conduct = conduct_of(prepared.plan, options.run.output, options.run.jobs);
  Result<std::vector<cases::Case>> corpus = properties::read_corpus(prepared.conduct.corpus);
  if (!corpus) return tl::unexpected(corpus.error());
  prepared.corpus = *std::move(corpus);
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
  prepared.hunt = {std::string(prepared.law->id),
                   options.backend,
                   prepared.plan.seed,
                   options.steps,
                   options.guide,
                   true,
                   properties::capabilities_of(*prepared.backend)};
  return {};
}

/// Runs tasks in this process, or in --jobs processes.
class Executor {
 public:
  explicit Executor(const Prepared& prepared)
      : prepared_(&prepared),
        runner_(prepared.plan, {}, prepared.conduct.known, prepared.conduct.backends) {}

  Result<void> operator()(const std::vector<properties::Task>& tasks,
                          const properties::TaskDone& done) {
    const properties::Conduct& conduct = prepared_->conduct;
    if (conduct.jobs == 1) return run_tasks(runner_, tasks, done, conduct.is_over);
    return run_tasks_in_processes(task_worker_of(conduct, prepared_->plan), conduct.jobs, tasks,
                                  done, conduct.is_over);
  }

 private:
  const Prepared* prepared_;
  properties::TaskRunner runner_;
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
void take_trophies(const Prepared& prepared, Results& results, ProgressBar& bar) {
  const auto& niches = results.hunted.archive.niches();
  const properties::ShrinkLimits limits{prepared.plan.shrinking.tries, prepared.conduct.is_over};
  for (const auto& [niche, entries] : niches) {
    bar.show(results.trophies.size(), niches.size(), "worst cases shrunk");
    results.trophies.push_back(properties::trophy_of(*prepared.law, prepared.hunt, entries.front(),
                                                     *prepared.backend, limits,
                                                     prepared.known ? &*prepared.known : nullptr));
  }
}

Result<void> shrink_counterexamples(Results& results, const properties::Execute& execute) {
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

Result<void> write_files(const Options& options, const Prepared& prepared, Results& results) {
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

// ---- output

std::string percent(double share) { return fmt::format("{:.2f}%", 100 * share); }

/// The size of an error: its digits that are certain.
std::string size_text(const records::Enclosure& error) {
  return records::to_decimal(records::magnitude(error), kDigits);
}

std::string number_text(const std::optional<double>& number) {
  return number ? fmt::format("{:.3g}", *number) : "–";
}

/// True for stages that decide where a triangle lies. Under a contract that leaves snapping open,
/// their parts count for nothing, and can be any size.
bool is_of_positions(records::Stage stage) {
  using records::Stage;
  return stage == Stage::transform || stage == Stage::clip_space || stage == Stage::snap ||
         stage == Stage::left_open;
}

/// The stage with the largest part of an error, and the part: "weights 3.9". Leaves out parts of
/// positions.
std::string stage_text(std::optional<records::ErrorSplit> split) {
  if (!split) return "–";
  std::erase_if(split->parts, [](const auto& part) { return is_of_positions(part.stage); });
  const auto largest = records::largest_part(*split);
  if (!largest) return "–";
  const auto part = std::find_if(split->parts.begin(), split->parts.end(),
                                 [&](const auto& one) { return one.stage == *largest; });
  return fmt::format("{} {}", records::to_string(*largest), size_text(part->error));
}

std::string found_text(const properties::HuntEntry& entry) {
  return fmt::format("step {}, {}", entry.step, cases::name_of(entry.made_by));
}

/// The guide's quantity of the worst case of a niche; "–" if the niche is empty.
std::string worst_text(const properties::HuntOutcome& outcome,
                       const properties::HuntArchive::Niche& niche, Guide guide) {
  const auto found = outcome.archive.niches().find(niche);
  if (found == outcome.archive.niches().end()) return "–";
  const double score = found->second.front().error.score(guide);
  return guide == Guide::share ? percent(score) : fmt::format("{:.4g}", score);
}

/// All niches in which the hunt or the sampling found something.
std::set<properties::HuntArchive::Niche> niches_of(const Results& results) {
  std::set<properties::HuntArchive::Niche> niches;
  for (const auto& [niche, entries] : results.hunted.archive.niches()) niches.insert(niche);
  if (!results.sampled) return niches;
  for (const auto& [niche, entries] : results.sampled->archive.niches()) niches.insert(niche);
  return niches;
}

void print_table(const Options& options, const Results& results) {
  std::vector<std::vector<std::string>> cells;
  if (!options.run.quiet) {
    cells.push_back({"value, stratum", "share of the bound", "excess", "bound", "error",
                     "condition", "mostly from", "found", "case"});
    if (results.sampled) cells.front().insert(cells.front().begin() + 2, "sampling");
  }
  for (const auto& niche : niches_of(results)) {
    std::vector<std::string> row{
        fmt::format("{}, {}", records::to_string(niche.kind), records::to_string(niche.stratum))};
    const auto trophy =
        std::find_if(results.trophies.begin(), results.trophies.end(), [&niche](const auto& one) {
          return one.entry.error.kind == niche.kind && one.entry.error.stratum == niche.stratum;
        });
    if (trophy == results.trophies.end()) {
      row.insert(row.end(), {"–", "–", "–", "–", "–", "–", "–", "–"});
    } else {
      const properties::HuntedError& error = trophy->entry.error;
      const auto place = static_cast<std::size_t>(trophy - results.trophies.begin());
      row.insert(row.end(), {error.share() ? percent(*error.share()) : "–", size_text(error.excess),
                             error.bound ? size_text(*error.bound) : "–",
                             error.ideal ? size_text(*error.ideal) : "–",
                             number_text(trophy->kappa), stage_text(trophy->split),
                             found_text(trophy->entry), results.trophy_files[place]});
    }
    if (results.sampled) {
      row.insert(row.begin() + 2, worst_text(*results.sampled, niche, options.guide));
    }
    cells.push_back(std::move(row));
  }
  fmt::print("{}",
             reports::text_table(cells, options.run.quiet ? std::nullopt : terminal_columns()));
}

/// Prints counterexamples, each with the step that found it. The case of that step may be a changed
/// copy, which no random case equals.
void print_counterexamples(const Results& results) {
  for (std::size_t i = 0; i < results.counterexamples.size(); ++i) {
    const records::Counterexample& one = results.counterexamples[i];
    fmt::print("\nFound in step {}: {}\n{}{}", one.source.found->index, one.source.found->verdict,
               reports::violations_text(one.violations, one.violation_count, terminal_columns()),
               reports::case_text(one.source));
    fmt::print("  Again: {}\n",
               reports::command_line({"rastercheck", "replay", results.counterexample_files[i]}));
  }
}

void print_counts(const Options& options, const Prepared& prepared,
                  const properties::HuntOutcome& outcome) {
  std::uint64_t left_out = 0;
  for (const auto& [why, count] : outcome.not_applicable_because) left_out += count;
  const auto source = [&outcome](properties::HuntSource of) {
    const auto found = outcome.sources.find(of);
    return found == outcome.sources.end() ? 0 : found->second;
  };
  fmt::print("\n{} of {} steps: {} random cases, {} of the corpus, {} moved; {} checked.\n",
             outcome.steps, options.steps, source(properties::HuntSource::random),
             source(properties::HuntSource::corpus), source(properties::HuntSource::moved),
             outcome.checked);
  if (left_out > 0) fmt::print("Not checked: {} cases.\n", left_out);
  for (const auto& [why, count] : outcome.not_applicable_because) {
    fmt::print("  {}: {}\n", count, cases::printable(why));
  }
  if (outcome.known > 0) fmt::print("Violated in known ways only: {} cases.\n", outcome.known);
  if (outcome.not_of_case > 0) {
    fmt::print("Not compared, as the property measured them on changed cases: {} errors.\n",
               outcome.not_of_case);
  }
  fmt::print("{} cases violated the property in ways that are not known; counterexamples: {}.\n",
             outcome.violations, outcome.counterexamples.size());
  fmt::print("Seed {}.\n", prepared.plan.seed);
}

ordered_json json_of(const records::Enclosure& enclosure) {
  return ordered_json::array({enclosure.lo, enclosure.hi});
}

ordered_json json_of(const std::optional<records::Enclosure>& enclosure) {
  return enclosure ? json_of(*enclosure) : ordered_json();
}

ordered_json json_of(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

ordered_json json_of(const properties::HuntEntry& entry) {
  const properties::HuntedError& error = entry.error;
  return {{"kind", records::to_string(error.kind)},
          {"stratum", records::to_string(error.stratum)},
          {"share", json_of(error.share())},
          {"excess", json_of(error.excess)},
          {"bound", json_of(error.bound)},
          {"error", json_of(error.ideal)},
          {"exact", error.exact},
          {"actual", error.actual},
          {"triangle_y_x_sample", {error.at.triangle, error.at.y, error.at.x, error.at.sample}},
          {"attribute", error.attribute ? ordered_json(*error.attribute) : ordered_json()},
          {"step", entry.step},
          {"made_by", cases::name_of(entry.made_by)},
          {"moves", entry.moves}};
}

ordered_json json_of(const properties::HuntTrophy& trophy, const std::string& file) {
  ordered_json json = json_of(trophy.entry);
  json["kappa"] = json_of(trophy.kappa);
  json["kappa_d"] = json_of(trophy.kappa_d);
  json["stages"] = ordered_json::array();
  if (trophy.split) {
    for (const records::StagePart& part : trophy.split->parts) {
      json["stages"].push_back(
          {{"stage", records::to_string(part.stage)}, {"error", json_of(part.error)}});
    }
  }
  json["is_least"] = trophy.shrinking && trophy.shrinking->is_least;
  json["errs_again"] = trophy.errs_again;
  json["file"] = file;
  return json;
}

/// Counts of an outcome, and the worst entry of each niche as it was found.
ordered_json json_of(const properties::HuntOutcome& outcome) {
  ordered_json sources;
  for (const auto& [source, count] : outcome.sources) {
    sources[std::string(cases::name_of(source))] = count;
  }
  ordered_json moves;
  for (const auto& [name, counts] : outcome.moves) {
    moves[std::string(name)] = {{"made", counts.made}, {"kept", counts.kept}};
  }
  ordered_json worst = ordered_json::array();
  for (const auto& [niche, entries] : outcome.archive.niches()) {
    worst.push_back(json_of(entries.front()));
  }
  return {{"steps", outcome.steps},
          {"sources", sources},
          {"checked", outcome.checked},
          {"not_applicable", outcome.not_applicable_because},
          {"known", outcome.known},
          {"not_compared", outcome.not_of_case},
          {"violations", outcome.violations},
          {"moves", moves},
          {"worst", worst}};
}

void print_json(const Options& options, const Prepared& prepared, const Results& results) {
  ordered_json document{
      {"format", "rastercheck-hunt"},      {"version", 1},
      {"property", prepared.law->id},      {"backend", options.backend},
      {"seed", prepared.plan.seed},        {"guide", cases::name_of(options.guide)},
      {"hunted", json_of(results.hunted)}, {"sampled", nullptr},
      {"worst", ordered_json::array()},    {"counterexamples", ordered_json::array()}};
  if (results.sampled) document["sampled"] = json_of(*results.sampled);
  for (std::size_t i = 0; i < results.trophies.size(); ++i) {
    document["worst"].push_back(json_of(results.trophies[i], results.trophy_files[i]));
  }
  for (std::size_t i = 0; i < results.counterexamples.size(); ++i) {
    document["counterexamples"].push_back(
        {{"step", results.counterexamples[i].source.found->index},
         {"verdict", results.counterexamples[i].source.found->verdict},
         {"file", results.counterexample_files[i]}});
  }
  fmt::print("{}\n", document.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

void print_text(const Options& options, const Prepared& prepared, const Results& results) {
  print_table(options, results);
  if (options.run.quiet) return;
  if (niches_of(results).empty()) {
    fmt::print("No value with an error was found for which the backend promises a bound.\n");
  }
  for (const properties::HuntTrophy& trophy : results.trophies) {
    if (trophy.errs_again) continue;
    fmt::print("The case of step {} did not err as much when it was drawn again.\n",
               trophy.entry.step);
  }
  print_counterexamples(results);
  print_counts(options, prepared, results.hunted);
}

// ---- the command

ExitCode code_of(const Options& options, const Results& results) {
  if (results.hunted.violations > 0 || (results.sampled && results.sampled->violations > 0)) {
    return ExitCode::violated;
  }
  if (is_interrupted() && results.hunted.steps < options.steps) return ExitCode::interrupted;
  return results.hunted.archive.niches().empty() ? ExitCode::nothing_checked : ExitCode::ok;
}

ExitCode run(const Options& options) {
  const Clock::time_point start = Clock::now();
  Result<Prepared> prepared = prepare(options);
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
  Results results;
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
  if (options.run.json) {
    print_json(options, *prepared, results);
  } else {
    print_text(options, *prepared, results);
  }
  return code_of(options, results);
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
  return [options] { return run(*options); };
}

const Registration kRegistration("hunt", "Search for the worst cases of a property", &set_up);

}  // namespace
}  // namespace rastercheck::cli::hunt_command
