#pragma once

// A texture, and scenes whose attributes are coordinates of it.

#include <string_view>

#include "cases/error.h"
#include "rasterizer/texture.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/draw_kinds.h"

namespace rastercheck::bench {

/// Texels per side, a power of two: 4 MiB without its smaller levels.
inline constexpr int kTextureSize = 1024;

/// Waves of colour with a little grain, none symmetric, so that a picture turned over shows; alpha
/// is a chequerboard of patches of 16 × 16 texels, about 1/4 and about 3/4. Made when it is asked
/// for first.
const Result<rasterizer::Texture>& bench_texture();

/// A frame_scene(), its attributes texture coordinates where the kind has a texture: scaled so that
/// all triangles together have as many texels as pixels. Where triangles share no vertices each has
/// a place of its own in the texture, else small ones would all sample the same few texels.
const Result<Scene>& shaded_scene(std::string_view name, const DrawKind& kind);

}  // namespace rastercheck::bench
