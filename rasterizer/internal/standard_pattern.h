#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The standard sample positions, which OpenGL, Vulkan and D3D share.

#include <span>

namespace rastercheck::rasterizer {

/// Offset in pixels from the pixel's corner with the least window x and y: multiples of 1/16 in
/// [0, 1).
struct SampleOffset {
  double x = 0;
  double y = 0;
};

/// The middle of a pixel: the only sample of the one-sample pattern.
inline constexpr SampleOffset kPixelCenter{0.5, 0.5};

/// The offsets in index order; empty unless `samples` is 1, 2, 4, 8 or 16.
std::span<const SampleOffset> standard_pattern(int samples);

}  // namespace rastercheck::rasterizer
