// `rastercheck judge CASE PICTURE` says which pixels of a finished picture are wrong. `rastercheck
// judge --drawn DIR` judges a campaign whose drawings another machine made.

#include <fmt/format.h>

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "backends/drawn/folder.h"
#include "cases/case_reader.h"
#include "cases/files.h"
#include "cases/picture_writer.h"
#include "cli/campaign.h"
#include "cli/command.h"
#include "cli/format_option.h"
#include "cli/output.h"
#include "cli/picture_option.h"
#include "cli/run_options.h"
#include "cli/sample_limit.h"
#include "oracle/picture_judge.h"
#include "oracle/picture_parts.h"
#include "oracle/transform.h"
#include "properties/inspect/outline.h"
#include "reports/judged_page.h"
#include "reports/picture_text.h"

namespace rastercheck::cli::judge_command {
namespace {

struct Options {
  std::string file;
  std::string picture;
  PictureFlags flags;
  PicturePromise promise;
  std::string mask;
  std::string html;
  bool is_chw = false;
  std::string drawn;  ///< folder of a campaign's drawings
  RunOptions run;     ///< for `drawn`
  bool all = false;
  bool json = false;
  bool quiet = false;
};

/// Writes the verdicts as a picture; a text in the file says what the colours mean.
Result<void> write_mask(const records::JudgedPicture& judged, const std::string& file) {
  const reports::Image image = reports::verdict_image(judged);
  cases::PictureFile mask;
  mask.width = image.width;
  mask.height = image.height;
  mask.channels = cases::default_channel_names(3);
  mask.stored.assign(3, cases::Storage::unorm8);
  mask.values.assign(image.rgb.begin(), image.rgb.end());
  return cases::write_picture(mask, file, {{"Comment", reports::verdict_legend()}});
}

/// Returns the outlines of the triangles that may be seen in the part, in pixels of the file.
std::vector<records::TriangleOutline> outlines_of(const oracle::SceneTruth& scene,
                                                  const cases::PictureView& view,
                                                  const records::PicturePart& part) {
  std::set<std::uint32_t> triangles;
  for (const records::DetailedPixel& pixel : part.pixels) {
    for (const records::PermittedAnswer& answer : pixel.answers) {
      if (answer.triangle) triangles.insert(*answer.triangle);
    }
  }
  std::vector<records::TriangleOutline> outlines;
  for (const std::uint32_t triangle : triangles) {
    outlines.push_back({triangle, properties::outline_of(scene, triangle)});
    if (!view.is_flipped) continue;
    for (records::WindowPoint& point : outlines.back().points) point.y = view.size.height - point.y;
  }
  return outlines;
}

/// Returns the command line that judges the picture again, as a list of arguments.
std::vector<std::string> judge_words(const Options& options) {
  std::vector<std::string> words{"rastercheck", "judge", options.file, options.picture};
  const auto add = [&words](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add(words_of(options.flags));
  if (options.is_chw) add({"--chw"});
  add(words_of(options.promise));
  return words;
}

/// Returns the arguments of `explain` for the case, without --pixel. Empty for standard input,
/// which cannot be read twice.
std::vector<std::string> explain_words(const Options& options) {
  if (options.file == "-") return {};
  std::vector<std::string> words{"rastercheck", "explain", options.file, "--backend",
                                 options.promise.backend.empty() ? "cpu" : options.promise.backend};
  if (!options.promise.contract.empty()) {
    words.insert(words.end(), {"--contract", options.promise.contract});
  }
  return words;
}

/// Writes the report of a judged picture.
Result<void> write_page(const Options& options, const oracle::SceneTruth& scene,
                        const cases::PictureView& view, const cases::PictureFile& picture,
                        const records::JudgedPicture& judged) {
  reports::JudgedPage page;
  page.parts = oracle::choose_parts(judged);
  oracle::detail_parts(scene, view, picture, judged, page.parts);
  for (records::PicturePart& part : page.parts) part.outlines = outlines_of(scene, view, part);
  page.source = scene.source();
  page.view = view;
  page.picture = picture;
  page.contract = scene.contract();
  page.judged = judged;
  page.case_file = options.file;
  page.picture_file = options.picture;
  page.judged_by = promise_text(options.promise);
  page.command = judge_words(options);
  page.explain = explain_words(options);
  return reports::judged_html(page).and_then(
      [&](const std::string& text) { return cases::write_file(options.html, text); });
}

ExitCode exit_code_of(const records::JudgedPicture& judged) {
  if (judged.wrong() > 0) return ExitCode::violated;
  const std::uint64_t right = judged.count(records::PixelVerdict::right);
  return right == 0 ? ExitCode::nothing_checked : ExitCode::ok;
}

ExitCode judge_drawn(const Options& options) {
  const Result<backends::DrawnCampaign> campaign = backends::read_drawn_campaign(options.drawn);
  if (!campaign) return fail(campaign.error());
  const Result<backends::DrawnCount> count = backends::count_drawn(options.drawn);
  if (!count) return fail(count.error());
  if (count->drawn < count->cases) {
    print_problem(
        fmt::format("rastercheck: {}: {} of {} cases have no drawing and are not judged\n",
                    options.drawn, count->cases - count->drawn, count->cases));
  }
  if (campaign->program != RASTERCHECK_VERSION) {
    print_problem(
        fmt::format("rastercheck: {}: the cases were made by version {}; properties may "
                    "have changed since, and cases that they ask for now have no drawing\n",
                    options.drawn, campaign->program));
  }
  RunOptions run = options.run;
  run.plan = campaign->plan;
  run.plan.backends = {"drawn:" + options.drawn};
  run.plan.keeps_cases = options.run.plan.keeps_cases;
  // No shrinking: a smaller case would have no drawing.
  run.plan.shrinking.tries = 0;
  run.seed = campaign->plan.seed;
  run.json = options.json;
  run.quiet = options.quiet;
  run.all = options.all;
  // The folder determines the plan, so a baseline of another plan is refused.
  return run_campaign(run, [](const char* /*option*/) { return true; });
}

ExitCode judge_one_picture(const Options& options) {
  Result<cases::Case> c = cases::read_case(options.file);
  if (c) c = oracle::to_clip_case(*c, options.file);
  if (!c) return fail(c.error());
  if (const auto few = check_sample_count(*c, options.file, options.all); !few) {
    return fail(few.error());
  }
  for (const std::string& output : {options.mask, options.html}) {
    if (output.empty()) continue;
    const auto is_free = check_output_file(output, options.picture).and_then([&] {
      return check_output_file(output, options.file);
    });
    if (!is_free) return fail(is_free.error());
  }
  const Result<cases::PictureLayout> layout = layout_of(*c, options.flags);
  if (!layout) return fail(layout.error());
  const Result<cases::PictureFile> picture = picture_from_file(options.picture, options.is_chw);
  if (!picture) return fail(picture.error());
  const Result<cases::PictureView> view = cases::view_of(*c, *layout, *picture, options.picture);
  if (!view) return fail(view.error());
  const auto contract = contract_by(options.promise, *c);
  if (!contract) return contract.error();
  const oracle::SceneTruth scene(*c, *contract);
  const records::JudgedPicture judged = oracle::judge_picture(scene, *view, *picture);
  fmt::print("{}", options.json ? reports::picture_json(judged, *view) + "\n"
                                : reports::picture_text(judged, options.quiet));
  if (!options.mask.empty()) {
    if (const auto written = write_mask(judged, options.mask); !written) {
      return fail(written.error());
    }
  }
  if (!options.html.empty()) {
    if (const auto written = write_page(options, scene, *view, *picture, judged); !written) {
      return fail(written.error());
    }
  }
  return exit_code_of(judged);
}

ExitCode run(const Options& options) {
  if (!options.drawn.empty()) return judge_drawn(options);
  if (options.picture.empty()) {
    return fail(
        {"", "", "needs a case and a picture, or --drawn DIR (see rastercheck judge --help)"});
  }
  return judge_one_picture(options);
}

/// Adds the options for a folder of drawings.
void add_drawn(CLI::App& app, Options& options) {
  CLI::Option* drawn = app.add_option("--drawn", options.drawn,
                                      "Judge the drawings in this folder, which rastercheck cases "
                                      "filled with cases, as rastercheck run judges a backend")
                           ->type_name(kFolder);
  for (const char* other :
       {"CASE", "PICTURE", "--channels", "--background", "--storage", "--rounding", "--first-row",
        "--resolve", "--chw", "--contract", "--promised-by", "--mask", "--html"}) {
    drawn->excludes(other);
  }
  app.add_option("--output", options.run.output, "With --drawn: folder for the results")
      ->type_name(kFolder)
      ->needs(drawn)
      ->capture_default_str();
  add_formats(app, options.run.formats);
  app.add_flag("--keep-cases", options.run.plan.keeps_cases,
               "With --drawn: keep the result of each case in run.json, for a baseline")
      ->needs(drawn);
  CLI::Option* baseline = app.add_option("--baseline", options.run.baseline,
                                         "With --drawn: compare the results with this baseline")
                              ->type_name(kFile)
                              ->needs(drawn);
  app.add_option("--policy", options.run.policy,
                 "With --baseline: file that says what may be worse, why and until when")
      ->type_name(kFile)
      ->needs(baseline);
  app.add_option("--jobs", options.run.jobs, "With --drawn: number of parallel processes")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->needs(drawn)
      ->capture_default_str();
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("CASE", options->file, "Case file; - reads standard input")->type_name(kFile);
  app.add_option("PICTURE", options->picture,
                 "OpenEXR, PNG, NPY or PFM file; - reads standard input")
      ->type_name(kFile);
  add_picture_flags(app, options->flags);
  app.add_flag("--chw", options->is_chw,
               "An NPY array's axes are channel, height, width; default: height, width, channel");
  add_picture_promise(app, options->promise);
  app.add_option("--mask", options->mask, "Write the verdict of each pixel to this PNG file")
      ->type_name(kFile);
  app.add_option("--html", options->html,
                 "Write the report to this HTML file: verdicts, differences, and for each pixel "
                 "that is worth a look what it may show")
      ->type_name(kFile);
  app.add_flag("--all", options->all,
               "Allow more than 2^26 samples; with --drawn: print a row for each property");
  app.add_flag("--json", options->json, "Print the verdict as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print only the table's rows");
  add_drawn(app, *options);
  app.footer(
      "A pixel is right if a drawing that the contract permits shows it so. The judge calls no "
      "right pixel wrong; where the contract leaves open where vertices are placed, it may miss a "
      "wrong one.\n\n"
      "Exit codes: 0 all pixels are right, 1 some are wrong, 2 usage or unreadable input, 5 "
      "nothing could be judged.\n\n"
      "Examples:\n"
      "  rastercheck judge scene.json scene.png --promised-by gl:llvmpipe\n"
      "  rastercheck judge --drawn drawn");
  return [options] { return run(*options); };
}

const Registration kRegistration("judge", "Say which pixels of a picture are wrong", &set_up);

}  // namespace
}  // namespace rastercheck::cli::judge_command
