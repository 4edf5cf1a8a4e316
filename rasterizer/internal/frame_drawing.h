#pragma once

// A draw into a framebuffer, on several threads: chunks of triangles are sorted into the tiles that
// they touch (binning.h), then each tile is drawn by one thread, its triangles in submission order
// (sort-middle). What a sample becomes depends on its tile's triangles alone, so the picture is the
// same to the bit for any number of threads.
//
// Where what was sorted takes more memory than kBinMemory the tiles are drawn, and sorting goes on
// from there: a draw's memory is that, what one more wave of chunks makes of it, and for each
// thread a tile and the fragments of a chunk.

#include <cstddef>
#include <optional>

#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// Bytes.
inline constexpr std::size_t kBinMemory = std::size_t{64} << 20;

/// Draws into the framebuffer, attributes as they are or what a shader makes of them;
/// `clear_depth`: as if it had been cleared to that before. The arguments were checked. Throws
/// where memory runs out; then tiles hold some of what was to be drawn, or are what they were.
DrawCounts draw_frame(const State& state, const Mesh& mesh, Picture& framebuffer,
                      std::size_t workers, std::optional<float> clear_depth,
                      const ShaderView* shader = nullptr);

}  // namespace rastercheck::rasterizer
