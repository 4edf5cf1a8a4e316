#pragma once

// The production rasterizer's drawing. Stages, for each triangle:
//
//   edges        lines and what double knows of them (edge_functions.h, grid_piece.h, weights.h)
//   certificate  whether double is enough for its values (certificates.h)
//   coverage     which samples of a block of 64 pixels it covers: exactly that of exact arithmetic
//                (exact_coverage.h), or that of snapped vertices (grid_coverage.h)
//   weights      E_i of the block's samples (block_kernels.h)
//   evaluation   depth and attributes from them, one rounding each (block_kernels.h,
//                exact_values.h); in float32 where that is asked for (float_kernels.h). Their
//                screen derivatives, where asked for (derivatives.h)
//
// Every stage shows what it made to a Tap (tap.h) as well.

#include <cstdint>
#include <memory>

#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/tile.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

/// Appends the fragments of every triangle, as if each were drawn alone. The arguments were
/// checked.
DrawCounts draw_mesh(const State& state, const Mesh& mesh, const TargetSize& size,
                     Fragments& fragments);

/// The trace of a sample, its triangle drawn alone; nothing where that is not set up. The arguments
/// were checked.
std::optional<Trace> trace_mesh(const State& state, const Mesh& mesh, const TargetSize& size,
                                const SamplePlace& address);

/// Draws into tiles of a framebuffer; each thread has its own.
class TileDrawing {
 public:
  virtual ~TileDrawing() = default;
  /// What becomes of a triangle of the mesh, and if it is drawn the pixels that it may touch.
  virtual Fate locate(std::size_t triangle, PixelBox& box) = 0;
  /// Draws what of a triangle lies in rows of the tile: bit i is row tile.rows().begin + i.
  virtual void draw(std::uint32_t triangle, Tile& tile, Mask rows) = 0;
};

/// For checked arguments, which must outlive it.
std::unique_ptr<TileDrawing> make_tile_drawing(const DrawSetting& setting, const Mesh& mesh);

}  // namespace rastercheck::rasterizer
