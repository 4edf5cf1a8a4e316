#include "backends/cpu/picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "backends/cpu/case_state.h"
#include "cases/sample_pattern.h"
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

/// A shader that shows the fragment's facing (cases::Shading::facing).
struct FacingShader {
  std::size_t outputs() const { return 4; }
  bool discards() const { return false; }
  void operator()(const ras::FragmentBatch& in, ras::ShadedBatch& out) const {
    std::fill_n(out.color[3], in.lanes, 1.0F);
    constexpr std::size_t kLanes = ras::FragmentBatch::kCellLanes;
    for (std::size_t first = 0; first < in.lanes; first += kLanes) {
      const float shown = in.exact->is_front(first) ? 1 : 0;
      for (std::size_t k = 0; k < 3; ++k) std::fill_n(out.color[k] + first, kLanes, shown);
    }
  }
};

/// A shader that shows window coordinates (cases::Shading::window_coordinates).
struct CoordinatesShader {
  std::span<const cases::SamplePosition> pattern;

  std::size_t outputs() const { return 4; }
  bool discards() const { return false; }
  void operator()(const ras::FragmentBatch& in, ras::ShadedBatch& out) const {
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      const ras::FragmentBatch::Cell& cell = in.cells[lane / ras::FragmentBatch::kCellLanes];
      const std::size_t at = lane % ras::FragmentBatch::kCellLanes;
      const bool is_covered = (cell.covered >> at & 1) != 0;
      if (!is_covered) continue;
      const cases::SamplePosition& sample = pattern[cell.sample];
      out.color[0][lane] = coordinate(cell.x + at % ras::FragmentBatch::kCellWidth, sample.x);
      out.color[1][lane] = coordinate(cell.y + at / ras::FragmentBatch::kCellWidth, sample.y);
      out.color[2][lane] = in.exact->depth(lane);
      out.color[3][lane] = static_cast<float>(in.exact->reciprocal_w(lane));
    }
  }

 private:
  static float coordinate(std::size_t pixel, int sixteenths) {
    return static_cast<float>(pixel) + static_cast<float>(sixteenths) / 16;
  }
};

/// Shades as another shader does, and discards fragments of which an attribute is less than a
/// limit.
template <typename Shader>
struct Discarding {
  const Shader& shader;
  std::size_t attribute = 0;
  float limit = 0;

  std::size_t outputs() const { return shader.outputs(); }
  bool discards() const { return true; }
  void operator()(const ras::FragmentBatch& in, ras::ShadedBatch& out) const {
    shader(in, out);
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      if (static_cast<float>(in.values[attribute][lane]) < limit) out.discard(lane);
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

  /// Draws by a shader, and discards if the pipeline, which has no texture, does.
  template <typename Shader>
  std::optional<ras::Error> by(const Shader& shader, const cases::Pipeline& pipeline) const {
    if (!pipeline.discard_below) return by(shader);
    const std::size_t attributes = source.attributes.size();
    if (attributes == 0) return ras::Error::attribute_count;
    return by(Discarding<Shader>{shader, attributes - 1, *pipeline.discard_below});
  }

  template <typename... Shader>  // one or none
  std::optional<ras::Error> by(const Shader&... shader) const {
    if (!clear_depth) return draw(state, mesh, shader..., framebuffer, threads).error;
    const ras::TargetSize size = target_size(source);
    return clear_and_draw(state, mesh, shader..., size, *clear_depth, framebuffer, threads).error;
  }
};

std::optional<ras::Error> draw_untextured(const FrameDraw& draw, const cases::Pipeline& pipeline) {
  const std::size_t attributes = draw.source.attributes.size();
  switch (pipeline.shading) {
    case cases::Shading::vertex_colors:
      if (attributes < 3) return ras::Error::attribute_count;
      return draw.by(ras::GouraudShader(), pipeline);
    case cases::Shading::differences_along_x:
      return draw.by(QuadDifferences{attributes, 1, false}, pipeline);
    case cases::Shading::differences_along_y:
      // Shaders that never discard take another code path. Using one shader of each kind for the
      // two axes covers the quads of both paths.
      return draw.by(QuadDifferences{attributes, ras::FragmentBatch::kCellWidth, true}, pipeline);
    case cases::Shading::facing:
      return draw.by(FacingShader(), pipeline);
    case cases::Shading::window_coordinates:
      return draw.by(CoordinatesShader{cases::standard_pattern(draw.source.framebuffer.samples)},
                     pipeline);
    case cases::Shading::attributes:
      break;
  }
  if (!pipeline.discard_below) return draw.by();
  return draw.by(ras::AttributesShader{attributes}, pipeline);
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
  if (!pipeline.texturing) return draw_untextured(draw, pipeline);
  if (c.attributes.size() < 2) return ras::Error::attribute_count;
  const cases::Texturing& texturing = *pipeline.texturing;
  ras::Texture texture;
  const auto error = ras::Texture::make(texturing.texture.width, texturing.texture.height,
                                        texturing.texture.texels, texture);
  if (error) return error;
  ras::TexturedShader shader;
  shader.texture = &texture;
  shader.sampler = {wrap(texturing.wrap_s), wrap(texturing.wrap_t), filter(texturing.filter)};
  shader.discard_below = pipeline.discard_below;
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
