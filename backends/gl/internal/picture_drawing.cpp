#include "backends/gl/internal/picture_drawing.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "backends/gl/internal/case_state.h"
#include "backends/gl/internal/picture_texture.h"
#include "backends/gl/internal/varyings.h"

namespace rastercheck::backends::gl {
namespace {

/// The number of attributes that the shaders use: the first of them.
std::size_t attributes_used(const cases::Case& c, const cases::Pipeline& pipeline) {
  const std::size_t count = c.attributes.size();
  if (pipeline.texturing) return 2;
  if (pipeline.discard_below) return count;  // it depends on the last
  if (pipeline.shading == cases::Shading::vertex_colors) return std::min<std::size_t>(count, 4);
  return cases::has_four_channels(pipeline.shading) ? 0 : count;
}

GLenum function_of(cases::DepthFunction function) {
  switch (function) {
    case cases::DepthFunction::never:
      return GL_NEVER;
    case cases::DepthFunction::less:
      return GL_LESS;
    case cases::DepthFunction::equal:
      return GL_EQUAL;
    case cases::DepthFunction::less_or_equal:
      return GL_LEQUAL;
    case cases::DepthFunction::greater:
      return GL_GREATER;
    case cases::DepthFunction::not_equal:
      return GL_NOTEQUAL;
    case cases::DepthFunction::greater_or_equal:
      return GL_GEQUAL;
    case cases::DepthFunction::always:
      break;
  }
  return GL_ALWAYS;
}

/// Sets the pipeline's part of the state, after set_case_state().
void set_pipeline_state(const cases::Pipeline& pipeline) {
  // Depths are written only while the test is on.
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(function_of(pipeline.depth_function));
  glDepthMask(pipeline.writes_depth ? GL_TRUE : GL_FALSE);
  if (pipeline.blend == cases::Blend::off) return;
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  if (pipeline.blend == cases::Blend::additive) {
    glBlendFunc(GL_ONE, GL_ONE);
  } else {
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }
}

void clear(const Layers& layers, float depth) {
  glBindFramebuffer(GL_FRAMEBUFFER, layers.framebuffer(0));
  glDisable(GL_SCISSOR_TEST);
  constexpr std::array<GLfloat, 4> kNothing{};
  for (std::size_t i = 0; i < layers.buffers().size(); ++i) {
    glClearBufferfv(GL_COLOR, static_cast<GLint>(i), kNothing.data());
  }
  glClearBufferfv(GL_DEPTH, 0, &depth);
}

/// Resolves the colours of `from` into `to`, which has a single sample.
Result<void> resolve(const Layers& from, const Layers& to) {
  const cases::FramebufferSize& size = from.shape().size;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer(0));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer(0));
  std::vector<GLenum> only(to.buffers().size(), GL_NONE);
  for (std::size_t i = 0; i < only.size(); ++i) {
    only[i] = to.buffers()[i];
    glDrawBuffers(static_cast<GLsizei>(only.size()), only.data());
    glReadBuffer(from.buffers()[i]);
    glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    only[i] = GL_NONE;
  }
  glDrawBuffers(static_cast<GLsizei>(only.size()), to.buffers().data());
  return check("resolving samples");
}

/// A color as the picture holds it. A byte k was read as a float that is near k/255, by far less
/// than half a step.
float color_of(float read, cases::ColorFormat format) {
  return format == cases::ColorFormat::rgba8 ? std::round(read * 255) / 255 : read;
}

}  // namespace

std::size_t channels_of(const cases::Case& c, const cases::Pipeline& pipeline) {
  const bool has_four = pipeline.texturing || cases::has_four_channels(pipeline.shading);
  return has_four ? 4 : c.attributes.size();
}

