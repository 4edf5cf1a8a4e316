#pragma once

// What every draw into a framebuffer has in common: its arguments are checked first, and memory
// that runs out is an error value.

#include <cstddef>
#include <optional>

#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// Whether its arrays have its own size.
std::optional<Error> check_framebuffer(const Picture& framebuffer);

/// Gives it memory of that size and of its own format, if that can hold so many channels; what it
/// holds is any. It keeps what it had where memory runs out.
std::optional<Error> resize(Picture& framebuffer, const TargetSize& size,
                            std::size_t attribute_count);

/// Draws what a shader makes of the attributes, or, where that is nullptr, these.
DrawResult draw_checked_frame(const ShaderView* shader, const State& state, const Mesh& mesh,
                              Picture& framebuffer, unsigned threads);
/// The same with all samples cleared to that depth before.
DrawResult clear_and_draw_checked_frame(const ShaderView* shader, const State& state,
                                        const Mesh& mesh, const TargetSize& size, float depth,
                                        Picture& framebuffer, unsigned threads);

}  // namespace rastercheck::rasterizer
