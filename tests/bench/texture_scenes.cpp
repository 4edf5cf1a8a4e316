#include "tests/bench/texture_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/bench/frame_scenes.h"

namespace rastercheck::bench {
namespace {

using Point = glm::dvec2;

/// A wave 0…255…0 over `period` texels, which rises and falls equally steeply.
int wave(int texel, int period) {
  const int at = texel & (period - 1);
  return 255 * std::min(at, period - at) / (period / 2);
}

/// A pseudorandom number 0…15.
int grain(std::uint32_t texel, std::uint32_t channel) {
  std::uint32_t h = (4 * texel + channel) * 0x9e3779b9U;
  h = (h ^ (h >> 15)) * 0x85ebca6bU;
  return static_cast<int>((h ^ (h >> 13)) >> 28);
}

std::vector<std::uint8_t> make_texels() {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(std::size_t{4} * kTextureSize * kTextureSize);
  for (int y = 0; y < kTextureSize; ++y) {
    for (int x = 0; x < kTextureSize; ++x) {
      const bool is_thin = ((x / 16) ^ (y / 16)) % 2 != 0;
      // With these phases, mirroring changes the texture.
      const int base[] = {wave(x + 200, kTextureSize), wave(y + 330, kTextureSize),
                          wave(x + 3 * y, kTextureSize / 2), is_thin ? 64 : 192};
      const auto texel = static_cast<std::uint32_t>(y * kTextureSize + x);
      for (std::uint32_t channel = 0; channel < 4; ++channel) {
        rgba.push_back(
            static_cast<std::uint8_t>(base[channel] * 240 / 255 + grain(texel, channel)));
      }
    }
  }
  return rgba;
}

Result<rasterizer::Texture> make_texture() {
  rasterizer::Texture texture;
  if (const auto error =
          rasterizer::Texture::make(kTextureSize, kTextureSize, make_texels(), texture)) {
    return tl::unexpected(Error{"", "", std::string(rasterizer::to_string(*error))});
  }
  return texture;
}

double area(const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a;
  const Point ac = c - a;
  return std::abs(ab.x * ac.y - ab.y * ac.x) / 2;
}

/// The factor by which to multiply the attributes to get one texel per pixel, averaged over all
/// triangles in front of the eye, in the target or not.
double texel_per_pixel(const Scene& scene) {
  double pixels = 0;
  double texels = 0;
  const auto window = [&](std::uint32_t vertex) {
    const glm::dvec4 p(scene.positions[vertex]);
    return Point(p.x / p.w * scene.size.x / 2, p.y / p.w * scene.size.y / 2);
  };
  const auto texel = [&](std::uint32_t vertex) {
    return double{kTextureSize} * Point(scene.attributes[std::size_t{2} * vertex],
                                        scene.attributes[std::size_t{2} * vertex + 1]);
  };
  for (const glm::uvec3& t : scene.triangles) {
    if (scene.positions[t.x].w <= 0 || scene.positions[t.y].w <= 0 || scene.positions[t.z].w <= 0) {
      continue;
    }
    pixels += area(window(t.x), window(t.y), window(t.z));
    texels += area(texel(t.x), texel(t.y), texel(t.z));
  }
  return texels > 0 ? std::sqrt(pixels / texels) : 1;
}

Scene with_texture_coordinates(Scene scene) {
  const auto scale = static_cast<float>(texel_per_pixel(scene));
  for (float& value : scene.attributes) value *= scale;
  if (scene.positions.size() != 3 * scene.triangles.size()) return scene;
  // Places are multiples of 2^-10, the width of a texel, and are spread evenly: they are the
  // fractions of multiples of 1/g and 1/g², where g³ = g + 1, in 32 bits.
  const auto place = [](std::uint32_t fraction) {
    return static_cast<float>(fraction >> 22) * 0x1p-10F;
  };
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const auto number = static_cast<std::uint32_t>(i);
    const glm::uvec3& triangle = scene.triangles[i];
    for (const std::size_t vertex : {triangle.x, triangle.y, triangle.z}) {
      scene.attributes[2 * vertex] += place(number * 0xc13fa9a9U);
      scene.attributes[2 * vertex + 1] += place(number * 0x91e10da5U);
    }
  }
  return scene;
}

}  // namespace

const Result<rasterizer::Texture>& bench_texture() {
  static const Result<rasterizer::Texture> texture = make_texture();
  return texture;
}

const Result<Scene>& shaded_scene(std::string_view name, const DrawKind& kind) {
  const Result<Scene>& scene = frame_scene(name);
  if (!scene || !kind.filter) return scene;
  static std::map<std::string, Result<Scene>, std::less<>> made;
  const auto known = made.find(name);
  if (known != made.end()) return known->second;
  return made.emplace(std::string(name), with_texture_coordinates(*scene)).first->second;
}

}  // namespace rastercheck::bench
