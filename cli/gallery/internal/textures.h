#pragma once

// The textures of the figures, of kTexels · kTexels texels: shaders that take a fragment's first
// two attributes as texture coordinates.

#include "cli/gallery/internal/panel.h"

namespace rastercheck::gallery {

/// 8 · 8 checks. Of the triangles `group` · k and following, the k-th tint of three.
Shader checkerboard(std::uint32_t group = 0);

/// A tile with a shape on it that has no symmetry, again and again beyond [0, 1) (seed 004, slide
/// 18, for coordinates below 0 as well).
Shader tiles();

/// A trellis, whose holes have alpha 0 (seed 004, slide 19), on all triangles but the first two,
/// which have the checkerboard.
Shader trellis();

/// The first three attributes as red, green and blue.
Shader vertex_colors();

}  // namespace rastercheck::gallery
