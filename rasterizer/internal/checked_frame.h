#pragma once

// What every draw into a framebuffer has in common: its arguments are checked first, and memory
// that runs out is an error value.

#include <cstddef>
#include <optional>

#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// Whether its arrays have its own size.
std::optional<Error> check_framebuffer(const Framebuffer& framebuffer);
/// Whether so many channels can be held, and blended as the state has it.
std::optional<Error> check_channels(const State& state, ColorFormat format, std::size_t channels);

/// Gives it memory of that size and of its own format, if that can hold so many channels; what it
/// holds is any. It keeps what it had
/// where memory runs out.
std::optional<Error> resize(Framebuffer& framebuffer, const TargetSize& size,
                            std::size_t attribute_count);

struct FrameOptions {
  unsigned threads = 1;              ///< 0: as many as the machine has
  std::optional<float> clear_depth;  ///< cleared to that first
  const ShaderView* shader = nullptr;
};

/// The arguments were checked.
DrawResult draw_checked_frame(const State& state, const Mesh& mesh, Framebuffer& framebuffer,
                              const FrameOptions& options);

}  // namespace rastercheck::rasterizer
