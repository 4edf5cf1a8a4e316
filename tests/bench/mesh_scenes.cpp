#include "tests/bench/mesh_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>
#include <string>

#include "cases/mesh_reader.h"
#include "oracle/transform.h"
#include "tests/bench/quake_level.h"

namespace rastercheck::bench {
namespace {

/// The folder into which CMake has unpacked archives.
const std::string kUnpacked = RASTERCHECK_BENCH_DATA "/";
const std::string kModels = RASTERCHECK_BENCH_MODELS;

/// Fails if the file does not exist. `origin` names the package, and says what else must be done to
/// get the file.
Result<void> check_there(const std::string& file, const char* origin) {
  std::error_code unused;
  if (std::filesystem::exists(file, unused)) return {};
  return tl::unexpected(Error{file, "", std::string("not there: it comes with ") + origin});
}

/// Maps both attributes to 0…1, so that targets of bytes can also hold them.
void normalize_attributes(Scene& scene) {
  for (std::size_t a = 0; a < 2; ++a) {
    float lo = scene.attributes[a];
    float hi = lo;
    for (std::size_t i = a; i < scene.attributes.size(); i += 2) {
      lo = std::min(lo, scene.attributes[i]);
      hi = std::max(hi, scene.attributes[i]);
    }
    if (lo == hi) continue;
    for (std::size_t i = a; i < scene.attributes.size(); i += 2) {
      scene.attributes[i] = (scene.attributes[i] - lo) / (hi - lo);
    }
  }
}

Result<Scene> framed_mesh(const std::string& file, const char* origin, const glm::ivec2& size) {
  const auto framed =
      check_there(file, origin)
          .and_then([&] { return cases::read_mesh(file); })
          .and_then([&](const cases::Mesh& mesh) {
            return cases::case_of_mesh(mesh, file, seen_from_the_front(mesh, size));
          })
          .and_then([&](const cases::Imported& c) { return oracle::to_clip_case(c.drawn, file); });
  if (!framed) return tl::unexpected(framed.error());
  Scene scene;
  scene.size = size;
  for (const cases::ClipVertex& p : framed->positions) {
    scene.positions.emplace_back(p.x, p.y, p.z, p.w);
  }
  scene.attributes = framed->attribute_values;
  for (const cases::Triangle& t : framed->triangles) scene.triangles.emplace_back(t[0], t[1], t[2]);
  normalize_attributes(scene);
  return scene;
}

}  // namespace

cases::MeshOptions seen_from_the_front(const cases::Mesh& mesh, const glm::ivec2& size) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 lo(kInfinity);
  glm::dvec3 hi(-kInfinity);
  for (const auto& [x, y, z] : mesh.positions) {
    lo = glm::min(lo, glm::dvec3(x, y, z));
    hi = glm::max(hi, glm::dvec3(x, y, z));
  }
  // A sphere touches the sides of a view cone of slope s at distance radius · sqrt(1 + s²) / s.
  constexpr double kSlope = 0.5;
  const glm::dvec3 middle = (lo + hi) / 2.0;
  const double radius = 1.05 * glm::length(hi - lo) / 2;
  const glm::dvec3 eye = middle + glm::normalize(glm::dvec3(0.25, 0.25, 1)) *
                                      (radius * std::sqrt(1 + kSlope * kSlope) / kSlope);
  const double slope = kSlope * std::max(1.0, double(size.y) / double(size.x));
  cases::MeshOptions options{size.x, size.y};
  options.view = {std::array{eye.x, eye.y, eye.z},
                  std::array{middle.x, middle.y, middle.z},
                  {},
                  std::atan(slope) * 360 / std::numbers::pi};
  return options;
}

Result<Scene> bunny(const glm::ivec2& size) {
  return framed_mesh(RASTERCHECK_BUNNY, "glmark2-data", size);
}

Result<Scene> armadillo(const glm::ivec2& size) {
  return framed_mesh(kUnpacked + "data/meshes/armadillo.off", "libcgal-demo; then configure anew",
                     size);
}

Result<Scene> engine(const glm::ivec2& size) {
  return framed_mesh(kModels + "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
                     "assimp-testmodels", size);
}

Result<Scene> human(const glm::ivec2& size) {
  return framed_mesh(kModels + "Collada/human.zae", "assimp-testmodels", size);
}

Result<Scene> castle(const glm::ivec2& size) {
  const std::string file = kUnpacked + "maps/oasago2.bsp";
  const auto level = check_there(file, "openarena-081-maps; then configure anew").and_then([&] {
    return read_quake_level(file);
  });
  if (!level) return tl::unexpected(level.error());
  // The eye of a player, in the game's units with z up, and its viewing direction in the level.
  // Only sums and products of floats are used, which give the same bits everywhere.
  constexpr glm::vec3 kEye{-1984, -892, 66};
  constexpr glm::vec2 kAhead{0.8F, 0.6F};
  constexpr float kNear = 4;
  const float narrow = static_cast<float>(size.y) / static_cast<float>(size.x);
  Scene scene;
  scene.size = size;
  for (const glm::vec3& p : level->positions) {
    const glm::vec3 to = p - kEye;
    const float ahead = to.x * kAhead.x + to.y * kAhead.y;
    const float right = to.x * kAhead.y - to.y * kAhead.x;
    // The field of view is 90° vertically, and there is no far plane.
    scene.positions.emplace_back(right * narrow, -to.z, ahead - kNear, ahead);
  }
  for (const glm::vec2& t : level->texture_coordinates) {
    scene.attributes.insert(scene.attributes.end(), {t.x, t.y});
  }
  scene.triangles = level->triangles;
  normalize_attributes(scene);
  return scene;
}

}  // namespace rastercheck::bench
