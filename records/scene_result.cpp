#include "records/scene_result.h"

#include <fmt/format.h>

#include "records/share.h"

namespace rastercheck::records {
namespace {

std::string counted(std::uint64_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::string scene_sentence(const SceneResult& scene) {
  std::string text = fmt::format("Scene {} on {}: ", scene.file, scene.backend);
  if (scene.judged > 0) {
    const std::uint64_t samples = scene.judged + scene.open;
    const std::string judged = scene.open == 0 ? counted(scene.judged, "sample") + " judged"
                                               : fmt::format("{} of {} judged ({})", scene.judged,
                                                             counted(samples, "sample"),
                                                             share_text(scene.judged, samples));
    text += fmt::format("{}, {}; {}, {}", counted(scene.triangles, "triangle"),
                        counted(scene.fragments, "fragment"), judged,
                        scene.wrong == 0 ? "all correct"
                                         : fmt::format("{} wrong{}", scene.wrong,
                                                       scene.is_known ? ", in known ways" : ""));
  } else if (scene.open > 0) {
    text +=
        fmt::format("its {} could not be judged: the contract leaves something open for each of {}",
                    counted(scene.triangles, "triangle"), counted(scene.open, "fragment"));
  } else if (scene.not_judged.empty()) {
    text += fmt::format("its {} could not be judged: no sample is required to be drawn",
                        counted(scene.triangles, "triangle"));
  } else {
    text += fmt::format("its {} could not be judged", counted(scene.triangles, "triangle"));
  }
  if (!scene.values_not_judged.empty()) {
    text += fmt::format("; {} judged", counted(scene.values, "value"));
    for (const auto& [why, count] : scene.values_not_judged)
      text += fmt::format(", {} {}", count, why);
  }
  for (const auto& [why, triangles] : scene.not_judged) {
    const bool are_all = triangles == scene.triangles;
    text += are_all ? ": " + why
                    : fmt::format("; {} not judged: {}", counted(triangles, "triangle"), why);
  }
  return text + ".";
}

}  // namespace rastercheck::records
