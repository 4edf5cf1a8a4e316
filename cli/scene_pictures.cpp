#include "cli/scene_pictures.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>

#include "backends/backend.h"
#include "properties/scene.h"
#include "reports/picture.h"
#include "reports/png.h"

namespace rastercheck::cli {
namespace {

Result<records::Picture> picture(std::string name, std::string caption,
                                 const reports::Image& image) {
  Result<std::string> png = reports::to_png(image);
  if (!png) return tl::unexpected(png.error());
  return records::Picture{std::move(name), std::move(caption), image.width, image.height,
                          *std::move(png)};
}

}  // namespace

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

}  // namespace rastercheck::cli
