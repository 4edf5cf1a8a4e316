#pragma once

// A texture, and scenes whose attributes are coordinates in it.

#include <string_view>

#include "cases/error.h"
#include "rasterizer/texture.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/draw_kinds.h"

namespace rastercheck::bench {

/// Texels per side, a power of two. The texture takes 4 MiB without its smaller levels.
inline constexpr int kTextureSize = 1024;

/// Waves of colour with a little noise, none of them symmetric, so that a mirrored picture differs.
/// Alpha is a checkerboard of squares of 16 × 16 texels, about 1/4 and about 3/4. Made on first
/// request.
const Result<rasterizer::Texture>& bench_texture();

/// A frame_scene() whose attributes are texture coordinates if the kind has a texture. They are
/// scaled so that all triangles together have as many texels as pixels. If triangles share no
/// vertices, each triangle gets a place of its own in the texture; otherwise all small triangles
/// would sample the same few texels.
const Result<Scene>& shaded_scene(std::string_view name, const DrawKind& kind);

}  // namespace rastercheck::bench
