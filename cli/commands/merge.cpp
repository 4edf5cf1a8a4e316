// `rastercheck merge DIR…`: merges the shards of a campaign into one run.

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <future>
#include <memory>
#include <thread>

#include "cli/command.h"
#include "cli/conduct.h"
#include "cli/format_option.h"
#include "cli/github.h"
#include "cli/output.h"
#include "cli/run_results.h"
#include "cli/scene.h"
#include "properties/campaign/shard_merge.h"
#include "properties/inspect/gathered_inspections.h"
#include "properties/inspect/merged_inspections.h"
#include "records/summary.h"
#include "reports/format.h"
#include "reports/run_reader.h"
#include "reports/summary_table.h"
#include "reports/write.h"

namespace rastercheck::cli::merge_command {
namespace {

struct Options {
  std::vector<std::string> shards;  ///< folders of runs, or their run.json
  std::string output = "rastercheck-out";
  std::vector<std::string> formats = reports::default_format_names();
  bool json = false;
  bool quiet = false;
  bool all = false;
};

using Read = Result<records::Run>;
using ReadFile = Read (*)(const std::string& file);

/// Reads files ahead on all processors, but no more at a time, so that memory does not grow with
/// their number.
class RunReader {
 public:
  RunReader(const std::vector<std::string>& files, ReadFile read) : files_(&files), read_(read) {
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) begin_next();
  }

  /// Returns the run of the next file, in the order of the files.
  Read next() {
    Read run = begun_.front().get();
    begun_.pop_front();
    begin_next();
    return run;
  }

 private:
  void begin_next() {
    if (next_ == files_->size()) return;
    const std::string& file = (*files_)[next_++];
    // Read when asked for, if no thread is to be had.
    constexpr auto kPolicy = std::launch::async | std::launch::deferred;
    begun_.push_back(std::async(kPolicy, [read = read_, &file] { return read(file); }));
  }

  const std::vector<std::string>* files_;
  ReadFile read_;
  std::size_t next_ = 0;
  std::deque<std::future<Read>> begun_;
};

Result<properties::MergedRun> merged_run(const Options& options) {
  std::vector<std::string> files;
  for (const std::string& shard : options.shards) {
    files.push_back(std::filesystem::is_directory(shard) ? shard + "/run.json" : shard);
    const Result<void> checked = check_output_file(options.output + "/run.json", files.back());
    if (!checked) return tl::unexpected(checked.error());
  }
  properties::ShardMerge merge;
  RunReader reader(files, &reports::read_run_without_inspections);
  for (const std::string& file : files) {
    const Result<void> added =
        reader.next().and_then([&](records::Run run) { return merge.add(std::move(run), file); });
    if (!added) return tl::unexpected(added.error());
  }
  return std::move(merge).finish();
}

/// Reads the shards again, for what each of them inspected.
Result<void> gather_inspections(properties::MergedRun& merged) {
  properties::GatheredInspections gathered(merged.run);
  RunReader reader(merged.files, &reports::read_run);
  for (std::size_t i = 0; i < merged.files.size(); ++i) {
    const Read run = reader.next();
    if (!run) return tl::unexpected(run.error());
    gathered.add(*run);
  }
  merged.run.inspections = std::move(gathered).finish();
  return {};
}

/// Inspects samples of the merged run. If this fails, takes the shards' inspections and says why.
Result<void> add_inspections(properties::MergedRun& merged) {
  const properties::Conduct conduct = conduct_of(merged.run.plan, "", 1);
  const Result<void> inspected = properties::inspect_merged(merged, conduct, &read_scene);
  if (inspected) return {};
  Error why = inspected.error();
  why.reason += "; using the samples that the shards inspected";
  fail(why);
  return gather_inspections(merged);
}

ExitCode merge(const Options& options) {
  for (const std::string& name : options.formats) {
    if (const auto format = reports::find_format(name); !format) return fail(format.error());
  }
  Result<properties::MergedRun> merged = merged_run(options);
  if (!merged) return fail(merged.error());
  if (const auto added = add_inspections(*merged); !added) return fail(added.error());
  const records::Run& run = merged->run;
  const std::vector<records::LawSummary> rows = records::summarize(run);
  const Result<void> written = reports::write_reports(run, options.output, options.formats);
  if (options.json) {
    fmt::print("{}\n", reports::summary_json(run, rows));
  } else {
    print_results(run, rows, options.output, detail_of(options.quiet, options.all));
    if (!options.quiet) {
      const auto seconds = run.environment.find("seconds");
      fmt::print("Seed {}, {} shards, {} s.{}", run.plan.seed, merged->files.size(),
                 seconds == run.environment.end() ? "–" : seconds->second,
                 written ? " " + where_reports_are(options.output, options.formats) : "\n");
    }
  }
  if (!written) return fail(written.error());
  if (const auto told = tell_github(run, options.output, !options.json); !told) fail(told.error());
  return exit_code_of(run, rows, merged->common.promises);
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("DIR", options->shards, "Output folders of all shards, or their run.json files")
      ->type_name(kFolder)
      ->required();
  app.add_option("--output", options->output, "Folder for the results")
      ->type_name(kFolder)
      ->capture_default_str();
  add_formats(app, options->formats);
  app.add_flag("--json", options->json, "Print the table as JSON");
  CLI::Option* quiet = app.add_flag("-q,--quiet", options->quiet, "Print only the table's rows");
  app.add_flag("--all", options->all, kAllHelp)->excludes(quiet);
  app.footer(
      "Exit codes are those of `rastercheck run`; 2 if shards are missing or do not belong "
      "together.\n\n"
      "Example with two jobs:\n"
      "  rastercheck run --seed 1 --shard 1/2 --output one\n"
      "  rastercheck run --seed 1 --shard 2/2 --output two\n"
      "  rastercheck merge one two");
  return [options] { return merge(*options); };
}

const Registration kRegistration("merge", "Combine the shards of a run (run --shard)", &set_up);

}  // namespace
}  // namespace rastercheck::cli::merge_command
