#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Draws into a framebuffer on several threads. Chunks of triangles are sorted into the tiles that
// they touch (binning.h); then one thread draws each tile, its triangles in submission order
// (sort-middle). A sample depends only on the triangles of its tile, so the picture is identical to
// the bit for any number of threads.
//
// When the sorted data exceeds kBinMemory, the tiles are drawn before sorting goes on. So a draw
// needs at most kBinMemory, one more wave of chunks and, for each thread, a tile and the fragments
// of a chunk.

#include <cstddef>
#include <optional>

#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// Size of the sorted data at which the tiles are drawn, in bytes.
inline constexpr std::size_t kBinMemory = std::size_t{64} << 20;

/// Draws the attributes, or a shader's outputs, into the framebuffer. With `clear_depth`, draws as
/// if the framebuffer had been cleared to that depth. The arguments must have been checked. Throws
/// if memory runs out; each tile is then drawn in part or unchanged.
DrawCounts draw_frame(const State& state, const Mesh& mesh, Picture& framebuffer,
                      std::size_t workers, std::optional<float> clear_depth,
                      const ShaderView* shader = nullptr);

}  // namespace rastercheck::rasterizer
