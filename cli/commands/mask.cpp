// `rastercheck mask CASE`: what a picture of a case may show.

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cases/case_reader.h"
#include "cases/picture_writer.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/picture_option.h"
#include "cli/sample_limit.h"
#include "oracle/picture_judge.h"
#include "oracle/transform.h"
#include "reports/picture_mask.h"

namespace rastercheck::cli::mask_command {
namespace {

struct Options {
  std::string file;
  PictureFlags flags;
  PicturePromise promise;
  std::string png;
  std::string bounds;
  bool all = false;
  bool json = false;
  bool quiet = false;
};

Result<cases::Case> case_of(const Options& options) {
  Result<cases::Case> c = cases::read_case(options.file);
  if (c) c = oracle::to_clip_case(*c, options.file);
  if (!c) return c;
  if (const auto few = check_sample_count(*c, options.file, options.all); !few) {
    return tl::unexpected(few.error());
  }
  for (const std::string& output : {options.png, options.bounds}) {
    if (output.empty()) continue;
    if (const auto is_free = check_output_file(output, options.file); !is_free) {
      return tl::unexpected(is_free.error());
    }
  }
  return c;
}

Result<void> write_masks(const Options& options, const records::PictureMask& mask) {
  if (!options.png.empty()) {
    const Result<void> written = cases::write_picture(reports::mask_picture(mask), options.png,
                                                      {{"Comment", reports::mask_legend()}});
    if (!written) return written;
  }
  return options.bounds.empty()
             ? Result<void>()
             : cases::write_picture(reports::bounds_picture(mask), options.bounds);
}

ExitCode run(const Options& options) {
  const Result<cases::Case> c = case_of(options);
  if (!c) return fail(c.error());
  const auto contract = contract_by(options.promise, *c);
  if (!contract) return contract.error();
  const oracle::SceneTruth scene(*c, *contract);
  const auto mask = layout_of(*c, options.flags).and_then([&](const cases::PictureLayout& layout) {
    const cases::PictureFile plan = cases::planned_picture(*c, layout);
    return cases::view_of(*c, layout, plan, options.file).map([&](const cases::PictureView& view) {
      return oracle::mask_of(scene, view);
    });
  });
  if (!mask) return fail(mask.error());
  if (const auto written = write_masks(options, *mask); !written) return fail(written.error());
  if (options.json) {
    fmt::print("{}\n", reports::mask_json(*mask));
  } else if (!options.quiet) {
    fmt::print("{}", reports::mask_text(*mask));
  }
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("CASE", options->file, "Case file; - reads standard input")
      ->type_name(kFile)
      ->required();
  add_picture_flags(app, options->flags);
  add_picture_promise(app, options->promise);
  app.add_option("--png", options->png, "Write the mask for people to this PNG file")
      ->type_name(kFile);
  app.add_option("--bounds", options->bounds,
                 "Write the least and the greatest permitted number of each channel to this "
                 "OpenEXR file, as the channels lower.R, upper.R and so on")
      ->type_name(kFile);
  app.add_flag("--all", options->all, "Allow more than 2^26 samples");
  app.add_flag("--json", options->json, "Print the numbers of pixels as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print nothing");
  app.footer(
      "A picture is right if every pixel is; a picture within the bounds may still be wrong, as "
      "they do not say which values of several channels belong together.\n\n"
      "Example:\n"
      "  rastercheck mask scene.json --storage unorm8 --png mask.png");
  return [options] { return run(*options); };
}

const Registration kRegistration("mask", "Say which pixels of a case's pictures may differ",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::mask_command
