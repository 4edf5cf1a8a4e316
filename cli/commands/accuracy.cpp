// `rastercheck accuracy`: how exactly backends draw, as rows of the accuracy table.

#include "records/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cases/case_writer.h"
#include "cases/files.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/conduct.h"
#include "cli/contract_option.h"
#include "cli/corpus_folder.h"
#include "cli/environment.h"
#include "cli/interrupt.h"
#include "cli/isolation.h"
#include "cli/output.h"
#include "cli/run_options.h"
#include "cli/terminal.h"
#include "cli/whole_number.h"
#include "properties/campaign/accuracy_cases.h"
#include "properties/campaign/campaign.h"
#include "records/summary.h"
#include "reports/accuracy_table.h"

namespace rastercheck::cli::accuracy_command {
namespace {

namespace fs = std::filesystem;

struct Options {
  RunOptions run;
  std::uint64_t seed = 1;
  std::uint64_t cases = 400;
  std::string against;
  bool alone = false;
  bool json = false;
  bool markdown = false;
  bool quiet = false;
};

constexpr std::size_t kDateLength = 10;  // YYYY-MM-DD

/// True for the file of a case that write_cases() wrote.
bool is_own(const fs::path& file) {
  constexpr std::string_view kPrefix = "accuracy-";
  const std::string name = file.stem().string();
  return name.starts_with(kPrefix) && file.extension() == ".json" &&
         name.find_first_not_of("0123456789", kPrefix.size()) == std::string::npos;
}

/// Writes the cases into a folder that has no others, in place of those that are there.
Result<void> write_cases(const std::vector<cases::Case>& all, const fs::path& folder) {
  std::error_code why;
  fs::create_directories(folder, why);
  std::vector<fs::path> before;
  for (const auto& entry : fs::directory_iterator(folder, why)) before.push_back(entry.path());
  if (why) return tl::unexpected(Error{folder.string(), "", why.message()});
  for (const fs::path& file : before) {
    if (is_own(file)) continue;
    return tl::unexpected(Error{file.string(), "",
                                "was not written by `rastercheck accuracy`; choose another "
                                "--output, or move it"});
  }
  for (const fs::path& file : before) fs::remove(file, why);
  for (const cases::Case& c : all) {
    const fs::path file = folder / (c.name + ".json");
    const Result<void> written = cases::write_file(file.string(), cases::to_json(c));
    if (!written) return written;
  }
  return {};
}

/// What draws for a backend: what it says of itself or, if that is nothing, this program.
std::string drawn_by(const records::Run& run, const std::string& backend) {
  const auto found = run.environment.find(records::drawn_by_key(backend));
  if (found == run.environment.end()) return "RasterCheck " RASTERCHECK_VERSION;
  // After ": ", a plugin's description lists what it promises.
  return found->second.substr(0, found->second.find(": "));
}

Result<std::vector<records::AccuracyRow>> rows_of(const Options& options,
                                                  const records::Plan& plan) {
  const Result<records::Run> run =
      run_plan(plan, options.run.output, options.run.jobs, &is_interrupted);
  if (!run) return tl::unexpected(run.error());
  const std::vector<records::LawSummary> laws = records::summarize(*run);
  std::vector<records::AccuracyRow> rows;
  for (const std::string& backend : plan.backends) {
    rows.push_back(records::accuracy_of(laws, run->records, backend));
    rows.back().drawn_by = drawn_by(*run, backend);
    rows.back().date = run->environment.at("date").substr(0, kDateLength);
  }
  return rows;
}

/// The rows of the table that comes with the program, or of the given one.
Result<std::vector<records::AccuracyRow>> others(const Options& options) {
  if (options.alone) return std::vector<records::AccuracyRow>();
  const std::string file =
      options.against.empty() ? accuracy_folder() + "/table.json" : options.against;
  return cases::read_text(file)
      .and_then([&](const std::string& text) { return records::parse_accuracy(text, file); })
      .map([](records::AccuracyTable&& table) { return std::move(table.rows); });
}

void print(const Options& options, const records::AccuracyTable& table,
           const std::vector<records::AccuracyRow>& all) {
  if (options.json) return fmt::print("{}\n", records::accuracy_json(table));
  if (options.markdown) return fmt::print("{}", reports::accuracy_markdown(all));
  fmt::print("{}", reports::accuracy_text(all, terminal_columns()));
  if (options.quiet) return;
  fmt::print(
      "\nErrors are the largest / the 99 % quantile, in scale ULP, of depth in ULP of its "
      "range.\n");
  for (const records::AccuracyRow& row : table.rows) {
    if (row.worst_case.empty()) continue;
    fmt::print("{} is farthest off in {}/cases/{}.json\n", row.backend, options.run.output,
               row.worst_case);
  }
}

ExitCode run(const Options& options) {
  RunOptions asked = options.run;
  records::Plan& plan = asked.plan;
  asked.seed = options.seed;
  plan.properties = {std::string(records::kCoverageLaw), std::string(records::kValuesLaw)};
  plan.cases_per_law = 0;
  plan.corpus = options.run.output + "/cases";
  plan.ignores_known = true;
  plan.shrinking.tries = 0;
  plan.power = 0;
  const Result<records::Plan> made = make_plan(asked);
  if (!made) return fail(made.error());
  const Result<std::vector<records::AccuracyRow>> theirs = others(options);
  if (!theirs) return fail(theirs.error());
  if (options.cases == 0) {
    if (options.json || options.alone) {
      return fail({"--cases", "0", "prints other rows only: it needs neither --json nor --alone"});
    }
    print(options, {}, *theirs);
    return ExitCode::ok;
  }
  const backends::BackendFactory factory = properties::factory_for(*made, worker_program());
  if (const ExitCode code = check_backends(factory, made->backends); code != ExitCode::ok) {
    return code;
  }
  const auto written =
      write_cases(properties::accuracy_cases(options.seed, options.cases), plan.corpus);
  if (!written) return fail(written.error());
  const InterruptWatch watch("\nrastercheck: stopping; press Ctrl-C again to stop at once.\n");
  Result<std::vector<records::AccuracyRow>> rows = rows_of(options, *made);
  if (!rows) return fail(rows.error());
  if (is_interrupted()) return ExitCode::interrupted;

  records::AccuracyTable table;
  table.program = RASTERCHECK_VERSION;
  table.seed = options.seed;
  table.rows = *rows;
  std::vector<records::AccuracyRow> all = *std::move(rows);
  all.insert(all.end(), theirs->begin(), theirs->end());
  print(options, table, all);
  const bool is_kept = std::all_of(table.rows.begin(), table.rows.end(),
                                   [](const auto& row) { return row.keeps_promise(); });
  const bool is_empty = std::any_of(table.rows.begin(), table.rows.end(),
                                    [](const auto& row) { return row.samples == 0; });
  if (!is_kept) return ExitCode::violated;
  return is_empty ? ExitCode::nothing_checked : ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  records::Plan& plan = options->run.plan;
  options->run.output = "rastercheck-accuracy";
  app.add_option("--backend", plan.backends, "Backend to measure; may be repeated")
      ->type_name(kBackend)
      ->capture_default_str();
  app.add_option("--cases", options->cases,
                 "Random cases, the same for all backends; 0: only print the other rows")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--seed", options->seed, "Seed of the cases")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  add_contract(app, options->run.contract);
  add_promise(app, plan.promise);
  add_timeout(app, plan.timeout);
  CLI::Option* alone =
      app.add_flag("--alone", options->alone, "Print no rows of other rasterizers");
  app.add_option(
         "--against", options->against,
         "Table, as --json prints it, whose rows are printed as well; default: the one that "
         "comes with the program")
      ->type_name(kFile)
      ->excludes(alone);
  app.add_option("--output", options->run.output, "Folder for the cases and for the run")
      ->type_name(kFolder)
      ->capture_default_str();
  app.add_option("--jobs", options->run.jobs, "Number of parallel processes")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  CLI::Option* json = app.add_flag("--json", options->json, "Print the backends' rows as JSON");
  app.add_flag("--markdown", options->markdown, "Print the table as Markdown")->excludes(json);
  app.add_flag("-q,--quiet", options->quiet, "Print only the table");
  app.footer(
      "Draws the same random cases with each backend, and compares every value with the exact one. "
      "What a backend lacks is left out of a case. Exit code 0 if all is as the contracts promise, "
      "1 if not, 4 if a backend cannot run here, 5 if nothing was judged.\n\n"
      "Examples:\n"
      "  rastercheck accuracy --backend plugin:./mine.so\n"
      "  rastercheck accuracy --backend cpu --backend gl:llvmpipe --alone");
  return [options] { return run(*options); };
}

const Registration kRegistration("accuracy", "Measure how exactly rasterizers draw the same cases",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::accuracy_command
