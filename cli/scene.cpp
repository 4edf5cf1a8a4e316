#include "cli/scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case_reader.h"
#include "cases/json.h"
#include "cases/mesh_reader.h"
#include "cli/mesh_file.h"
#include "oracle/transform.h"
#include "properties/campaign/scene.h"
#include "reports/error_picture.h"
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

Result<cases::Case> read_scene(const records::Plan& plan) {
  const std::string& file = plan.scene;
  const int size = plan.scene_size;
  const auto with_notes = [&file](cases::Imported imported) {
    print_notes(file, imported.notes);
    return std::move(imported.drawn);
  };
  const bool is_mesh = cases::is_mesh_file(file);
  Result<cases::Case> scene =
      is_mesh ? case_from_mesh_file(file, "", {size, size, cases::Rules::vulkan}).map(with_notes)
              : cases::read_case(file);
  if (scene) scene = oracle::to_clip_case(*scene, file);
  if (scene && (is_mesh || scene->name.empty())) {
    scene->name = file == "-" ? "standard input"
                              : cases::valid_utf8(std::filesystem::path(file).filename().string());
  }
  if (scene && plan.draw_by == cases::DrawBy::frame) scene->depth_test = cases::DepthTest::less;
  return scene;
}

Result<JudgedScene> judge_scene_of(const records::Plan& plan, const cases::Case& scene,
                                   const backends::BackendFactory& backends, unsigned jobs,
                                   const properties::KnownByBackend& known) {
  JudgedScene all;
  for (const std::string& specification : plan.backends) {
    auto backend = backends.make(specification);
    if (!backend) return tl::unexpected(backend.error());
    const auto found_known = known.find(specification);
    const properties::KnownDefects* const defects =
        found_known == known.end() ? nullptr : &found_known->second;
    std::vector<std::string> laws = plan.laws;
    if (defects != nullptr) {
      std::erase_if(laws, [&](const std::string& law) { return defects->is_skipped(law); });
    }
    Result<properties::SceneFindings> found =
        properties::judge_scene(scene, specification, **backend, plan.seed, laws, jobs, defects);
    if (!found) return tl::unexpected(found.error());
    properties::merge(all.findings, std::move(found->findings));
    all.results.push_back(found->result);
    if (!found->drawn) continue;
    const std::string stem =
        std::filesystem::path(scene.name).stem().string() + "-" + specification;
    const Result<records::Picture> drawn =
        picture(stem, fmt::format("{} as drawn by {}.", scene.name, specification),
                reports::draw_picture(found->source, *found->drawn));
    const Result<records::Picture> errors =
        picture(stem + "-errors",
                "Errors: for each pixel, the largest error of its attributes, in scale ULP.",
                reports::draw_error_map(found->map, found->source.rules));
    if (!drawn) return tl::unexpected(drawn.error());
    if (!errors) return tl::unexpected(errors.error());
    all.pictures.push_back(*drawn);
    all.pictures.push_back(*errors);
  }
  return all;
}

}  // namespace rastercheck::cli