std::string fault_of(const cases::Case& c, const cases::Pipeline& pipeline) {
  const std::size_t attributes = c.attributes.size();
  if (pipeline.texturing) {
    const cases::Texture& texture = pipeline.texturing->texture;
    if (attributes < 2) {
      return fmt::format("a texture needs two attributes; the case has {}", attributes);
    }
    const bool is_whole = texture.width > 0 && texture.height > 0 &&
                          texture.texels.size() == 4 * static_cast<std::size_t>(texture.width) *
                                                       static_cast<std::size_t>(texture.height);
    if (!is_whole) {
      return fmt::format("a texture of {} x {} texels cannot have {} bytes", texture.width,
                         texture.height, texture.texels.size());
    }
  } else if (pipeline.shading == cases::Shading::vertex_colors && attributes < 3) {
    return fmt::format("vertex colours need three attributes; the case has {}", attributes);
  } else if (pipeline.discard_below && attributes == 0) {
    return "discarding needs a texture or an attribute; the case has neither";
  }
  const std::size_t channels = channels_of(c, pipeline);
  if (channels == 4) return "";
  if (pipeline.format == cases::ColorFormat::rgba8) {
    return fmt::format("rgba8 needs four channels; the picture has {}", channels);
  }
  if (pipeline.blend == cases::Blend::over) {
    return fmt::format("blending `over` needs four channels; the picture has {}", channels);
  }
  return "";
}

PictureDrawing::PictureDrawing(const Capabilities& has, LayerStore& store)
    : has_(&has),
      store_(&store),
      programs_(has),
      vertex_array_(generate_vertex_array()),
      vertices_(generate_buffer()) {}

Result<PictureDrawing::Target> PictureDrawing::target_of(const cases::Case& c,
                                                         const cases::Pipeline& pipeline) {
  const std::size_t channels = channels_of(c, pipeline);
  if (std::string what = lacks(*has_, c, pipeline, channels); !what.empty()) {
    return unsupported(std::move(what));
  }
  Target target;
  target.shape = {c.framebuffer, 1, (channels + 3) / 4, c.depth_format, false, pipeline.format};
  if (const std::size_t bytes = target.shape.bytes_of_layer(); bytes > kMostBytesOfLayer) {
    return unsupported(fmt::format("the picture needs {} MiB; the limit is {} MiB", bytes >> 20U,
                                   kMostBytesOfLayer >> 20U));
  }
  Result<std::vector<std::size_t>> order = store_->sample_order(target.shape);
  if (!order) return tl::unexpected(order.error());
  target.order = *std::move(order);
  const Result<DepthReading> depth = store_->depth_reading(c);
  if (!depth) return tl::unexpected(depth.error());
  target.depth = *depth;
  if (target.depth.is_open(1)) {
    return unsupported(fmt::format("its shaders fetch the two greatest depths of {} bits as 1",
                                   target.depth.bits));
  }
  return target;
}

Result<void> PictureDrawing::draw_into(const Layers& layers, const cases::Case& c,
                                       const cases::Pipeline& pipeline) {
  PictureShading shading;
  shading.pass = pack_together(std::span(c.attributes).first(attributes_used(c, pipeline)),
                               c.framebuffer.samples);
  if (const std::size_t inputs = inputs_of(*has_, shading.pass); inputs > kMostInputs) {
    return unsupported(fmt::format("a picture has at most {} vertex inputs; the case needs {}",
                                   kMostInputs, inputs));
  }
  shading.shading = pipeline.texturing ? cases::Shading::attributes : pipeline.shading;
  shading.is_textured = pipeline.texturing.has_value();
  shading.has_levels = pipeline.texturing && pipeline.texturing->filter == cases::Filter::trilinear;
  shading.discards = pipeline.discard_below.has_value();
  shading.discarding_attribute = c.attributes.empty() ? 0 : c.attributes.size() - 1;
  shading.is_multisampled = c.framebuffer.samples > 1;
  shading.is_of_points = c.primitive == cases::Primitive::points;
  shading.channels = channels_of(c, pipeline);
  const Result<PictureProgram> program = programs_.get(shading);
  if (!program) return tl::unexpected(program.error());

  hand_over_vertices(*has_, shading.pass, vertices_of(*has_, c, c.triangles, shading.pass),
                     vertex_array_.name(), vertices_.name());
  use_program(program->name, c);
  glActiveTexture(GL_TEXTURE0);
  Object texture;
  if (pipeline.texturing) {
    texture = make_picture_texture(*pipeline.texturing);
    glUniform1i(program->image, 0);
  }
  if (shading.discards) glUniform1f(program->least_alpha, *pipeline.discard_below);
  set_case_state(*has_, c);
  clear(layers, pipeline.clear_depth);
  set_pipeline_state(pipeline);
  set_scissor(c);
  draw_primitives(c, 0, c.triangles.size());
  reset_case_state(*has_);
  if (pipeline.texturing) glBindTexture(GL_TEXTURE_2D, 0);
  return check("drawing a picture");
}

