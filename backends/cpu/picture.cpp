#include "backends/cpu/picture.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "backends/cpu/case_state.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"
#include "rasterizer/texture.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

ras::DepthTest depth_test(cases::DepthFunction function) {
  switch (function) {
    case cases::DepthFunction::always:
      return ras::DepthTest::always;
    case cases::DepthFunction::never:
      return ras::DepthTest::never;
    case cases::DepthFunction::less:
      return ras::DepthTest::less;
    case cases::DepthFunction::equal:
      return ras::DepthTest::equal;
    case cases::DepthFunction::less_or_equal:
      return ras::DepthTest::less_or_equal;
    case cases::DepthFunction::greater:
      return ras::DepthTest::greater;
    case cases::DepthFunction::not_equal:
      return ras::DepthTest::not_equal;
    case cases::DepthFunction::greater_or_equal:
      break;
  }
  return ras::DepthTest::greater_or_equal;
}

ras::Blend blend(cases::Blend blend) {
  switch (blend) {
    case cases::Blend::off:
      return ras::Blend::off;
    case cases::Blend::over:
      return ras::Blend::over;
    case cases::Blend::additive:
      break;
  }
  return ras::Blend::additive;
}

ras::Wrap wrap(cases::Wrap wrap) {
  switch (wrap) {
    case cases::Wrap::repeat:
      return ras::Wrap::repeat;
    case cases::Wrap::clamp:
      return ras::Wrap::clamp;
    case cases::Wrap::mirror:
      break;
  }
  return ras::Wrap::mirror;
}

ras::Filter filter(cases::Filter filter) {
  switch (filter) {
    case cases::Filter::nearest:
      return ras::Filter::nearest;
    case cases::Filter::bilinear:
      return ras::Filter::bilinear;
    case cases::Filter::trilinear:
      break;
  }
  return ras::Filter::trilinear;
}

/// Differences of attributes from a quad's even column to its odd one, or from row to row, each
/// rounded to float32 once.
struct QuadDifferences {
  std::size_t count = 0;
  std::size_t neighbor = 1;  ///< the bit of a lane's number that tells the two apart
  bool may_discard = false;  ///< as far as the rasterizer knows

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

ras::DrawResult draw_untextured(const cases::Case& c, const cases::Pipeline& pipeline,
                                const ras::State& state, const ras::Mesh& mesh, unsigned threads,
                                ras::Framebuffer& framebuffer) {
  const ras::TargetSize size = target_size(c);
  const float depth = pipeline.clear_depth;
  const auto draw_by = [&](const auto& shader) {
    return clear_and_draw(state, mesh, shader, size, depth, framebuffer, threads);
  };
  switch (pipeline.shading) {
    case cases::Shading::vertex_colors:
      return draw_by(ras::GouraudShader());
    case cases::Shading::differences_along_x:
      return draw_by(QuadDifferences{c.attributes.size(), 1, false});
    case cases::Shading::differences_along_y:
      // What never discards is shaded in another way, so that one axis each shows the quads of
      // both.
      return draw_by(QuadDifferences{c.attributes.size(), ras::FragmentBatch::kCellWidth, true});
    case cases::Shading::attributes:
      break;
  }
  return clear_and_draw(state, mesh, size, depth, framebuffer, threads);
}

std::optional<ras::Error> draw_into(const cases::Case& c, const cases::Pipeline& pipeline,
                                    unsigned threads, ras::Framebuffer& framebuffer) {
  ras::State state = state_of(c, ras::Precision::float64);
  state.depth_test = depth_test(pipeline.depth_function);
  state.depth_write = pipeline.writes_depth;
  state.blend = blend(pipeline.blend);
  framebuffer.format = pipeline.format == cases::ColorFormat::rgba8 ? ras::ColorFormat::rgba8
                                                                    : ras::ColorFormat::float32;
  const CaseMesh memory(c);
  const ras::Mesh mesh = memory.mesh();
  if (!pipeline.texturing) {
    if (pipeline.shading == cases::Shading::vertex_colors && c.attributes.size() < 3) {
      return ras::Error::attribute_count;
    }
    return draw_untextured(c, pipeline, state, mesh, threads, framebuffer).error;
  }
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
  return clear_and_draw(state, mesh, shader, target_size(c), pipeline.clear_depth, framebuffer,
                        threads)
      .error;
}

}  // namespace

Result<cases::Picture> draw_picture(const cases::Case& c, const cases::Pipeline& pipeline,
                                    unsigned threads) {
  ras::Framebuffer framebuffer;
  if (const auto error = draw_into(c, pipeline, threads, framebuffer)) {
    return tl::unexpected(refused(*error));
  }
  if (pipeline.resolves) {
    ras::Framebuffer resolved;
    if (const auto error = resolve(framebuffer, resolved)) return tl::unexpected(refused(*error));
    framebuffer = std::move(resolved);
  }
  const ras::TargetSize& size = framebuffer.size;
  cases::Picture picture;
  picture.size = {size.width, size.height, size.samples};
  picture.channels = framebuffer.attribute_count;
  picture.depth.assign(framebuffer.depth.begin(), framebuffer.depth.end());
  picture.color.assign(framebuffer.attributes.begin(), framebuffer.attributes.end());
  for (const std::uint8_t byte : framebuffer.bytes) {
    picture.color.push_back(static_cast<float>(byte) / 255);
  }
  return picture;
}

}  // namespace rastercheck::backends
