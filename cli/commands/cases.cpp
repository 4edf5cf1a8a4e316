// `rastercheck cases --out DIR`: a campaign's cases, for another machine to draw.

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "backends/drawn/folder.h"
#include "backends/drawn/recording_backend.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/contract_option.h"
#include "cli/corpus_folder.h"
#include "cli/own_program.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "cli/whole_number.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/corpus.h"

namespace rastercheck::cli::cases_command {
namespace {

struct Options {
  RunOptions run;
  std::string promised_by = "cpu";
  std::string folder;
  bool quiet = false;
};

/// Checks all laws with a backend that records what it is asked to draw.
Result<void> record_all(const records::Plan& plan, std::vector<cases::Case> corpus,
                        backends::BackendFactory factory, backends::CaseFolder& folder,
                        bool quiet) {
  const backends::RecordingBackend* recorder = nullptr;
  factory.wrap = [&](std::unique_ptr<backends::Backend> inner) {
    auto recording = std::make_unique<backends::RecordingBackend>(std::move(inner), folder);
    recorder = recording.get();
    return std::unique_ptr<backends::Backend>(std::move(recording));
  };
  const std::size_t corpus_size = corpus.size();
  properties::TaskRunner runner(plan, std::move(corpus), {}, std::move(factory));
  runner.make_cases_for(runner.capabilities());
  const std::vector<properties::Task> tasks = properties::tasks_of(plan, corpus_size);
  ProgressBar bar(quiet);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Result<properties::Findings> found = runner.run(tasks[i]);
    if (!found) return tl::unexpected(found.error());
    if (recorder != nullptr && recorder->failure()) return tl::unexpected(*recorder->failure());
    bar.show(i + 1, tasks.size(), "tasks");
  }
  return {};
}

ExitCode run(const Options& options) {
  RunOptions asked = options.run;
  asked.plan.backends = {options.promised_by};
  asked.plan.power = 0;
  const Result<records::Plan> plan = make_plan(asked);
  if (!plan) return fail(plan.error());
  Result<std::vector<cases::Case>> corpus = properties::corpus_of(*plan, corpus_folder_of(*plan));
  if (!corpus) return fail(corpus.error());
  const backends::BackendFactory factory = properties::factory_for(*plan, worker_program());
  if (const ExitCode code = check_backends(factory, plan->backends); code != ExitCode::ok) {
    return code;
  }
  Result<backends::CaseFolder> folder = backends::CaseFolder::make(options.folder);
  if (!folder) return fail(folder.error());
  const Result<void> recorded =
      record_all(*plan, *std::move(corpus), factory, *folder, options.quiet).and_then([&] {
        return folder->finish({RASTERCHECK_VERSION, *plan});
      });
  if (!recorded) return fail(recorded.error());
  if (!options.quiet) {
    fmt::print(
        "{} cases are in {}; write their drawings to {}/drawn, then\n  rastercheck judge --drawn "
        "{}\n",
        folder->size(), options.folder, options.folder, options.folder);
  }
  return folder->size() == 0 ? ExitCode::nothing_checked : ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  records::Plan& plan = options->run.plan;
  plan.cases_per_law = 20;
  app.add_option("--out", options->folder, "Folder for the cases; must be empty or not exist")
      ->type_name(kFolder)
      ->required();
  app.add_option("--promised-by", options->promised_by,
                 "Backend with the promises and limits of the rasterizer that will draw the cases")
      ->type_name(kBackend)
      ->capture_default_str();
  add_contract(app, options->run.contract);
  add_promise(app, plan.promise);
  app.add_option("--property", plan.properties,
                 "Only cases for properties whose id matches, such as '*edge*'; may be repeated")
      ->type_name(kProperty);
  app.add_option("--cases", plan.cases_per_law,
                 "Random cases per property, in addition to the corpus")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--seed", options->run.seed,
                 "Seed of the random cases; the same seed gives the same cases; default: random")
      ->transform(whole_number())
      ->type_name("N");
  app.add_option("--corpus", plan.corpus,
                 "Folder of case files to add; default: the corpus that comes with the program")
      ->type_name(kFolder);
  app.add_flag("-q,--quiet", options->quiet, "Print nothing, and no progress bar");
  app.footer(
      "A property may draw several versions of a case; each is a case of its own here. "
      "DIR/list.txt "
      "names them all; cases/NAME.json is a case file, and cases/NAME.draw the same as arrays of "
      "numbers for programs that read no JSON. Drawings are DIR/drawn/NAME with the ending .json "
      "(as rastercheck render --json writes it), .npy, .exr or .drawn.\n\n"
      "Example:\n"
      "  rastercheck cases --out drawn --promised-by gl:llvmpipe --seed 1");
  return [options] { return run(*options); };
}

const Registration kRegistration("cases", "Write a campaign's cases for another machine to draw",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::cases_command