/// Appends the colours of all samples of a layer, pixel by pixel.
Result<void> PictureDrawing::take_colors(Layers& layers, const Target& target,
                                         cases::Picture& picture) {
  const std::vector<bool> all(layers.shape().varyings, true);
  if (auto read = layers.read(0, all, content_); !read) return read;
  const bool is_single = layers.shape().size.samples == 1;
  const std::size_t samples = is_single ? 1 : target.order.size();
  picture.color.reserve(layers.shape().samples() * picture.channels);
  for (std::size_t i = 0; i < layers.shape().samples(); ++i) {
    const std::size_t at = is_single ? i : i - i % samples + target.order[i % samples];
    for (std::size_t k = 0; k < picture.channels; ++k) {
      picture.color.push_back(color_of(content_.values[k / 4][at][k % 4], layers.shape().format));
    }
  }
  return {};
}

/// Appends the depths of as many samples per pixel as the picture has; `layers` may have more.
Result<void> PictureDrawing::take_depths(Layers& layers, const Target& target,
                                         cases::Picture& picture) {
  const std::vector<bool> none(layers.shape().varyings);
  if (auto read = layers.read(0, none, content_); !read) return read;
  const std::size_t samples = target.order.size();
  const auto taken = static_cast<std::size_t>(picture.size.samples);
  for (std::size_t first = 0; first < content_.depth.size(); first += samples) {
    for (std::size_t s = 0; s < taken; ++s) {
      const Result<float> depth =
          target.depth.stored(content_.depth[first + target.order[s]], false);
      if (!depth) return tl::unexpected(depth.error());
      picture.depth.push_back(*depth);
    }
  }
  return {};
}

Result<cases::Picture> PictureDrawing::draw(const cases::Case& c, const cases::Pipeline& pipeline) {
  if (std::string fault = fault_of(c, pipeline); !fault.empty()) return failure(std::move(fault));
  const Result<Target> target = target_of(c, pipeline);
  if (!target) return tl::unexpected(target.error());
  const Result<Layers*> layers = store_->get(target->shape);
  if (!layers) return tl::unexpected(layers.error());
  if (auto drawn = draw_into(**layers, c, pipeline); !drawn) return tl::unexpected(drawn.error());

  cases::Picture picture{c.framebuffer, channels_of(c, pipeline), {}, {}};
  Layers* shown = *layers;
  if (pipeline.resolves && c.framebuffer.samples > 1) {
    picture.size.samples = 1;
    LayerShape single = target->shape;
    single.size.samples = 1;
    const Result<Layers*> resolved = store_->get(single);
    if (!resolved) return tl::unexpected(resolved.error());
    shown = *resolved;
    if (auto done = resolve(**layers, *shown); !done) return tl::unexpected(done.error());
  }
  auto taken = take_colors(*shown, *target, picture);
  if (taken) taken = take_depths(**layers, *target, picture);
  if (!taken) return tl::unexpected(taken.error());
  return picture;
}

}  // namespace rastercheck::backends::gl
