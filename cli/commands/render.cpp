// `rastercheck render CASE --backend B`: prints what a backend draws, as fragments.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "backends/backend.h"
#include "cases/case_reader.h"
#include "cases/drawn_picture.h"
#include "cases/files.h"
#include "cases/fragments_json.h"
#include "cases/json.h"
#include "cases/picture_writer.h"
#include "cli/backend_failure.h"
#include "cli/command.h"
#include "cli/isolation.h"
#include "cli/output.h"
#include "cli/picture_option.h"
#include "cli/sample_limit.h"
#include "oracle/transform.h"
#include "properties/drawing.h"
#include "reports/picture.h"
#include "reports/png.h"

namespace rastercheck::cli::render_command {
namespace {

struct Options {
  std::string file;
  std::string backend = "cpu";
  std::string png;
  std::string picture;
  PictureFlags flags;
  double timeout = kDefaultTimeout;
  bool all = false;
  bool json = false;
  bool quiet = false;
};

void print_table(const cases::Case& c, const cases::Fragments& drawn, bool quiet) {
  constexpr std::string_view kRow = "{:>8} {:>5} {:>5} {:>3}  {:<15}";
  if (!quiet) {
    std::string header = fmt::format(kRow, "triangle", "x", "y", "s", "depth");
    for (const cases::Attribute& a : c.attributes) {
      header += fmt::format(" {:<15}", cases::printable(a.name));
    }
    header.erase(header.find_last_not_of(' ') + 1);
    fmt::print("{}\n", header);
  }
  for (std::size_t i = 0; i < drawn.size() && std::ferror(stdout) == 0; ++i) {
    std::string row = fmt::format(kRow, drawn.triangle[i], drawn.x[i], drawn.y[i], drawn.sample[i],
                                  fmt::format("{:.9g}", drawn.depth[i]));
    for (const float value : drawn.attributes_of(i)) {
      row += fmt::format(" {:<15}", fmt::format("{:.9g}", value));
    }
    row.erase(row.find_last_not_of(' ') + 1);
    fmt::print("{}\n", row);
  }
  if (!quiet) fmt::print("{} fragments\n", drawn.size());
}

/// Checks the name of the picture, if the user wants one.
Result<void> check_png(const Options& options) {
  if (options.png.empty()) return {};
  std::string ending = std::filesystem::path(options.png).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (!ending.empty() && ending != ".png") {
    return tl::unexpected(
        Error{"--png", options.png, "must end in .png, because the picture is a PNG"});
  }
  return check_output_file(options.png, options.file);
}

/// Writes the drawing as a picture with numbers, as `rastercheck judge` reads it.
Result<void> write_numbers(const Options& options, const cases::Case& c,
                           const cases::Fragments& drawn) {
  if (const auto is_free = check_output_file(options.picture, options.file); !is_free) {
    return is_free;
  }
  const Result<cases::PictureLayout> layout = layout_of(c, options.flags);
  if (!layout) return tl::unexpected(layout.error());
  const cases::PictureFile plan = cases::planned_picture(c, *layout);
  return cases::view_of(c, *layout, plan, options.picture)
      .and_then([&](const cases::PictureView& view) {
        return cases::write_picture(cases::picture_of(view, plan, drawn), options.picture);
      });
}

ExitCode run(const Options& options) {
  if (const Result<void> png = check_png(options); !png) return fail(png.error());
  auto backend = backend_factory(options.timeout).make(options.backend);
  if (!backend) return fail_backend(backend.error());
  Result<cases::Case> c = cases::read_case(options.file);
  if (c) c = oracle::to_clip_case(*c, options.file);
  if (!c) return fail(c.error());
  if (const auto few = check_sample_count(*c, options.file, options.all); !few) {
    return fail(few.error());
  }
  const Result<backends::Drawn> drawn = properties::draw(*c, **backend);
  if (!drawn) return fail({options.file, "", to_string(drawn.error())});
  if (!options.picture.empty()) {
    const Result<void> written = write_numbers(options, *c, drawn->fragments);
    return written ? ExitCode::ok : fail(written.error());
  }
  if (!options.png.empty()) {
    const Result<void> written = reports::to_png(reports::draw_picture(*c, drawn->fragments))
                                     .and_then([&options](const auto& bytes) {
                                       return cases::write_file(options.png, bytes);
                                     });
    if (!written) return fail(written.error());
    return ExitCode::ok;
  }
  if (options.json) {
    cases::write_fragments(drawn->fragments, options.backend, [](std::string_view text) {
      fmt::print("{}", text);
      return std::ferror(stdout) == 0;
    });
  } else {
    print_table(*c, drawn->fragments, options.quiet);
  }
  return ExitCode::ok;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("CASE", options->file, "Case file; - reads standard input")
      ->type_name(kFile)
      ->required();
  app.add_option("--backend", options->backend,
                 "Backend to draw with (see rastercheck list backends)")
      ->type_name(kBackend)
      ->capture_default_str();
  add_timeout(app, options->timeout);
  CLI::Option* png = app.add_option("--png", options->png,
                                    "Write a picture for people to this file and print nothing")
                         ->type_name(kFile);
  app.add_option("--picture", options->picture,
                 "Write the drawn numbers to this file, .exr, .png, .npy or .pfm, as rastercheck "
                 "judge reads them, and print nothing")
      ->type_name(kFile)
      ->excludes(png);
  add_picture_flags(app, options->flags);
  app.add_flag("--all", options->all, "Allow more than 2^26 samples");
  app.add_flag("--json", options->json,
               "Print the fragments as JSON, with values as hexadecimal floats");
  app.add_flag("-q,--quiet", options->quiet,
               "Print only the fragments, without header and summary");
  app.footer(
      "A fragment is a sample that a triangle covers. A case with a camera is drawn from its clip "
      "positions, rounded to float32.\n\n"
      "Example:\n"
      "  rastercheck render cases/corpus/first-triangle.json --png first.png");
  return [options] { return run(*options); };
}

const Registration kRegistration("render",
                                 "Print what a backend draws for a case, or save it as a picture",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::render_command
