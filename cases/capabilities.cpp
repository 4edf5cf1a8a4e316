#include "cases/capabilities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace rastercheck::cases {
namespace {

/// True if the predicate holds for some vertex of a triangle; false for a case with a camera.
template <typename Is>
bool has_vertex(const Case& c, const Is& is) {
  if (c.camera) return false;
  return std::any_of(c.triangles.begin(), c.triangles.end(), [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return is(c.positions[v]); });
  });
}

bool has_attribute(const Case& c, Interpolation interpolation) {
  return std::any_of(c.attributes.begin(), c.attributes.end(),
                     [&](const Attribute& a) { return a.interpolation == interpolation; });
}

/// True if an attribute has this location and the location may differ from the sample's.
bool has_location(const Case& c, Location location) {
  return c.framebuffer.samples > 1 &&
         std::any_of(c.attributes.begin(), c.attributes.end(), [&](const Attribute& a) {
           return a.location == location && a.interpolation != Interpolation::flat;
         });
}

bool is_depth_clipped(const Case& c) {
  const bool from_minus_one = c.rules == Rules::opengl;
  return !c.depth_clamp && has_vertex(c, [from_minus_one](const ClipVertex& p) {
    return p.z > p.w || p.z < (from_minus_one ? -p.w : 0);
  });
}

bool has_viewport_fractions(const Case& c) {
  const Viewport& v = c.viewport;
  const std::array numbers{v.x, v.y, v.width, v.height};
  return std::any_of(numbers.begin(), numbers.end(),
                     [](float number) { return number != std::floor(number); });
}

bool is_whole_viewport(const Case& c) {
  const Viewport& v = c.viewport;
  return v.x == 0 && v.y == 0 && v.width == static_cast<float>(c.framebuffer.width) &&
         v.height == static_cast<float>(c.framebuffer.height);
}

template <typename T>
bool has_one(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

}  // namespace

std::string_view words_for(Rules rules) {
  constexpr std::array<std::string_view, 3> kWords{"OpenGL's rules", "Vulkan's rules",
                                                   "D3D's rules"};
  return kWords[static_cast<std::size_t>(rules)];
}

std::string_view to_string(Feature feature) {
  constexpr std::array<std::string_view, kFeatures> kTexts{
      "vertices with w <= 0",
      "clipping by depth",
      "vertices beyond the viewport's sides",
      "clip distances",
      "depth clamp",
      "depth ranges other than 0 to 1",
      "the depth test",
      "depth buffers cleared to values other than 1",
      "depth bias",
      "depths stored in a unorm format",
      "viewports other than the whole framebuffer",
      "fractional viewports",
      "scissors",
      "culling",
      "smooth attributes",
      "noperspective attributes",
      "flat attributes",
      "attributes at centres of several samples",
      "attributes at centroids of several samples"};
  return kTexts[static_cast<std::size_t>(feature)];
}

bool needs(const Case& c, Feature feature) {
  switch (feature) {
    case Feature::nonpositive_w:
      return has_vertex(c, [](const ClipVertex& p) { return p.w <= 0; });
    case Feature::depth_clipping:
      return is_depth_clipped(c);
    case Feature::side_clipping:
      return has_vertex(
          c, [](const ClipVertex& p) { return std::max(std::fabs(p.x), std::fabs(p.y)) > p.w; });
    case Feature::clip_distances:
      return c.clip_distance_count > 0;
    case Feature::depth_clamp:
      return c.depth_clamp;
    case Feature::depth_range:
      return c.viewport.min_depth != 0 || c.viewport.max_depth != 1;
    case Feature::depth_test:
      return c.depth_test != DepthTest::none;
    case Feature::depth_clear:
      return c.depth_test != DepthTest::none && c.depth_clear && *c.depth_clear != 1;
    case Feature::depth_bias:
      return !c.depth_bias.is_none();
    case Feature::unorm_depth:
      return unorm_bits(c.depth_format) != 0;
    case Feature::viewport:
      return !is_whole_viewport(c);
    case Feature::viewport_fractions:
      return has_viewport_fractions(c);
    case Feature::scissor:
      return c.scissor.has_value();
    case Feature::culling:
      return c.cull != Cull::none;
    case Feature::smooth:
      return has_attribute(c, Interpolation::smooth);
    case Feature::noperspective:
      return has_attribute(c, Interpolation::noperspective);
    case Feature::flat:
      return has_attribute(c, Interpolation::flat);
    case Feature::center:
      return has_location(c, Location::center);
    case Feature::centroid:
      return has_location(c, Location::centroid);
  }
  return false;
}

bool Capabilities::draws(Primitive primitive) const { return has_one(primitives, primitive); }

bool Capabilities::is_everything() const {
  Capabilities of_triangles = *this;
  of_triangles.primitives = {Primitive::triangles};
  return of_triangles == Capabilities();
}

bool Capabilities::has(Feature feature) const { return !has_one(lacks, feature); }

std::string lacked_by(const Capabilities& capabilities, const Case& c) {
  if (!has_one(capabilities.rules, c.rules)) return std::string(words_for(c.rules));
  if (!capabilities.draws(c.primitive)) return std::string(name_of(c.primitive));
  for (const Feature feature : capabilities.lacks) {
    if (needs(c, feature)) return std::string(to_string(feature));
  }
  if (!has_one(capabilities.sample_counts, c.framebuffer.samples)) {
    return fmt::format("{} samples", c.framebuffer.samples);
  }
  const int size = std::max(c.framebuffer.width, c.framebuffer.height);
  if (size > capabilities.max_size) return fmt::format("framebuffers of {} pixels", size);
  const int multiple = capabilities.size_multiple;
  if (c.framebuffer.width % multiple != 0 || c.framebuffer.height % multiple != 0) {
    return fmt::format("framebuffers of {}x{} pixels", c.framebuffer.width, c.framebuffer.height);
  }
  const float viewport = std::max(std::fabs(c.viewport.width), std::fabs(c.viewport.height));
  if (viewport > static_cast<float>(capabilities.max_viewport)) {
    return fmt::format("viewports of {} pixels", viewport);
  }
  if (c.attributes.size() > capabilities.max_attributes) {
    return fmt::format("{} attributes", c.attributes.size());
  }
  if (c.clip_distance_count > capabilities.max_clip_distances) {
    return fmt::format("{} clip distances", c.clip_distance_count);
  }
  return "";
}

bool has_meaning(const Capabilities& capabilities) {
  const std::vector kAllPrimitives{Primitive::triangles, Primitive::lines, Primitive::points};
  const Capabilities everything;
  const auto is_ordered = [](const auto& some) {
    return std::adjacent_find(some.begin(), some.end(), std::greater_equal()) == some.end();
  };
  const auto are_some = [&is_ordered](const auto& some, const auto& all) {
    return !some.empty() && is_ordered(some) &&
           std::all_of(some.begin(), some.end(),
                       [&](const auto& one) { return has_one(all, one); });
  };
  const auto is_size = [](int size) { return size >= 1 && size <= kMaxSize; };
  return are_some(capabilities.rules, everything.rules) &&
         are_some(capabilities.sample_counts, everything.sample_counts) &&
         are_some(capabilities.primitives, kAllPrimitives) && is_ordered(capabilities.lacks) &&
         is_size(capabilities.max_size) && is_size(capabilities.size_multiple) &&
         capabilities.size_multiple <= capabilities.max_size &&
         is_size(capabilities.max_viewport) && capabilities.max_attributes <= kMaxAttributes &&
         capabilities.max_clip_distances <= kMaxClipDistances && capabilities.numbers.least >= 0 &&
         capabilities.numbers.has(1);
}

}  // namespace rastercheck::cases
