#include "backends/gl/internal/capabilities.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/names.h"
#include "cases/sample_pattern.h"

namespace rastercheck::backends::gl {
namespace {

GLint integer(GLenum what) {
  GLint value = 0;
  glGetIntegerv(what, &value);
  return value;
}

SizeRange size_range(GLenum range, GLenum granularity) {
  std::array<GLfloat, 2> ends = {1, 1};
  GLfloat step = 0;
  glGetFloatv(range, ends.data());
  if (granularity != GL_NONE) glGetFloatv(granularity, &step);
  return {ends[0], ends[1], step};
}

/// Forward-compatible contexts have ranges of widths and yet refuse all widths above 1.
bool has_wide_lines() {
  glGetError();  // one that a query left
  glLineWidth(2);
  const bool has_them = glGetError() == GL_NO_ERROR;
  glLineWidth(1);
  return has_them;
}

void read_sizes(Capabilities& has) {
  has.line_widths = size_range(GL_ALIASED_LINE_WIDTH_RANGE, GL_NONE);
  if (!has.is_es) {
    has.multisampled_line_widths =
        size_range(GL_SMOOTH_LINE_WIDTH_RANGE, GL_SMOOTH_LINE_WIDTH_GRANULARITY);
    has.point_sizes = size_range(GL_POINT_SIZE_RANGE, GL_POINT_SIZE_GRANULARITY);
  } else {
    if (has.version >= 32) {
      has.multisampled_line_widths =
          size_range(GL_MULTISAMPLE_LINE_WIDTH_RANGE, GL_MULTISAMPLE_LINE_WIDTH_GRANULARITY);
    }
    has.point_sizes = size_range(GL_ALIASED_POINT_SIZE_RANGE, GL_NONE);
  }
  if (!has_wide_lines()) has.line_widths = has.multisampled_line_widths = SizeRange();
}

/// The sample counts that cases may have and that both colour and depth targets support.
std::vector<int> read_sample_counts(int most, bool says_which) {
  std::vector<int> counts{1, 2, 4, 8, 16};
  std::erase_if(counts, [most](int count) { return count > most; });
  for (const GLenum format : {GLenum{GL_RGBA32F}, GLenum{GL_DEPTH_COMPONENT32F}}) {
    if (!says_which) break;
    std::array<GLint, 16> all{};
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, format, GL_SAMPLES,
                          static_cast<GLsizei>(all.size()), all.data());
    std::erase_if(counts, [&all](int count) {
      return count > 1 && std::find(all.begin(), all.end(), count) == all.end();
    });
  }
  return counts;
}

std::string lacks_of_viewport(const Capabilities& has, const cases::Viewport& v) {
  if (v.width < 0 || v.height < 0) return has.api + " does not support viewports of negative size";
  for (const float number : {v.x, v.y, v.width, v.height}) {
    if (!has.has_viewport_fractions && number != std::floor(number)) {
      return fmt::format(
          "{} does not support fractional viewports such as {} (no GL_ARB_viewport_array)", has.api,
          number);
    }
  }
  for (const float number : {v.x, v.y}) {
    if (number < has.viewport_bounds[0] || number > has.viewport_bounds[1]) {
      return fmt::format("the viewport begins at {}, outside the range {} to {}", number,
                         has.viewport_bounds[0], has.viewport_bounds[1]);
    }
  }
  if (v.width > static_cast<float>(has.max_viewport[0]) ||
      v.height > static_cast<float>(has.max_viewport[1])) {
    return fmt::format("the viewport of {} x {} pixels exceeds the limit of {} x {}", v.width,
                       v.height, has.max_viewport[0], has.max_viewport[1]);
  }
  return "";
}

std::string lacks_of_rules(const Capabilities& has, const cases::Case& c) {
  if (c.rules == cases::Rules::d3d) return "OpenGL does not support the rules of d3d";
  if (c.rules != cases::Rules::vulkan) return "";
  if (!has.has_clip_control) {
    return has.api + " has no clip control (GL_ARB_clip_control), which the rules of vulkan need";
  }
  const bool has_choice = c.primitive != cases::Primitive::points;
  const bool has_flat = std::any_of(c.attributes.begin(), c.attributes.end(), [](const auto& a) {
    return a.interpolation == cases::Interpolation::flat;
  });
  if (has_choice && has_flat && !has.has_provoking_vertex) {
    return has.api +
           " takes flat values from the last vertex, but the rules of vulkan from the first";
  }
  return "";
}

/// With several samples, lines are rectangles. With one they are Bresenham's, of a width that is
/// rounded to an integer and is at least 1.
std::string lacks_of_lines(const Capabilities& has, const cases::Case& c) {
  const bool is_single = c.framebuffer.samples == 1;
  const cases::LineMode drawn =
      is_single ? cases::LineMode::bresenham : cases::LineMode::rectangular;
  if (c.line_mode != drawn) {
    return fmt::format("OpenGL's lines are {} with {}; the case asks for {}", cases::name_of(drawn),
                       is_single ? "one sample" : "several samples", cases::name_of(c.line_mode));
  }
  const SizeRange& widths = is_single ? has.line_widths : has.multisampled_line_widths;
  if (widths.has(is_single ? std::max(std::round(c.line_width), 1.0F) : c.line_width)) return "";
  return fmt::format("{} draws lines of width {}; the case needs {}", has.api, widths.in_words(),
                     c.line_width);
}

std::string lacks_of_primitives(const Capabilities& has, const cases::Case& c) {
  if (c.primitive == cases::Primitive::lines) return lacks_of_lines(has, c);
  if (c.primitive != cases::Primitive::points || has.point_sizes.has(c.point_size)) return "";
  return fmt::format("{} draws points of size {}; the case needs {}", has.api,
                     has.point_sizes.in_words(), c.point_size);
}

std::string lacks_of_attributes(const Capabilities& has, const cases::Case& c) {
  for (const cases::Attribute& a : c.attributes) {
    if (a.interpolation == cases::Interpolation::noperspective && !has.has_noperspective) {
      return has.api + " does not support noperspective";
    }
    const bool has_place =
        a.interpolation != cases::Interpolation::flat && c.framebuffer.samples > 1;
    if (has_place && a.location != cases::Location::centroid && !has.has_sample_qualifier) {
      return has.api + " has neither the qualifier `sample` nor interpolateAtOffset()";
    }
  }
  return "";
}

std::string lacks_of_target(const Capabilities& has, const cases::FramebufferSize& size) {
  if (size.samples > 1 && !has.has_sample_targets) {
    return has.api + " has no arrays of multisampled textures";
  }
  if (size.samples > has.max_samples) {
    return fmt::format("targets have at most {} samples; the case needs {}", has.max_samples,
                       size.samples);
  }
  // Samples are read as neighbouring pixels.
  if (size.width * size.samples > has.max_size || size.height > has.max_size) {
    return fmt::format(
        "a target of {} x {} pixels with {} samples exceeds the limit of {} samples per side",
        size.width, size.height, size.samples, has.max_size);
  }
  return "";
}

std::string lacks_of_shading(const Capabilities& has, const cases::Pipeline& pipeline) {
  if (pipeline.texturing) {
    const cases::Texture& texture = pipeline.texturing->texture;
    if (texture.width <= has.max_size && texture.height <= has.max_size) return "";
    return fmt::format("the texture of {} x {} texels exceeds the limit of {} per side",
                       texture.width, texture.height, has.max_size);
  }
  const bool has_differences = pipeline.shading == cases::Shading::differences_along_x ||
                               pipeline.shading == cases::Shading::differences_along_y;
  if (!has_differences || has.has_fine_derivatives) return "";
  return has.api + " has no dFdxFine() and dFdyFine() (GL_ARB_derivative_control)";
}

std::string lacks_of_depth(const Capabilities& has, const cases::Case& c) {
  if (c.depth_clamp && !has.has_depth_clamp) return has.api + " has no depth clamp";
  const bool has_clamp = !c.depth_bias.is_none() && c.depth_bias.clamp != 0;
  if (has_clamp && !has.has_bias_clamp) {
    return has.api + " has no clamp of the depth bias (GL_ARB_polygon_offset_clamp)";
  }
  if (cases::unorm_bits(c.depth_format) != 0 && !has.has_unorm_depth) {
    return has.api + " does not tell how many bits its depth images have";
  }
  return "";
}

}  // namespace

