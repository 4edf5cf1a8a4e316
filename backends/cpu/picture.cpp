#include "backends/cpu/picture.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "backends/cpu/case_state.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"
#include "rasterizer/texture.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// A shader that outputs the difference of each attribute between the two columns of a quad (odd
/// minus even), or between its two rows, rounded to float32 once.
struct QuadDifferences {
  std::size_t count = 0;
  std::size_t neighbor = 1;  ///< the bit that differs in the numbers of two neighbouring lanes
  bool may_discard = false;  ///< whether the shader tells the rasterizer that it may discard

  std::size_t outputs() const { return count; }
  bool discards() const { return may_discard; }
  void operator()(const ras::FragmentBatch& in, ras::ShadedBatch& out) const {
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t lane = 0; lane < in.lanes; ++lane) {
        const double* const values = in.values[a];
        out.color[a][lane] = static_cast<float>(values[lane | neighbor] - values[lane & ~neighbor]);
      }
    }
  }
};

/// A draw into a framebuffer, which may be cleared first.
struct FrameDraw {
  const cases::Case& source;
  const ras::State& state;
  const ras::Mesh& mesh;
  std::optional<float> clear_depth;
  ras::Picture& framebuffer;
  unsigned threads;

  template <typename... Shader>  // one or none
  std::optional<ras::Error> by(const Shader&... shader) const {
    if (!clear_depth) return draw(state, mesh, shader..., framebuffer, threads).error;
    const ras::TargetSize size = target_size(source);
    return clear_and_draw(state, mesh, shader..., size, *clear_depth, framebuffer, threads).error;
  }
};

std::optional<ras::Error> draw_untextured(const FrameDraw& draw, cases::Shading shading) {
  const std::size_t attributes = draw.source.attributes.size();
  switch (shading) {
    case cases::Shading::vertex_colors:
      if (attributes < 3) return ras::Error::attribute_count;
      return draw.by(ras::GouraudShader());
    case cases::Shading::differences_along_x:
      return draw.by(QuadDifferences{attributes, 1, false});
    case cases::Shading::differences_along_y:
      // Shaders that never discard take another code path. Using one shader of each kind for the
      // two axes covers the quads of both paths.
      return draw.by(QuadDifferences{attributes, ras::FragmentBatch::kCellWidth, true});
    case cases::Shading::attributes:
      break;
  }
  return draw.by();
}

std::optional<ras::Error> draw_into(const cases::Case& c, const cases::Pipeline& pipeline,
                                    std::optional<float> clear_depth, const PictureOptions& options,
                                    ras::Picture& framebuffer) {
  ras::State state = state_of(c, options.conservative);
  state.depth_test = depth_test(pipeline.depth_function);
  state.depth_write = pipeline.writes_depth;
  state.blend = blend(pipeline.blend);
  const CaseMesh memory(c);
  const ras::Mesh mesh = memory.mesh();
  const FrameDraw draw{c, state, mesh, clear_depth, framebuffer, options.threads};
  if (!pipeline.texturing) return draw_untextured(draw, pipeline.shading);
  if (c.attributes.size() < 2) return ras::Error::attribute_count;
  const cases::Texturing& texturing = *pipeline.texturing;
  ras::Texture texture;
  const auto error = ras::Texture::make(texturing.texture.width, texturing.texture.height,
                                        texturing.texture.texels, texture);
  if (error) return error;
  ras::TexturedShader shader;
  shader.texture = &texture;
  shader.sampler = {wrap(texturing.wrap_s), wrap(texturing.wrap_t), filter(texturing.filter)};
  shader.discard_below = texturing.discard_below;
  return draw.by(shader);
}

/// A framebuffer with the content of the picture.
ras::Picture framebuffer_of(const cases::Picture& picture, cases::ColorFormat color_format) {
  ras::Picture framebuffer;
  framebuffer.size = {picture.size.width, picture.size.height, picture.size.samples};
  framebuffer.attribute_count = picture.channels;
  framebuffer.format = format(color_format);
  framebuffer.depth.assign(picture.depth.begin(), picture.depth.end());
  if (framebuffer.format == ras::ColorFormat::float32) {
    framebuffer.attributes.assign(picture.color.begin(), picture.color.end());
  } else {
    // The float nearest to k/255, times 255, is off by far less than one half.
    for (const float color : picture.color) {
      framebuffer.bytes.push_back(static_cast<std::uint8_t>(std::lround(color * 255)));
    }
  }
  return framebuffer;
}

/// Copies the framebuffer's content into the picture.
void take(const ras::Picture& framebuffer, cases::Picture& picture) {
  picture.depth.assign(framebuffer.depth.begin(), framebuffer.depth.end());
  picture.color.assign(framebuffer.attributes.begin(), framebuffer.attributes.end());
  for (const std::uint8_t byte : framebuffer.bytes) {
    picture.color.push_back(static_cast<float>(byte) / 255);
  }
}

std::size_t sample_count(const cases::FramebufferSize& size) {
  return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
         static_cast<std::size_t>(size.samples);
}

}  // namespace

Result<cases::Picture> draw_picture(const cases::Case& c, const cases::Pipeline& pipeline,
                                    const PictureOptions& options) {
  ras::Picture framebuffer;
  framebuffer.format = format(pipeline.format);
  if (const auto error =
          draw_into(c, pipeline, stored_clear(c, pipeline.clear_depth), options, framebuffer)) {
    return tl::unexpected(refused(*error));
  }
  if (pipeline.resolves) {
    ras::Picture resolved;
    if (const auto error = resolve(framebuffer, resolved)) return tl::unexpected(refused(*error));
    framebuffer = std::move(resolved);
  }
  const ras::TargetSize& size = framebuffer.size;
  cases::Picture picture;
  picture.size = {size.width, size.height, size.samples};
  picture.channels = framebuffer.attribute_count;
  take(framebuffer, picture);
  return picture;
}

Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                       const PictureOptions& options, cases::Picture& picture) {
  // The rasterizer reports bad sizes, except a different size with the same sample count, which is
  // caught here.
  const bool is_other =
      c.framebuffer != picture.size && sample_count(c.framebuffer) == picture.depth.size();
  if (pipeline.resolves || is_other) return tl::unexpected(refused(ras::Error::target_size));
  ras::Picture framebuffer = framebuffer_of(picture, pipeline.format);
  framebuffer.size = target_size(c);
  const auto error = draw_into(c, pipeline, std::nullopt, options, framebuffer);
  // Copies even after an error, so that a law can see whether a refused draw left the picture
  // alone.
  take(framebuffer, picture);
  if (error) return tl::unexpected(refused(*error));
  return {};
}

}  // namespace rastercheck::backends
