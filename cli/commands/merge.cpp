// `rastercheck merge DIR…`: merges the shards of a campaign into one run.

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/command.h"
#include "cli/conduct.h"
#include "cli/format_option.h"
#include "cli/github.h"
#include "cli/output.h"
#include "cli/run_results.h"
#include "cli/scene.h"
#include "properties/campaign/shard_merge.h"
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

Result<properties::MergedRun> merged_run(const Options& options) {
  properties::ShardMerge merge;
  for (const std::string& shard : options.shards) {
    const std::string file = std::filesystem::is_directory(shard) ? shard + "/run.json" : shard;
    const Result<void> added =
        check_output_file(options.output + "/run.json", file)
            .and_then([&] { return reports::read_run(file); })
            .and_then([&](records::Run run) { return merge.add(std::move(run), file); });
    if (!added) return tl::unexpected(added.error());
  }
  return std::move(merge).finish();
}

/// Inspects samples of the merged run. If this fails, keeps the shards' inspections and says why.
void add_inspections(properties::MergedRun& merged) {
  const properties::Conduct conduct = conduct_of(merged.run.plan, "", 1);
  const Result<void> inspected = properties::inspect_merged(merged, conduct, &read_scene);
  if (inspected) return;
  Error why = inspected.error();
  why.reason += "; using the samples that the shards inspected";
  fail(why);
}

ExitCode merge(const Options& options) {
  for (const std::string& name : options.formats) {
    if (const auto format = reports::find_format(name); !format) return fail(format.error());
  }
  Result<properties::MergedRun> merged = merged_run(options);
  if (!merged) return fail(merged.error());
  add_inspections(*merged);
  const records::Run& run = merged->run;
  const std::vector<records::LawSummary> rows = records::summarize(run);
  const Result<void> written = reports::write_reports(run, options.output, options.formats);
  if (options.json) {
    fmt::print("{}\n", reports::summary_json(run, rows));
  } else {
    print_results(run, rows, options.output, detail_of(options.quiet, options.all));
    if (!options.quiet) {
      const auto seconds = run.environment.find("seconds");
      fmt::print("Seed {}, {} shards, {} s.{}", run.plan.seed, merged->looked_at.size(),
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