Capabilities read_capabilities() {
  Capabilities has;
  has.is_es = !epoxy_is_desktop_gl();
  has.version = epoxy_gl_version();
  has.api =
      fmt::format("OpenGL {}{}.{}", has.is_es ? "ES " : "", has.version / 10, has.version % 10);
  const auto desktop = [&](int version, const char* extension) {
    return !has.is_es && (has.version >= version || epoxy_has_gl_extension(extension));
  };
  const auto es = [&](int version, const char* extension) {
    return has.is_es && (has.version >= version || epoxy_has_gl_extension(extension));
  };
  constexpr int kNever = 1000;
  has.has_clip_control = desktop(45, "GL_ARB_clip_control") || es(kNever, "GL_EXT_clip_control");
  has.has_provoking_vertex = !has.is_es;
  has.has_depth_clamp = !has.is_es || es(kNever, "GL_EXT_depth_clamp");
  has.has_bias_clamp = desktop(46, "GL_ARB_polygon_offset_clamp") ||
                       epoxy_has_gl_extension("GL_EXT_polygon_offset_clamp");
  // Versions below OpenGL ES 3.1 have no glGetTexLevelParameteriv().
  has.has_unorm_depth = !has.is_es || has.version >= 31;
  has.has_noperspective = !has.is_es || es(kNever, "GL_NV_shader_noperspective_interpolation");
  has.has_sample_qualifier = desktop(40, "GL_ARB_gpu_shader5") || es(32, "");
  has.has_sample_targets = !has.is_es || has.version >= 32;
  // Shaders declare an older version, in which these functions need the extension.
  has.has_fine_derivatives = desktop(kNever, "GL_ARB_derivative_control");
  has.has_float_blend = !has.is_es || es(kNever, "GL_EXT_float_blend");
  has.has_appending = desktop(43, "GL_ARB_shader_storage_buffer_object") &&
                      desktop(43, "GL_ARB_framebuffer_no_attachments") &&
                      integer(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS) > 0;
  if (has.has_appending) {
    has.max_storage = static_cast<std::size_t>(integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE));
  }
  has.subpixel_bits = integer(GL_SUBPIXEL_BITS);
  has.max_draw_buffers = std::min(integer(GL_MAX_DRAW_BUFFERS), integer(GL_MAX_COLOR_ATTACHMENTS));
  has.max_size = integer(GL_MAX_TEXTURE_SIZE);
  has.max_layers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
  if (!has.is_es || epoxy_has_gl_extension("GL_EXT_clip_cull_distance")) {
    constexpr int kAll = static_cast<int>(cases::kMaxClipDistances);
    has.max_clip_distances = integer(GL_MAX_CLIP_DISTANCES) >= kAll ? kAll : 0;
  }
  if (has.has_sample_targets) {
    has.max_samples =
        std::min(integer(GL_MAX_COLOR_TEXTURE_SAMPLES), integer(GL_MAX_DEPTH_TEXTURE_SAMPLES));
    const bool says_which = desktop(42, "GL_ARB_internalformat_query") || has.is_es;
    has.sample_counts = read_sample_counts(has.max_samples, says_which);
  }
  has.has_viewport_fractions = desktop(41, "GL_ARB_viewport_array");
  if (has.has_viewport_fractions) {
    has.viewport_subpixel_bits = integer(GL_VIEWPORT_SUBPIXEL_BITS);
    glGetFloatv(GL_VIEWPORT_BOUNDS_RANGE, has.viewport_bounds.data());
  } else {
    // These versions report no bounds: assume those that later versions guarantee.
    has.viewport_bounds = {-32768, 32767};
  }
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, has.max_viewport.data());
  read_sizes(has);
  return has;
}

