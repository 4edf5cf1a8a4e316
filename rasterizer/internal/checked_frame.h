#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Wraps every draw into a framebuffer: checks the arguments first, and turns exhausted memory into
// an error value.

#include <cstddef>
#include <optional>

#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// Checks that the framebuffer's arrays match its size.
std::optional<Error> check_framebuffer(const Picture& framebuffer);

/// Gives the framebuffer memory for `size` in the framebuffer's format, if the format can hold the
/// channel count. Contents are unspecified. If memory runs out, the framebuffer is left unchanged.
std::optional<Error> resize(Picture& framebuffer, const TargetSize& size,
                            std::size_t attribute_count);

/// Draws a shader's outputs or, if `shader` is nullptr, the attributes.
DrawResult draw_checked_frame(const ShaderView* shader, const State& state, const Mesh& mesh,
                              Picture& framebuffer, unsigned threads);
/// Does the same after clearing all samples to `depth`.
DrawResult clear_and_draw_checked_frame(const ShaderView* shader, const State& state,
                                        const Mesh& mesh, const TargetSize& size, float depth,
                                        Picture& framebuffer, unsigned threads);

}  // namespace rastercheck::rasterizer
