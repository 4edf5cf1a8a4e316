#include "tests/bench/bench_scenes.h"

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <utility>

namespace rastercheck::bench {
namespace {

/// Pseudorandom numbers (SplitMix64).
class Scatter {
 public:
  explicit Scatter(std::uint64_t seed) : state_(seed) {}
  /// A number in [0, 1) that is a multiple of 2^-24.
  float unit() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24F;
  }
  /// An integer in [0, end).
  float below(int end) {
    return static_cast<float>(static_cast<int>(unit() * static_cast<float>(end)));
  }

 private:
  std::uint64_t state_;
};

Scene empty_scene(const glm::ivec2& size) {
  Scene scene;
  scene.size = size;
  return scene;
}

/// The clip position with this w of a window position in the scene's target.
glm::vec4 clip_position(const Scene& scene, float u, float v, float depth, float w) {
  const glm::vec2 size(scene.size);
  return {(2 * u / size.x - 1) * w, (2 * v / size.y - 1) * w, depth * w, w};
}

/// Adds a vertex with random attributes.
void add_vertex(Scene& scene, const glm::vec4& position, Scatter& scatter) {
  scene.positions.push_back(position);
  scene.attributes.push_back(scatter.unit());
  scene.attributes.push_back(scatter.unit());
}

void add_triangle(Scene& scene, const glm::vec4& a, const glm::vec4& b, const glm::vec4& c,
                  Scatter& scatter) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec4& p : {a, b, c}) add_vertex(scene, p, scatter);
  scene.triangles.emplace_back(first, first + 1, first + 2);
}

void add_full_triangle(Scene& scene, float depth, Scatter& scatter) {
  const glm::vec2 far = 2.0F * glm::vec2(scene.size);
  add_triangle(scene, clip_position(scene, 0, 0, depth, 1),
               clip_position(scene, far.x, 0, depth, 2),
               clip_position(scene, 0, far.y, depth, 1.5F), scatter);
}

using Polygon = std::vector<glm::dvec4>;

/// Keeps the part of a polygon in clip space where `side`, a linear form, is not negative.
void cut(Polygon& polygon, double (*side)(const glm::dvec4&)) {
  Polygon rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec4& p = polygon[i];
    const glm::dvec4& q = polygon[(i + 1) % polygon.size()];
    const double at_p = side(p);
    const double at_q = side(q);
    if (at_p >= 0) rest.push_back(p);
    if ((at_p < 0) != (at_q < 0)) rest.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  polygon = std::move(rest);
}

}  // namespace

Scene random_triangles(int count, float side, const glm::ivec2& size) {
  Scene scene = empty_scene(size);
  Scatter scatter(1);
  for (int i = 0; i < count; ++i) {
    const float u = scatter.unit() * (static_cast<float>(size.x) - side);
    const float v = scatter.unit() * (static_cast<float>(size.y) - side);
    const float depth = scatter.unit();
    const float w = 0.5F + 1.5F * scatter.unit();
    add_triangle(scene, clip_position(scene, u, v, depth, w),
                 clip_position(scene, u + side, v, depth, 1),
                 clip_position(scene, u, v + side, depth, 1), scatter);
  }
  return scene;
}

Scene grid_triangles(int count, int side) {
  Scene scene;
  Scatter scatter(1);
  const auto any_centre = [&] { return 0.5F + scatter.below(kTarget - side); };
  for (int i = 0; i < count; ++i) {
    const float u = any_centre();
    const float v = any_centre();
    const auto far = static_cast<float>(side);
    const float depth = scatter.unit();
    add_triangle(scene, clip_position(scene, u, v, depth, 1),
                 clip_position(scene, u + far, v, depth, 1),
                 clip_position(scene, u, v + far, depth, 1), scatter);
  }
  return scene;
}

Scene sprites(int count, int side) {
  Scene scene;
  Scatter scatter(1);
  for (int i = 0; i < count; ++i) {
    const float u = scatter.below(kTarget - side);
    const float v = scatter.below(kTarget - side);
    const auto far = static_cast<float>(side);
    const float depth = scatter.unit();
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    add_vertex(scene, clip_position(scene, u, v, depth, 1), scatter);
    add_vertex(scene, clip_position(scene, u + far, v, depth, 1), scatter);
    add_vertex(scene, clip_position(scene, u, v + far, depth, 1), scatter);
    add_vertex(scene, clip_position(scene, u + far, v + far, depth, 1), scatter);
    scene.triangles.emplace_back(first, first + 1, first + 2);
    scene.triangles.emplace_back(first + 2, first + 1, first + 3);
  }
  return scene;
}

Scene full_triangles(int count) {
  Scene scene;
  Scatter scatter(1);
  for (int i = 0; i < count; ++i) add_full_triangle(scene, scatter.unit(), scatter);
  return scene;
}

Scene layers_back_to_front(int count, const glm::ivec2& size) {
  Scene scene = empty_scene(size);
  Scatter scatter(1);
  for (int i = count; i > 0; --i) {
    add_full_triangle(scene, static_cast<float>(i) / static_cast<float>(count + 1), scatter);
  }
  return scene;
}

double drawn_area(const Scene& scene) {
  using Side = double (*)(const glm::dvec4&);
  constexpr Side kSides[] = {
      [](const glm::dvec4& p) { return p.z; }, [](const glm::dvec4& p) { return p.w - p.x; },
      [](const glm::dvec4& p) { return p.w + p.x; }, [](const glm::dvec4& p) { return p.w - p.y; },
      [](const glm::dvec4& p) { return p.w + p.y; }};
  const glm::dvec2 half = glm::dvec2(scene.size) / 2.0;
  const auto window = [&](const glm::dvec4& p) {
    return glm::dvec2(half.x * p.x / p.w, half.y * p.y / p.w);
  };
  double sum = 0;
  Polygon polygon;
  for (const glm::uvec3& t : scene.triangles) {
    polygon = {scene.positions[t.x], scene.positions[t.y], scene.positions[t.z]};
    for (const Side side : kSides) cut(polygon, side);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const glm::dvec2 origin = window(polygon[0]);
      const glm::dvec2 a = window(polygon[i - 1]) - origin;
      const glm::dvec2 b = window(polygon[i]) - origin;
      sum += std::abs(a.x * b.y - a.y * b.x) / 2;
    }
  }
  return sum;
}

}  // namespace rastercheck::bench
