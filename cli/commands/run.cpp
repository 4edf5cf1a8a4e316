// `rastercheck run`: a campaign, and the folder with what it found.

#include "records/run.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/utsname.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <future>
#include <memory>
#include <random>

#include "backends/backend.h"
#include "cases/case_reader.h"
#include "cases/json.h"
#include "cases/mesh.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/summary_table.h"
#include "cli/whole_number.h"
#include "oracle/transform.h"
#include "properties/scene.h"
#include "properties/workers.h"
#include "records/share.h"
#include "reports/format.h"
#include "reports/picture.h"
#include "reports/png.h"
#include "reports/write.h"

namespace rastercheck::cli {
namespace {

struct Options {
  std::vector<std::string> backends{"cpu"};
  std::string property = "*";
  std::uint64_t cases = 1000;
  std::optional<std::uint64_t> seed;
  std::string scene;
  int scene_size = 512;
  std::string corpus;
  std::string output = "rastercheck-out";
  std::vector<std::string> formats{"json", "html", "markdown"};
  int jobs = 1;
  bool json = false;
  bool quiet = false;
};

constexpr const char* kOwnProgram = "/proc/self/exe";

/// The corpus that comes with the program: beside it where it is installed, else in the sources it
/// was built from.
std::string default_corpus() {
  std::error_code problem;
  const auto program = std::filesystem::read_symlink(kOwnProgram, problem);
  if (!problem) {
    const auto installed = program.parent_path().parent_path() / RASTERCHECK_INSTALLED_CORPUS;
    if (std::filesystem::is_directory(installed, problem)) return installed.string();
  }
  return RASTERCHECK_SOURCE_CORPUS;
}

/// The laws whose names match a pattern.
std::vector<std::string> chosen_laws(const std::string& pattern) {
  std::vector<std::string> names;
  for (const properties::Law& law : properties::laws()) {
    const std::string name(law.name);
    if (::fnmatch(pattern.c_str(), name.c_str(), 0) == 0) names.push_back(name);
  }
  return names;
}

/// The scene's clip case, under the name of its file if it has no other.
Result<cases::Case> read_scene(const Options& options) {
  const bool is_mesh = cases::is_mesh_file(options.scene);
  Result<cases::Case> scene =
      is_mesh ? cases::case_from_mesh(
                    options.scene, {options.scene_size, options.scene_size, cases::Rules::vulkan})
              : cases::read_case(options.scene);
  if (scene) scene = oracle::to_clip_case(*scene, options.scene);
  if (scene && (is_mesh || scene->name.empty())) {
    const bool is_file = options.scene != "-";
    scene->name = is_file
                      ? cases::valid_utf8(std::filesystem::path(options.scene).filename().string())
                      : "standard input";
  }
  return scene;
}

Result<records::Picture> picture(std::string name, std::string caption,
                                 const reports::Image& image) {
  Result<std::string> png = reports::to_png(image);
  if (!png) return tl::unexpected(png.error());
  return records::Picture{std::move(name), std::move(caption), image.width, image.height,
                          *std::move(png)};
}

/// Judges the scene with every backend, and keeps what was drawn and its error map as pictures.
Result<properties::Findings> judge_scenes(const cases::Case& scene, unsigned jobs,
                                          records::Run& run) {
  properties::Findings all;
  for (const std::string& specification : run.backends) {
    auto backend = backends::make_backend(specification);
    if (!backend) return tl::unexpected(backend.error());
    Result<properties::SceneFindings> found =
        properties::judge_scene(scene, specification, **backend, run.seed, run.laws, jobs);
    if (!found) return tl::unexpected(found.error());
    const std::string stem =
        std::filesystem::path(scene.name).stem().string() + "-" + specification;
    const bool y_up = found->source.rules == cases::Rules::opengl;
    const Result<records::Picture> drawn =
        picture(stem, fmt::format("{} as {} drew it.", scene.name, specification),
                reports::draw_picture(found->source, found->drawn));
    const Result<records::Picture> errors = picture(
        stem + "-errors",
        fmt::format("Its errors: the largest of each pixel's attributes against the exact value, "
                    "in scale ULP."),
        reports::draw_error_map(found->map, y_up));
    if (!drawn) return tl::unexpected(drawn.error());
    if (!errors) return tl::unexpected(errors.error());
    run.pictures.push_back(*drawn);
    run.pictures.push_back(*errors);
    properties::merge(all, std::move(found->findings));
  }
  return all;
}

properties::CampaignOptions campaign_of(const records::Run& run) {
  return {run.seed, run.cases_per_law, run.backends, run.laws};
}

/// The campaign and the scene, side by side where there are processes for it.
Result<properties::Findings> find(const Options& options, const std::string& corpus_directory,
                                  std::vector<cases::Case> corpus,
                                  const std::optional<cases::Case>& scene, records::Run& run) {
  ProgressBar bar(options.quiet);
  const properties::Progress progress = [&bar](std::uint64_t done, std::uint64_t all) {
    bar.show(done, all);
  };
  const std::vector<properties::Task> tasks = properties::tasks_of(campaign_of(run), corpus.size());

  Result<properties::Findings> campaign;
  Result<properties::Findings> of_scene;
  if (options.jobs == 1) {
    properties::TaskRunner runner(run.seed, std::move(corpus));
    if (scene) of_scene = judge_scenes(*scene, 1, run);
    if (of_scene) campaign = properties::run_tasks(runner, tasks, progress);
  } else {
    const std::vector<std::string> command{
        kOwnProgram, "worker", "--seed", std::to_string(run.seed), "--corpus", corpus_directory};
    auto dispatched = std::async(std::launch::async, [&] {
      return properties::run_tasks_in_processes(command, options.jobs, tasks, progress);
    });
    if (scene) of_scene = judge_scenes(*scene, static_cast<unsigned>(options.jobs), run);
    campaign = dispatched.get();
  }
  if (!of_scene) return of_scene;
  if (!campaign) return campaign;
  properties::merge(*campaign, *std::move(of_scene));
  return campaign;
}

/// What of a run depends on machine and time.
std::map<std::string, std::string> environment(const Options& options, double seconds) {
  utsname machine{};
  ::uname(&machine);
  const std::time_t now = std::time(nullptr);
  return {{"version", RASTERCHECK_VERSION},
          {"compiler", RASTERCHECK_COMPILER},
          {"build", RASTERCHECK_BUILD_TYPE},
          {"machine", fmt::format("{} {} {}", machine.sysname, machine.release, machine.machine)},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
          {"jobs", std::to_string(options.jobs)},
          {"seconds", fmt::format("{:.1f}", seconds)}};
}

/// Whether the row's law had to check something: some laws are about what not every backend
/// promises.
bool is_promised(const records::LawSummary& row) {
  const properties::Law* law = properties::find_law(row.law);
  const auto backend = backends::make_backend(row.backend);
  return law == nullptr || !backend || properties::is_promised(*law, **backend);
}

/// The exit code of a run without faults. Where several apply: violated, then nothing checked.
ExitCode outcome(const std::vector<records::LawSummary>& rows) {
  using records::LawSummary;
  using records::LawVerdict;
  const auto is = [](LawVerdict verdict) {
    return [verdict](const LawSummary& row) { return row.verdict == verdict; };
  };
  if (std::any_of(rows.begin(), rows.end(), is(LawVerdict::violated))) return ExitCode::violated;
  const bool is_missing = std::any_of(rows.begin(), rows.end(), [](const LawSummary& row) {
    return row.verdict == LawVerdict::not_checked && is_promised(row);
  });
  const bool has_held = std::any_of(rows.begin(), rows.end(), is(LawVerdict::held));
  return is_missing || !has_held ? ExitCode::nothing_checked : ExitCode::ok;
}

void print_results(const Options& options, const records::Run& run,
                   const std::vector<records::LawSummary>& rows, double seconds) {
  if (options.json) {
    fmt::print("{}\n", summary_json(run, rows));
    return;
  }
  fmt::print("{}", summary_table(rows, options.quiet));
  for (const records::UnreachedLabel& label : run.unreached) {
    fmt::print("{}\n", records::unreached_sentence(label));
  }
  if (options.quiet) return;
  records::Counts counts;
  records::Levels levels;
  for (const records::LawSummary& row : rows) {
    records::merge(counts, row.counts);
    records::merge(levels, row.levels);
  }
  fmt::print("\nSamples: {} required, {} forbidden, {} permitted, {} undecided.\n", counts.required,
             counts.forbidden, counts.permitted, counts.undecided);
  const std::string decided = records::decided_sentence(levels, counts.undecided);
  if (!decided.empty()) fmt::print("{}\n", decided);
  for (const records::Counterexample& found : run.counterexamples) {
    fmt::print("Counterexample: {}/{} ({})\n", options.output, records::file_of(found),
               found.source.found->verdict);
  }
  fmt::print("Seed {}, {:.1f} s. {}", run.seed, seconds,
             where_reports_are(options.output, options.formats));
}

/// The same without those that were there before: twice the same is no more work.
std::vector<std::string> without_repetitions(const std::vector<std::string>& all) {
  std::vector<std::string> once;
  for (const std::string& one : all) {
    if (std::find(once.begin(), once.end(), one) == once.end()) once.push_back(one);
  }
  return once;
}

/// Whether reports can be written there; asked before the work rather than after it.
Result<void> check_output(const Options& options) {
  for (const std::string& name : options.formats) {
    if (const auto format = reports::find_format(name); !format) {
      return tl::unexpected(format.error());
    }
  }
  std::error_code why;
  std::filesystem::create_directories(options.output, why);
  if (why) return tl::unexpected(Error{options.output, "", "cannot be made: " + why.message()});
  return {};
}

ExitCode run_campaign(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  records::Run run;
  run.seed = options.seed ? *options.seed : std::random_device()();
  run.cases_per_law = options.cases;
  run.backends = without_repetitions(options.backends);
  run.laws = chosen_laws(options.property);
  if (run.laws.empty()) {
    return fail({"--property", "", "no property matches (see rastercheck list properties)"});
  }
  const std::string corpus_directory = options.corpus.empty() ? default_corpus() : options.corpus;
  Result<std::vector<cases::Case>> corpus = properties::read_corpus(corpus_directory);
  if (!corpus) return fail(corpus.error());
  std::optional<cases::Case> scene;
  if (!options.scene.empty()) {
    Result<cases::Case> read = read_scene(options);
    if (!read) return fail(read.error());
    scene = *std::move(read);
    run.scene = options.scene;
  }

  if (const auto can_write = check_output(options); !can_write) return fail(can_write.error());
  // Last: input that cannot be read goes before backends that cannot run.
  if (const ExitCode code = check_backends(run.backends); code != ExitCode::ok) return code;

  Result<properties::Findings> found =
      find(options, corpus_directory, *std::move(corpus), scene, run);
  if (!found) return fail_internally(found.error());
  if (found->fault) return fail_internally({"the oracle", "", *found->fault});
  run.records = std::move(found->records);
  run.counterexamples = std::move(found->counterexamples);
  run.unreached = properties::unreached_labels(campaign_of(run), run.records);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  run.environment = environment(options, seconds.count());

  const Result<void> written = reports::write_reports(run, options.output, options.formats);
  if (!written) return fail(written.error());
  const std::vector<records::LawSummary> rows = records::summarize(run);
  print_results(options, run, rows, seconds.count());
  return outcome(rows);
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("--backend", options->backends, "What is checked; may be given several times")
      ->capture_default_str();
  app.add_option("--property", options->property,
                 "Only properties whose name matches, as '*edge*' (see rastercheck list "
                 "properties)")
      ->capture_default_str();
  app.add_option("--cases", options->cases, "Random cases of each property")
      ->check(whole_number())
      ->capture_default_str();
  app.add_option("--seed", options->seed, "Seed of the random cases; random without it")
      ->check(whole_number());
  app.add_option("--scene", options->scene, "Mesh or case file that is drawn and judged whole");
  app.add_option("--scene-size", options->scene_size, "Width and height of a mesh's picture")
      ->check(CLI::Range(1, cases::kMaxSize))
      ->capture_default_str();
  app.add_option("--corpus", options->corpus, "Folder of case files; the project's own without it");
  app.add_option("--output", options->output, "Folder for the results")->capture_default_str();
  app.add_option("--format", options->formats, "Reports to write, as json,html,markdown")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--jobs", options->jobs, "Processes")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--json", options->json, "The table as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Rows only, no progress bar");
  app.footer(
      "Exit code 0 if every property held, 1 if one was violated, 5 if one checked nothing.");
  return [options] { return run_campaign(*options); };
}

const Registration kRegistration("run", "A campaign: every property on the corpus and random cases",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli
