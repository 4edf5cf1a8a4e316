#include "backends/vulkan/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/names.h"

namespace rastercheck::backends::vulkan {
namespace {

std::string lacks_size(const Limits& limits, const cases::Case& c) {
  const cases::FramebufferSize& size = c.framebuffer;
  if (size.width > limits.max_width || size.height > limits.max_height) {
    return fmt::format("framebuffers of {} x {} pixels: {} x {} at most", size.width, size.height,
                       limits.max_width, limits.max_height);
  }
  if ((limits.sample_counts & static_cast<unsigned>(size.samples)) == 0) {
    return fmt::format("{} samples per pixel", size.samples);
  }
  if (size.samples > 1 && !limits.standard_sample_locations) {
    return "the standard sample locations (standardSampleLocations)";
  }
  return "";
}

std::string lacks_viewport(const Limits& limits, const cases::Viewport& viewport) {
  // Vulkan accepts negative heights (VK_KHR_maintenance1) but no negative widths.
  if (!(viewport.width > 0)) return "viewports without a positive width";
  if (viewport.width > limits.max_viewport[0] ||
      std::fabs(viewport.height) > limits.max_viewport[1]) {
    return fmt::format("viewports beyond {} x {} pixels (maxViewportDimensions)",
                       limits.max_viewport[0], limits.max_viewport[1]);
  }
  const auto [least, greatest] = limits.viewport_bounds;
  for (const float border :
       {viewport.x, viewport.x + viewport.width, viewport.y, viewport.y + viewport.height}) {
    if (border >= least && border <= greatest) continue;
    return fmt::format("viewports beyond {} to {} (viewportBoundsRange)", least, greatest);
  }
  return "";
}

std::string lacks_state(const Limits& limits, const cases::Case& c) {
  if (c.clip_distance_count > static_cast<std::size_t>(limits.clip_distances)) {
    return fmt::format("{} clip distances", c.clip_distance_count);
  }
  return "";
}

std::string lacks_depth(const Limits& limits, const cases::Case& c) {
  if (c.depth_clamp && !limits.depth_clamp) return "depth clamp (depthClamp)";
  const bool has_clamp = !c.depth_bias.is_none() && c.depth_bias.clamp != 0;
  if (has_clamp && !limits.depth_bias_clamp) return "a clamp of the depth bias (depthBiasClamp)";
  const int bits = cases::unorm_bits(c.depth_format);
  if (bits == 0) return "";
  const unsigned counts = bits == 16 ? limits.unorm16_samples : limits.unorm24_samples;
  if ((counts & static_cast<unsigned>(c.framebuffer.samples)) != 0) return "";
  const std::string format(cases::name_of(c.depth_format));
  return counts == 0 ? fmt::format("the depth format {}", format)
                     : fmt::format("{} samples per pixel of {}", c.framebuffer.samples, format);
}

std::string lacks_rules(const Limits& limits, const cases::Case& c) {
  if (c.rules == cases::Rules::d3d) return "the rules of D3D";
  if (c.rules == cases::Rules::vulkan) return "";
  if (!limits.depth_clip_control) {
    return "OpenGL's clip depth (VK_EXT_depth_clip_control)";
  }
  const bool has_choice = c.primitive != cases::Primitive::points;
  const bool has_flat = std::any_of(
      c.attributes.begin(), c.attributes.end(),
      [](const cases::Attribute& a) { return a.interpolation == cases::Interpolation::flat; });
  if (has_choice && has_flat && !limits.provoking_vertex_last) {
    return "OpenGL's provoking vertex (VK_EXT_provoking_vertex)";
  }
  return "";
}

std::string lacks_line_mode(const Limits& limits, cases::LineMode mode) {
  switch (mode) {
    case cases::LineMode::rectangular:
      if (limits.strict_lines || limits.rectangular_lines) return "";
      return "rectangular lines (rectangularLines, strictLines)";
    case cases::LineMode::parallelogram:
      if (!limits.strict_lines) return "";
      return "lines that are parallelograms: its default mode has rectangles (strictLines)";
    case cases::LineMode::bresenham:
      break;
  }
  return limits.bresenham_lines ? "" : "Bresenham's lines (bresenhamLines)";
}

std::string lacks_primitives(const Limits& limits, const cases::Case& c) {
  const auto lacks_size = [](const SizeRange& has, float size, const char* what,
                             const char* feature, const char* range) -> std::string {
    if (has.has(size)) return "";
    if (!(has.greatest > has.least)) return fmt::format("{} {} ({})", what, size, feature);
    return fmt::format("{} {}: {} ({})", what, size, has.in_words(), range);
  };
  if (c.primitive == cases::Primitive::points) {
    return lacks_size(limits.point_sizes, c.point_size, "points of size", "largePoints",
                      "pointSizeRange, pointSizeGranularity");
  }
  if (c.primitive != cases::Primitive::lines) return "";
  std::string mode = lacks_line_mode(limits, c.line_mode);
  if (!mode.empty()) return mode;
  return lacks_size(limits.line_widths, c.line_width, "lines of width", "wideLines",
                    "lineWidthRange, lineWidthGranularity");
}

std::string lacks_attributes(const Limits& limits, const cases::Case& c) {
  // With several samples, the shader must also request the centre (shaders/case.frag).
  const bool has_places =
      std::any_of(c.attributes.begin(), c.attributes.end(), [](const cases::Attribute& a) {
        return a.interpolation != cases::Interpolation::flat &&
               a.location != cases::Location::centroid;
      });
  if (c.framebuffer.samples > 1 && has_places && !limits.sample_rate_shading) {
    return "attributes at samples and centres of several samples (sampleRateShading)";
  }
  return "";
}

}  // namespace

cases::Capabilities drawable(const Limits& limits) {
  using cases::Feature;
  cases::Capabilities all;
  all.rules = {cases::Rules::vulkan};
  if (limits.depth_clip_control) {
    all.rules.insert(all.rules.begin(), cases::Rules::opengl);
  }
  all.primitives = {cases::Primitive::triangles, cases::Primitive::lines, cases::Primitive::points};
  const bool has_samples = limits.standard_sample_locations && limits.sample_rate_shading;
  std::erase_if(all.sample_counts, [&](int count) {
    return count > 1 &&
           (!has_samples || (limits.sample_counts & static_cast<unsigned>(count)) == 0);
  });
  if (!limits.depth_clamp) all.lacks.push_back(Feature::depth_clamp);
  if ((limits.unorm16_samples | limits.unorm24_samples) == 0) {
    all.lacks.push_back(Feature::unorm_depth);
  }
  all.max_size = std::min({limits.max_width, limits.max_height, cases::kMaxSize});
  all.max_viewport = static_cast<int>(std::min(
      {limits.max_viewport[0], limits.max_viewport[1], static_cast<float>(cases::kMaxSize)}));
  all.max_clip_distances = static_cast<std::size_t>(limits.clip_distances);
  return all;
}

std::string lacks(const Limits& limits, const cases::Case& c) {
  for (const std::string& reason :
       {lacks_rules(limits, c), lacks_size(limits, c), lacks_viewport(limits, c.viewport),
        lacks_state(limits, c), lacks_depth(limits, c), lacks_attributes(limits, c),
        lacks_primitives(limits, c)}) {
    if (!reason.empty()) return reason;
  }
  return "";
}

std::string lacks_for_picture(const Limits& limits, const cases::Case& c,
                              const cases::Pipeline& pipeline) {
  const bool is_clear_depth_held = pipeline.clear_depth >= 0 && pipeline.clear_depth <= 1;
  if (!is_clear_depth_held) {
    return fmt::format("the initial depth {}: 0 to 1", pipeline.clear_depth);
  }
  if (pipeline.format == cases::ColorFormat::rgba8) {
    if ((limits.byte_samples & static_cast<unsigned>(c.framebuffer.samples)) == 0) {
      return fmt::format("{} samples per pixel of rgba8", c.framebuffer.samples);
    }
  } else if (pipeline.blend != cases::Blend::off && !limits.float_blending) {
    return "blending of float32 colours (VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT)";
  }
  if (!pipeline.texturing) return "";
  const cases::Texture& texture = pipeline.texturing->texture;
  if (texture.width <= limits.max_texture && texture.height <= limits.max_texture) return "";
  return fmt::format("textures of {} x {} texels: {} at most (maxImageDimension2D)", texture.width,
                     texture.height, limits.max_texture);
}

}  // namespace rastercheck::backends::vulkan
