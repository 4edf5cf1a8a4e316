#pragma once

// Draws triangles into a tile by a shader: finds the cells that they touch, fills a batch with them
// and, whenever it is full, has it shaded and merges it into the tile. Where only what is seen in
// the end has to be shaded, triangles leave marks first, and the cells are those of marks. Each
// thread has one.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rasterizer/internal/binning.h"
#include "rasterizer/internal/cell_batch.h"
#include "rasterizer/internal/cell_kernels.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/kernel_setting.h"
#include "rasterizer/internal/lane_drawing.h"
#include "rasterizer/internal/merge_kernels.h"
#include "rasterizer/internal/tile.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// What all painters of a draw have in common.
struct PaintSetting {
  ShaderView shader;
  Merging merging;
  std::vector<double> errors;  ///< FragmentBatch::errors
};

/// For checked arguments.
PaintSetting paint_setting(const ShaderView& shader, const State& state, const Mesh& mesh,
                           const Picture& framebuffer);

class CellPainter : public ExactAttributes {
 public:
  CellPainter(const DrawSetting& setting, const PaintSetting& paint, const Mesh& mesh);

  /// From here on into this tile; `areas` are its samples'.
  void begin(Tile& tile, std::span<const TileArea> areas);
  /// A triangle with numbers, in that part of the tile.
  void draw(const KernelSetting& kernel, const double* numbers, std::uint32_t triangle,
            const TilePart& part);
  /// A small triangle of which is known what it covers; all of it that lies in the tile.
  void draw_covered(const KernelSetting& kernel, const BinnedTriangle& binned);
  /// A triangle in these rows of the tile, whatever it is.
  void draw_lanes(std::uint32_t triangle, Mask rows);
  /// Finishes what was drawn.
  void end();

  double floor(std::size_t attribute, std::size_t lane, double scale, double period) override;

 private:
  /// The cells at hand.
  void draw_cells(const KernelSetting& kernel, const double* planes, std::uint32_t triangle,
                  std::size_t sample);
  void mark(const KernelSetting& kernel, const double* planes, std::uint32_t triangle,
            std::size_t sample);
  /// Draws what is marked in two rows, the first of which is even.
  void draw_marked(std::size_t sample, int row);
  std::uint32_t* marks_of(std::size_t sample);
  Merging merging_of_marked() const;
  CellSource source_of(std::uint32_t triangle, std::size_t sample) const;
  void draw_rows(std::uint32_t triangle, std::size_t sample, Mask rows);
  void draw_two_rows(std::uint32_t triangle, std::size_t sample, int row, Mask rows);
  void add_lanes(std::uint32_t triangle, std::size_t sample, const TileCell& cell,
                 std::uint16_t at_vertex);
  void flush(const Merging& merging);

  const DrawSetting& setting_;
  const PaintSetting& paint_;
  std::unique_ptr<LaneDrawing> lanes_;
  std::unique_ptr<TileCells> cells_;
  CellBatch batch_;
  bool marks_all_;                         ///< that have numbers
  const KernelSetting* kernel_ = nullptr;  ///< of those that are marked
  std::vector<MarkedTriangle> marked_;
  std::vector<std::uint32_t> marks_;  ///< [sample][row][column]
  MarkedCells marked_cells_;
  Tile* tile_ = nullptr;
  std::span<const TileArea> areas_;
};

}  // namespace rastercheck::rasterizer
