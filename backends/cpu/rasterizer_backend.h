#pragma once

// The project's own rasterizer as a backend. Only this folder uses both cases and the rasterizer's
// own types.

#include <memory>
#include <string>

#include "backends/backend.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::backends {

/// Where a drawing's fragments come from: the rasterizer's list of fragments, or the framebuffer
/// that users draw into (framebuffer_drawing.h).
enum class Output { fragments, framebuffer };

struct RasterizerOptions {
  rasterizer::Precision precision = rasterizer::Precision::float64;
  rasterizer::Conservative conservative = rasterizer::Conservative::off;
  Output output = Output::fragments;
  unsigned threads = 1;  ///< threads that draw into the framebuffer
  /// True if positions on a grid are rounded to the next lesser point, whatever a case asks for.
  bool rounds_down = false;
  /// The SIMD target to draw with, which must be supported here (rasterizer/simd.h); empty means
  /// the best available.
  std::string simd = {};
};

std::unique_ptr<Backend> make_rasterizer_backend(const RasterizerOptions& options);

}  // namespace rastercheck::backends
