// `rastercheck run`: runs a campaign and writes a folder with its findings.

#include <memory>
#include <string>

#include "cases/names.h"
#include "cli/campaign.h"
#include "cli/command.h"
#include "cli/contract_option.h"
#include "cli/format_option.h"
#include "cli/isolation.h"
#include "cli/known_option.h"
#include "cli/run_options.h"
#include "cli/run_results.h"
#include "cli/shard_option.h"
#include "cli/whole_number.h"

namespace rastercheck::cli::run_command {
namespace {

/// Limits of the values of --shrink-seconds and --max-time: one millisecond and one day.
constexpr double kLeastSeconds = 0.001;
constexpr double kMostSeconds = 86400;

/// Adds the options that tell how much the verdict "held" is worth: --power measures which damage
/// the laws notice, and --require-cases demands a number of judged cases.
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
                                         "save), using its seed and cases; a shard only uses these")
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
  return [options, &app] {
    return run_campaign(*options, [&app](const char* option) { return app.count(option) > 0; });
  };
}

const Registration kRegistration("run", "Check every property on the corpus and on random cases",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::run_command
