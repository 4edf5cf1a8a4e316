#include "backends/cpu/picture.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
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

/// A case's triangles with memory of their own.
struct CaseMesh {
  explicit CaseMesh(const cases::Case& c) {
    positions.reserve(c.positions.size());
    for (const cases::ClipVertex& p : c.positions) positions.emplace_back(p.x, p.y, p.z, p.w);
    triangles.reserve(c.triangles.size());
    for (const cases::Triangle& t : c.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  }
  std::vector<glm::vec4> positions;
  std::vector<glm::uvec3> triangles;
};

std::optional<ras::Error> draw_into(const cases::Case& c, const cases::Pipeline& pipeline,
                                    unsigned threads, ras::Framebuffer& framebuffer) {
  ras::State state = state_of(c, ras::Precision::float64);
  state.depth_test = depth_test(pipeline.depth_function);
  state.depth_write = pipeline.writes_depth;
  state.blend = blend(pipeline.blend);
  framebuffer.format = pipeline.format == cases::ColorFormat::rgba8 ? ras::ColorFormat::rgba8
                                                                    : ras::ColorFormat::float32;
  const CaseMesh memory(c);
  const ras::Mesh mesh{memory.positions, c.attribute_values, c.clip_distances, memory.triangles};
  if (!pipeline.texturing) {
    return clear_and_draw(state, mesh, target_size(c), pipeline.clear_depth, framebuffer, threads)
        .error;
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
