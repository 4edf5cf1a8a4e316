#include "tests/bench/bench_scenes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "cases/mesh.h"
#include "oracle/transform.h"

namespace rastercheck::bench {
namespace {

/// Numbers that look random (SplitMix64).
class Scatter {
 public:
  explicit Scatter(std::uint64_t seed) : state_(seed) {}
  /// In [0, 1), a multiple of 2^-24.
  float unit() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24F;
  }

 private:
  std::uint64_t state_;
};

/// A window position of the target as a clip position of that w.
glm::vec4 clip_position(float u, float v, float depth, float w) {
  return {(2 * u / kTarget - 1) * w, (2 * v / kTarget - 1) * w, depth * w, w};
}

void add_triangle(Scene& scene, const glm::vec4& a, const glm::vec4& b, const glm::vec4& c,
                  Scatter& scatter) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec4& p : {a, b, c}) {
    scene.positions.push_back(p);
    scene.attributes.push_back(scatter.unit());
    scene.attributes.push_back(scatter.unit());
  }
  scene.triangles.emplace_back(first, first + 1, first + 2);
}

void add_full_triangle(Scene& scene, float depth, Scatter& scatter) {
  constexpr float kFar = 2 * kTarget;
  add_triangle(scene, clip_position(0, 0, depth, 1), clip_position(kFar, 0, depth, 2),
               clip_position(0, kFar, depth, 1.5F), scatter);
}

/// The bunny, framed: a mesh as meshes are, 69,666 triangles of a pixel or so at this size.
Result<Scene> bunny() {
  const std::string file = "/usr/share/glmark2/models/bunny.obj";
  const auto framed =
      cases::case_from_mesh(file, {kTarget, kTarget}).and_then([&](const cases::Case& c) {
        return oracle::to_clip_case(c, file);
      });
  if (!framed) return tl::unexpected(framed.error());
  Scene scene;
  for (const cases::ClipVertex& p : framed->positions) {
    scene.positions.emplace_back(p.x, p.y, p.z, p.w);
  }
  scene.attributes = framed->attribute_values;
  for (const cases::Triangle& t : framed->triangles) scene.triangles.emplace_back(t[0], t[1], t[2]);
  return scene;
}

struct FrameScene {
  std::string_view name;
  Result<Scene> (*make)();
};

constexpr FrameScene kFrameScenes[] = {
    {"fill_32_layers", [] { return Result<Scene>(layers_back_to_front(32)); }},
    {"random_1px", [] { return Result<Scene>(random_triangles(20000, 1.3F)); }},
    {"random_8px", [] { return Result<Scene>(random_triangles(20000, 8)); }},
    {"grid_8px", [] { return Result<Scene>(grid_triangles(20000, 8)); }},
    {"random_72px", [] { return Result<Scene>(random_triangles(2000, 72)); }},
    {"random_805px", [] { return Result<Scene>(random_triangles(20, 805)); }},
    {"bunny", &bunny},
};

}  // namespace

Scene random_triangles(int count, float side) {
  Scene scene;
  Scatter scatter(1);
  for (int i = 0; i < count; ++i) {
    const float u = scatter.unit() * (kTarget - side);
    const float v = scatter.unit() * (kTarget - side);
    const float depth = scatter.unit();
    const float w = 0.5F + 1.5F * scatter.unit();
    add_triangle(scene, clip_position(u, v, depth, w), clip_position(u + side, v, depth, 1),
                 clip_position(u, v + side, depth, 1), scatter);
  }
  return scene;
}

Scene grid_triangles(int count, int side) {
  Scene scene;
  Scatter scatter(1);
  const auto any_centre = [&] {
    return 0.5F + static_cast<float>(
                      static_cast<int>(scatter.unit() * static_cast<float>(kTarget - side)));
  };
  for (int i = 0; i < count; ++i) {
    const float u = any_centre();
    const float v = any_centre();
    const auto far = static_cast<float>(side);
    const float depth = scatter.unit();
    add_triangle(scene, clip_position(u, v, depth, 1), clip_position(u + far, v, depth, 1),
                 clip_position(u, v + far, depth, 1), scatter);
  }
  return scene;
}

Scene full_triangles(int count) {
  Scene scene;
  Scatter scatter(1);
  for (int i = 0; i < count; ++i) add_full_triangle(scene, scatter.unit(), scatter);
  return scene;
}

Scene layers_back_to_front(int count) {
  Scene scene;
  Scatter scatter(1);
  for (int i = count; i > 0; --i) {
    add_full_triangle(scene, static_cast<float>(i) / static_cast<float>(count + 1), scatter);
  }
  return scene;
}

const std::vector<std::string_view>& frame_scenes() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const FrameScene& scene : kFrameScenes) all.push_back(scene.name);
    return all;
  }();
  return names;
}

Result<Scene> frame_scene(std::string_view name) {
  for (const FrameScene& scene : kFrameScenes) {
    if (scene.name == name) return scene.make();
  }
  return tl::unexpected(Error{std::string(name), "", "no scene of that name"});
}

double drawn_area(const Scene& scene) {
  const auto window = [](const glm::vec4& p) {
    return glm::dvec2(kTarget / 2.0 * p.x / p.w, kTarget / 2.0 * p.y / p.w);
  };
  double sum = 0;
  for (const glm::uvec3& t : scene.triangles) {
    const glm::dvec2 origin = window(scene.positions[t.x]);
    const glm::dvec2 a = window(scene.positions[t.y]) - origin;
    const glm::dvec2 b = window(scene.positions[t.z]) - origin;
    sum += std::min(std::abs(a.x * b.y - a.y * b.x) / 2, double{kTarget} * kTarget);
  }
  return sum;
}

}  // namespace rastercheck::bench
