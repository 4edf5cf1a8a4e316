#include "properties/campaign/scene_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rastercheck::properties {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Pixels of 0…extent that lie between two places of the window.
std::uint64_t pixels_between(double least, double greatest, int extent) {
  const auto all = static_cast<double>(extent);
  const double from = std::clamp(std::floor(least), 0.0, all);
  const double to = std::clamp(std::ceil(greatest), 0.0, all);
  return to > from ? static_cast<std::uint64_t>(to - from) : 0;
}

/// Samples in the triangle's bounding box, about: of one that reaches behind the eye all there are.
std::uint64_t samples_of(const cases::Case& c, const cases::Triangle& triangle) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<double, 2> least{kFar, kFar};
  std::array<double, 2> greatest{-kFar, -kFar};
  const auto include = [&](std::size_t axis, double at) {
    least[axis] = std::min(least[axis], at);
    greatest[axis] = std::max(greatest[axis], at);
  };
  for (const std::uint32_t vertex : triangle) {
    const cases::ClipVertex& p = c.positions[vertex];
    if (!(p.w > 0)) {
      least = {0, 0};
      greatest = {static_cast<double>(c.framebuffer.width),
                  static_cast<double>(c.framebuffer.height)};
      break;
    }
    include(0, (double{p.x} / double{p.w} + 1) / 2 * double{c.viewport.width} +
                   double{c.viewport.x});
    include(1, (double{p.y} / double{p.w} + 1) / 2 * double{c.viewport.height} +
                   double{c.viewport.y});
  }
  return pixels_between(least[0], greatest[0], c.framebuffer.width) *
         pixels_between(least[1], greatest[1], c.framebuffer.height) *
         static_cast<std::uint64_t>(c.framebuffer.samples);
}

}  // namespace

std::vector<ScenePart> parts_of(const cases::Case& scene, const PartLimits& limits) {
  const std::size_t count = scene.triangles.size();
  if (scene.depth_test != cases::DepthTest::none || count == 0) return {{0, count}};
  std::vector<ScenePart> parts;
  std::uint64_t samples = 0;
  for (std::size_t t = 0; t < count; ++t) {
    const std::uint64_t more = samples_of(scene, scene.triangles[t]);
    const bool is_full = parts.empty() || samples + more > limits.samples ||
                         parts.back().count == limits.triangles;
    if (is_full) {
      parts.push_back({t, 0});
      samples = 0;
    }
    ++parts.back().count;
    samples += more;
  }
  return parts;
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
    std::size_t& slot =
        slots_[drawn.y[i] * static_cast<std::size_t>(size_.width) + drawn.x[i]];
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
      std::copy(values.begin(), values.end(),
                shown_.attributes.begin() +
                    static_cast<std::ptrdiff_t>(slot * shown_.attribute_count));
    }
  }
}

}  // namespace rastercheck::properties
