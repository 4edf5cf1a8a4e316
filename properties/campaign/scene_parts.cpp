#include "properties/campaign/scene_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace rastercheck::properties {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Returns the number of pixels in 0…extent that lie between two window coordinates.
std::uint64_t pixels_between(double least, double greatest, int extent) {
  const auto all = static_cast<double>(extent);
  const double from = std::clamp(std::floor(least), 0.0, all);
  const double to = std::clamp(std::ceil(greatest), 0.0, all);
  return to > from ? static_cast<std::uint64_t>(to - from) : 0;
}

/// The distance from a plane of the view volume, negative outside. The near plane is OpenGL's:
/// points outside it are outside in every convention.
using PlaneDistance = double (*)(const std::array<double, 4>& p);
constexpr std::array<PlaneDistance, 6> kPlanes{
    [](const std::array<double, 4>& p) { return p[3] + p[0]; },
    [](const std::array<double, 4>& p) { return p[3] - p[0]; },
    [](const std::array<double, 4>& p) { return p[3] + p[1]; },
    [](const std::array<double, 4>& p) { return p[3] - p[1]; },
    [](const std::array<double, 4>& p) { return p[3] + p[2]; },
    [](const std::array<double, 4>& p) { return p[3] - p[2]; }};

/// Clips a convex polygon in clip space by a plane.
std::vector<std::array<double, 4>> clipped(const std::vector<std::array<double, 4>>& polygon,
                                           PlaneDistance plane) {
  std::vector<std::array<double, 4>> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    const double at_a = plane(a);
    const double at_b = plane(b);
    if (at_a >= 0) left.push_back(a);
    if ((at_a < 0) == (at_b < 0)) continue;
    std::array<double, 4> between{};
    const double share = at_a / (at_a - at_b);
    for (std::size_t k = 0; k < 4; ++k) between[k] = a[k] + share * (b[k] - a[k]);
    left.push_back(between);
  }
  return left;
}

/// Estimates the number of samples in the bounding box of the triangle's visible part.
std::uint64_t samples_of(const cases::Case& c, const cases::Triangle& triangle) {
  std::vector<std::array<double, 4>> polygon;
  for (const std::uint32_t vertex : triangle) {
    const cases::ClipVertex& p = c.positions[vertex];
    polygon.push_back({double{p.x}, double{p.y}, double{p.z}, double{p.w}});
  }
  for (const PlaneDistance plane : std::span(kPlanes).first(c.depth_clamp ? 4 : 6)) {
    polygon = clipped(polygon, plane);
  }
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<double, 2> least{kFar, kFar};
  std::array<double, 2> greatest{-kFar, -kFar};
  const cases::Viewport& v = c.viewport;
  for (const auto& [x, y, z, w] : polygon) {
    const std::array<double, 2> at{(x / w + 1) / 2 * double{v.width} + double{v.x},
                                   (y / w + 1) / 2 * double{v.height} + double{v.y}};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      least[axis] = std::min(least[axis], at[axis]);
      greatest[axis] = std::max(greatest[axis], at[axis]);
    }
  }
  return pixels_between(least[0], greatest[0], c.framebuffer.width) *
         pixels_between(least[1], greatest[1], c.framebuffer.height) *
         static_cast<std::uint64_t>(c.framebuffer.samples);
}

}  // namespace

ScenePart next_part(const cases::Case& scene, std::size_t first, const PartLimits& limits) {
  ScenePart part{first, 0};
  if (scene.depth_test != cases::DepthTest::none) {
    part.count = scene.triangles.size() - first;
    return part;
  }
  std::uint64_t samples = 0;
  while (first + part.count < scene.triangles.size() && part.count < limits.triangles) {
    samples += samples_of(scene, scene.triangles[first + part.count]);
    if (part.count > 0 && samples > limits.samples) break;
    ++part.count;
  }
  return part;
}

ShownFragments::ShownFragments(const cases::FramebufferSize& size, std::size_t attributes)
    : size_(size),
      slots_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height), kNone) {
  shown_.attribute_count = attributes;
}

bool ShownFragments::goes_before(const cases::Fragments& drawn, std::size_t i,
                                 std::size_t shown) const {
  if (drawn.sample[i] != shown_.sample[shown]) return drawn.sample[i] < shown_.sample[shown];
  if (std::isnan(shown_.depth[shown])) return !std::isnan(drawn.depth[i]);
  return drawn.depth[i] < shown_.depth[shown];
}

void ShownFragments::add(const cases::Fragments& drawn, std::size_t first_triangle) {
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn.x[i] >= size_.width || drawn.y[i] >= size_.height) continue;
    std::size_t& slot = slots_[drawn.y[i] * static_cast<std::size_t>(size_.width) + drawn.x[i]];
    const auto triangle = static_cast<std::uint32_t>(drawn.triangle[i] + first_triangle);
    const auto values = drawn.attributes_of(i);
    if (slot == kNone) {
      slot = shown_.size();
      shown_.triangle.push_back(triangle);
      shown_.x.push_back(drawn.x[i]);
      shown_.y.push_back(drawn.y[i]);
      shown_.sample.push_back(drawn.sample[i]);
      shown_.depth.push_back(drawn.depth[i]);
      shown_.attributes.insert(shown_.attributes.end(), values.begin(), values.end());
    } else if (goes_before(drawn, i, slot)) {
      shown_.triangle[slot] = triangle;
      shown_.sample[slot] = drawn.sample[i];
      shown_.depth[slot] = drawn.depth[i];
      std::copy(
          values.begin(), values.end(),
          shown_.attributes.begin() + static_cast<std::ptrdiff_t>(slot * shown_.attribute_count));
    }
  }
}

}  // namespace rastercheck::properties
