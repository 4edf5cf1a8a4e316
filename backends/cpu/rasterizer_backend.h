#pragma once

// The project's own rasterizer as a backend. This folder is the only place that knows both cases
// and the rasterizer's own words.

#include <memory>
#include <string>

#include "backends/backend.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::backends {

/// How a drawing leaves the rasterizer: as a list of fragments, or through the framebuffer that
/// users draw into (framebuffer_drawing.h).
enum class Output { fragments, framebuffer };

struct RasterizerOptions {
  rasterizer::Precision precision = rasterizer::Precision::float64;
  Output output = Output::fragments;
  unsigned threads = 1;  ///< that draw into the framebuffer
  /// The kind of vectors to draw with, one that is supported here (rasterizer/simd.h); empty: the
  /// best that there is.
  std::string simd = {};
};

std::unique_ptr<Backend> make_rasterizer_backend(const RasterizerOptions& options);

}  // namespace rastercheck::backends
