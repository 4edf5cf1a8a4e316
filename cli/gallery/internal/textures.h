#pragma once

// The textures of the figures, with kTexels · kTexels texels: shaders that use a fragment's first
// two attributes as texture coordinates.

#include "cli/gallery/internal/panel.h"

namespace rastercheck::gallery {

/// A board of 8 · 8 checks. Every `group` consecutive triangles get the next of three tints, which
/// repeat; with 0, no triangle is tinted.
Shader checkerboard(std::uint32_t group = 0);

/// A tile with an asymmetric shape, repeated beyond [0, 1) (MIT 6.837 2000, lecture 18, slide 18),
/// also for coordinates below 0.
Shader tiles();

/// A trellis whose holes have alpha 0 (MIT 6.837 2000, lecture 18, slide 19), on all triangles but
/// the first two, which have the checkerboard.
Shader trellis();

/// The first three attributes as red, green and blue.
Shader vertex_colors();

}  // namespace rastercheck::gallery