cases::Capabilities drawable(const Capabilities& has) {
  using cases::Feature;
  cases::Capabilities all;
  all.rules = {cases::Rules::opengl};
  if (has.has_clip_control) all.rules.push_back(cases::Rules::vulkan);
  all.primitives = {cases::Primitive::triangles, cases::Primitive::lines, cases::Primitive::points};
  all.sample_counts = has.has_sample_qualifier ? has.sample_counts : std::vector{1};
  const auto add = [&all](bool has_it, Feature feature) {
    if (!has_it) all.lacks.push_back(feature);
  };
  add(has.has_depth_clamp, Feature::depth_clamp);
  add(has.has_unorm_depth, Feature::unorm_depth);
  add(has.has_viewport_fractions, Feature::viewport_fractions);
  add(has.has_noperspective, Feature::noperspective);
  all.max_size = std::min(has.max_size, cases::kMaxSize);
  all.max_viewport = std::min({has.max_viewport[0], has.max_viewport[1], cases::kMaxSize});
  all.max_clip_distances = static_cast<std::size_t>(has.max_clip_distances);
  return all;
}

std::string lacks(const Capabilities& has, const cases::Case& c) {
  for (const std::string& what :
       {lacks_of_rules(has, c), lacks_of_viewport(has, c.viewport), lacks_of_attributes(has, c),
        lacks_of_target(has, c.framebuffer), lacks_of_depth(has, c), lacks_of_primitives(has, c)}) {
    if (!what.empty()) return what;
  }
  if (c.clip_distance_count > static_cast<std::size_t>(has.max_clip_distances)) {
    return fmt::format("{} has {} clip distances; the case needs {}", has.api,
                       has.max_clip_distances, c.clip_distance_count);
  }
  return "";
}

std::string lacks(const Capabilities& has, const cases::Case& c, const cases::Pipeline& pipeline,
                  std::size_t channels) {
  if (const std::string what = lacks(has, c); !what.empty()) return what;
  if (const std::string what = lacks_of_shading(has, pipeline); !what.empty()) return what;
  const bool is_float = pipeline.format == cases::ColorFormat::float32;
  if (is_float && pipeline.blend != cases::Blend::off && !has.has_float_blend) {
    return has.api + " does not blend into float32 targets (no GL_EXT_float_blend)";
  }
  const bool is_within = pipeline.clear_depth >= 0 && pipeline.clear_depth <= 1;
  if (!is_within && !has.clears_beyond_one) {
    return fmt::format("its depth cannot be cleared to {}", pipeline.clear_depth);
  }
  // A copy, through which OpenGL ES and several samples are read, has one target more.
  const bool has_copy = has.is_es || c.framebuffer.samples > 1;
  const std::size_t most = 4 * static_cast<std::size_t>(has.max_draw_buffers - (has_copy ? 1 : 0));
  if (channels <= most) return "";
  return fmt::format("a picture has at most {} channels here; the case needs {}", most, channels);
}

}  // namespace rastercheck::backends::gl
