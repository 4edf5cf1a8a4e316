#include "rasterizer/shading.h"

#include "rasterizer/internal/checked_frame.h"

namespace rastercheck::rasterizer {

DrawResult draw_by(const ShaderView& shader, const State& state, const Mesh& mesh,
                   Picture& framebuffer, unsigned threads) {
  return draw_checked_frame(&shader, state, mesh, framebuffer, threads);
}

DrawResult clear_and_draw_by(const ShaderView& shader, const State& state, const Mesh& mesh,
                             const TargetSize& size, float depth, Picture& framebuffer,
                             unsigned threads) {
  return clear_and_draw_checked_frame(&shader, state, mesh, size, depth, framebuffer, threads);
}

}  // namespace rastercheck::rasterizer
