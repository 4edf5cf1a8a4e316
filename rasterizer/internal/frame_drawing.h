#pragma once

// A draw into a framebuffer, on several threads: chunks of triangles are sorted into the tiles that
// they touch, then each tile is drawn by one thread, its triangles in submission order
// (sort-middle). What a sample becomes depends on its tile's triangles alone, so the picture is the
// same to the bit for any number of threads.

#include <cstddef>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Draws into the framebuffer. The arguments were checked. Throws where memory runs out; then some
/// tiles are drawn and the others are what they were.
DrawCounts draw_frame(const State& state, const Mesh& mesh, Framebuffer& framebuffer,
                      std::size_t workers);

}  // namespace rastercheck::rasterizer
