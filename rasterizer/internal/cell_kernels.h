#pragma once

// Serves the route “shaded frames” (docs/rasterizer.md, Routes).
//
// Shades by cells on the processor's widest vectors. Finds the cells of a tile that a triangle
// touches and those in which the triangle is visible, and computes their depths and values. All
// targets compute the same bits. Depths and values equal those of tile_kernels.h before rounding.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/internal/cell_batch.h"
#include "rasterizer/internal/kernel_setting.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/merge_kernels.h"
#include "rasterizer/internal/tile_kernels.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A cell of a tile. `covered` is as in FragmentBatch::Cell. Cells may overlap, but no pixel is
/// covered in two cells.
struct TileCell {
  int column = 0;  ///< even, at most kTileSize − 8
  int row = 0;     ///< even
  std::uint16_t covered = 0;
};

struct TileCells {
  static constexpr std::size_t kMost =
      std::size_t{kTileSize} * kTileSize / FragmentBatch::kCellLanes;
  std::size_t count = 0;
  std::array<TileCell, kMost> cells;

  void add(const TileCell& cell) {
    if (cell.covered != 0) cells[count++] = cell;
  }
  /// Adds the cells of rows `row`, which must be even, and row + 1. `of_first` and `of_second` are
  /// the covered columns of the two rows.
  void add_rows(int row, Mask of_first, Mask of_second);
  std::span<const TileCell> all() const { return {cells.data(), count}; }
};

/// Finds the cells of the part of a triangle (given by TriangleNumbers) that lies inside `part`.
/// Returns the rows that the caller must draw another way, because double does not suffice in them
/// or a sample lies at a vertex. If a row is returned, so is the other row of its cells, and those
/// cells are left out of `cells`. If lets_fall(test), `area.greatest` must be set.
Mask find_cells(const KernelSetting& setting, const double* numbers, DepthTest test,
                const TileArea& area, const TilePart& part, TileCells& cells);

/// The triangle, sample index and tile that the cells of a batch come from.
struct CellSource {
  std::uint32_t triangle = 0;
  std::uint16_t sample = 0;
  int left = 0;  ///< left column of the tile, in pixels
  int top = 0;
};

/// Adds cells to a batch, with values, until the batch is full. Also adds depths if
/// needs_depths(merging). Skips cells whose fragments can no longer pass the depth test. Returns
/// the number of cells processed, including those skipped.
std::size_t evaluate_cells(const KernelSetting& setting, const double* planes,
                           const Merging& merging, const TileArea& area, const CellSource& source,
                           std::span<const TileCell> cells, CellBatch& batch);

// If a fragment's colour does not depend on the stored colour and no fragment is discarded, only
// the finally visible triangle of each sample needs shading. Each triangle then first leaves only
// its depths and marks.

/// A triangle that leaves the mark i + 1, where i is its index among the tile's marked triangles.
struct MarkedTriangle {
  const double* planes = nullptr;
  std::uint32_t triangle = 0;
};

/// For the fragments of these cells that pass the depth test, writes `mark` to `marks` and, if
/// merging.writes_depth, their depths to the tile. `marks` is laid out like TileArea::depth.
/// Returns true if any fragment passed.
bool mark_cells(const KernelSetting& setting, const double* planes, const Merging& merging,
                const TileArea& area, std::span<const TileCell> cells, std::uint32_t mark,
                std::uint32_t* marks);

/// The cells of two rows. Each cell holds the samples of one mark.
struct MarkedCells {
  struct Cell {
    TileCell cell;
    std::uint32_t mark = 0;
  };
  static constexpr std::size_t kMost = std::size_t{2} * kTileSize;
  std::size_t count = 0;
  std::array<Cell, kMost> cells;

  std::span<const Cell> all() const { return {cells.data(), count}; }
};

/// Collects the cells with nonzero marks of the rows `row`, which must be even, and row + 1. Resets
/// those marks to 0.
void take_marked(int row, std::uint32_t* marks, MarkedCells& cells);

/// Adds marked cells, with values, to a batch until the batch is full. Ignores `source.triangle`.
/// Returns the number of cells processed.
std::size_t evaluate_marked(const KernelSetting& setting, std::span<const MarkedTriangle> triangles,
                            const TileArea& area, const CellSource& source,
                            std::span<const MarkedCells::Cell> cells, CellBatch& batch);

}  // namespace rastercheck::rasterizer
