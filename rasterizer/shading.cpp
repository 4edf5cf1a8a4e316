#include "rasterizer/shading.h"

#include "rasterizer/internal/checked_draw.h"
#include "rasterizer/internal/checked_frame.h"

namespace rastercheck::rasterizer {
namespace {

std::optional<Error> check_shader(const ShaderView& shader, const State& state,
                                  ColorFormat format) {
  if (shader.outputs > kMaxAttributes) return Error::output_count;
  return check_channels(state, format, shader.outputs);
}

}  // namespace

DrawResult draw_by(const ShaderView& shader, const State& state, const Mesh& mesh,
                   Framebuffer& framebuffer, unsigned threads) {
  std::optional<Error> error = check_state(state);
  if (!error) error = check_framebuffer(framebuffer);
  if (!error && framebuffer.attribute_count != shader.outputs) error = Error::output_count;
  if (!error) error = check_shader(shader, state, framebuffer.format);
  if (!error) error = check_mesh(state, mesh);
  if (error) return {error, {}};
  return draw_checked_frame(state, mesh, framebuffer, {threads, std::nullopt, &shader});
}

DrawResult clear_and_draw_by(const ShaderView& shader, const State& state, const Mesh& mesh,
                             const TargetSize& size, float depth, Framebuffer& framebuffer,
                             unsigned threads) {
  std::optional<Error> error = check_draw(state, mesh, size);
  if (!error) error = check_shader(shader, state, framebuffer.format);
  if (!error) error = resize(framebuffer, size, shader.outputs);
  if (error) return {error, {}};
  return draw_checked_frame(state, mesh, framebuffer, {threads, depth, &shader});
}

}  // namespace rastercheck::rasterizer
