#include "tests/bench/frame_scenes.h"

#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "tests/bench/mesh_scenes.h"

namespace rastercheck::bench {
namespace {

constexpr glm::ivec2 kSquare{kTarget, kTarget};
constexpr glm::ivec2 kWide{1920, 1080};

/// Random triangles, each with that area in pixels.
Scene random_by_area(int count, float area, const glm::ivec2& size = kSquare) {
  return random_triangles(count, std::sqrt(2 * area), size);
}

struct FrameScene {
  std::string_view name;
  Result<Scene> (*make)();
};

/// Each scene has so many triangles that drawing them, and not clearing, takes most of the time.
constexpr FrameScene kFrameScenes[] = {
    {"fill_32_layers", [] { return Result<Scene>(layers_back_to_front(32)); }},
    {"random_1px", [] { return Result<Scene>(random_by_area(200'000, 1.3F)); }},
    {"random_8px", [] { return Result<Scene>(random_by_area(100'000, 8)); }},
    {"grid_8px", [] { return Result<Scene>(grid_triangles(100'000, 4)); }},
    {"random_72px", [] { return Result<Scene>(random_by_area(20'000, 72)); }},
    {"random_805px", [] { return Result<Scene>(random_by_area(2000, 805)); }},
    {"sprites", [] { return Result<Scene>(sprites(10'000, 16)); }},
    {"bunny", [] { return bunny(kSquare); }},
    {"armadillo", [] { return armadillo(kSquare); }},
    {"engine", [] { return engine(kSquare); }},
    {"human", [] { return human(kSquare); }},
    {"castle", [] { return castle(kSquare); }},
    {"fill_32_layers@1920x1080", [] { return Result<Scene>(layers_back_to_front(32, kWide)); }},
    {"random_8px@1920x1080", [] { return Result<Scene>(random_by_area(100'000, 8, kWide)); }},
    {"bunny@1920x1080", [] { return bunny(kWide); }},
};

Result<Scene> make_scene(std::string_view name) {
  for (const FrameScene& scene : kFrameScenes) {
    if (scene.name == name) return scene.make();
  }
  return tl::unexpected(Error{std::string(name), "", "no scene of that name"});
}

}  // namespace

const std::vector<std::string_view>& frame_scenes() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const FrameScene& scene : kFrameScenes) all.push_back(scene.name);
    return all;
  }();
  return names;
}

const Result<Scene>& frame_scene(std::string_view name) {
  static std::map<std::string, Result<Scene>, std::less<>> made;
  const auto known = made.find(name);
  if (known != made.end()) return known->second;
  return made.emplace(std::string(name), make_scene(name)).first->second;
}

}  // namespace rastercheck::bench
