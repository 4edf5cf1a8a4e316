#pragma once

#include <cstdint>
#include <vector>

#include "backends/gl/internal/objects.h"
#include "cases/picture.h"

namespace rastercheck::backends::gl {

/// Returns the next level of a texture: along an axis of n texels, it has max(1, ⌊n / 2⌋) of equal
/// size. A texel is the mean of the texels that it covers, weighted by overlap, and rounded to an
/// integer, halves up.
cases::Texture next_level(const cases::Texture& level);

/// Makes the texture with its wrap modes and filter, and leaves it bound to GL_TEXTURE_2D of the
/// active unit. It has several levels only if it is filtered trilinearly. The driver makes none of
/// them, as each driver would make others.
Object make_picture_texture(const cases::Texturing& texturing);

}  // namespace rastercheck::backends::gl
