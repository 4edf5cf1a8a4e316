// `rastercheck gallery`: redraws the figures of the textbooks and papers that RasterCheck is based
// on.

#include "cli/gallery/gallery.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/terminal.h"
#include "reports/text_table.h"

namespace rastercheck::cli::gallery_command {
namespace {

using nlohmann::ordered_json;
using reports::GalleryFigure;
using reports::GalleryPicture;

struct Options {
  std::string output = "rastercheck-out/gallery";
  int size = gallery::Canvas().size;
  bool json = false;
  bool quiet = false;
};

void print_table(const std::vector<GalleryFigure>& figures, bool quiet) {
  std::vector<std::vector<std::string>> rows;
  if (!quiet) rows.push_back({"picture", "method", "worst", "99 in 100", "unit", "samples"});
  for (const GalleryFigure& figure : figures) {
    for (const GalleryPicture& picture : figure.pictures) {
      rows.push_back({picture.name, picture.method});
      if (!picture.missing.empty()) {
        rows.back().push_back(picture.missing);
        continue;
      }
      rows.back().push_back(reports::gallery_error_text(picture.worst));
      rows.back().push_back(reports::gallery_error_text(picture.p99));
      rows.back().push_back(std::string(picture.scale->unit));
      rows.back().push_back(std::to_string(picture.samples));
    }
  }
  fmt::print("{}", reports::text_table(rows, quiet ? std::nullopt : terminal_columns()));
}

void print_json(const std::vector<GalleryFigure>& figures) {
  ordered_json pictures = ordered_json::array();
  for (const GalleryFigure& figure : figures) {
    for (const GalleryPicture& picture : figure.pictures) {
      ordered_json row{
          {"figure", figure.title}, {"picture", picture.name}, {"method", picture.method}};
      if (picture.missing.empty()) {
        row.update({{"unit", picture.scale->unit},
                    {"worst", picture.worst},
                    {"p99", picture.p99},
                    {"samples", picture.samples},
                    {"violations", picture.violations}});
      } else {
        row["missing"] = picture.missing;
      }
      pictures.push_back(std::move(row));
    }
  }
  fmt::print("{}\n", ordered_json{{"pictures", std::move(pictures)}}.dump());
}

bool holds(const std::vector<GalleryFigure>& figures) {
  for (const GalleryFigure& figure : figures) {
    for (const GalleryPicture& picture : figure.pictures) {
      if (picture.violations > 0) return false;
    }
  }
  return true;
}

ExitCode run(const Options& options) {
  std::error_code why;
  std::filesystem::create_directories(options.output, why);
  if (why) return fail({options.output, "", "cannot be created: " + why.message()});
  const Result<std::vector<GalleryFigure>> figures = gallery::draw_gallery({options.size});
  if (!figures) return fail_internally(figures.error());
  const Result<void> written = gallery::write_gallery(*figures, options.output);
  if (!written) return fail(written.error());
  if (options.json) {
    print_json(*figures);
  } else {
    print_table(*figures, options.quiet);
    if (!options.quiet) fmt::print("Gallery: {}/index.html\n", options.output);
  }
  return holds(*figures) ? ExitCode::ok : ExitCode::violated;
}

Action set_up(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("--output", options->output, "Folder for the page and its pictures")
      ->type_name(kFolder)
      ->capture_default_str();
  app.add_option("--size", options->size, "Width and height of a picture, in pixels")
      ->check(CLI::Range(64, 2048))
      ->type_name("N")
      ->capture_default_str();
  app.add_flag("--json", options->json, "Print the table as JSON");
  app.add_flag("-q,--quiet", options->quiet, "Print only the table's rows");
  app.footer(
      "The figures come from the publications of the textbook methods. Exit code 0 if every "
      "drawing is as its method promises, 1 if one is not.\n\n"
      "Example:\n"
      "  rastercheck gallery --output gallery");
  return [options] { return run(*options); };
}

const Registration kRegistration("gallery", "Redraw figures of textbooks, with their errors",
                                 &set_up);

}  // namespace
}  // namespace rastercheck::cli::gallery_command
