#pragma once

// Shading by cells on the widest vectors that the processor has: which cells of a tile a triangle
// touches, in which of them it is seen, their depths and values. All targets compute the same bits,
// and depths and values are those of tile_kernels.h before they are rounded.

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

/// A cell of a tile; `covered` as FragmentBatch::Cell has it. No pixel is covered in two.
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
  /// The cells of two rows, the first of which is even, with these columns covered.
  void add_rows(int row, Mask of_first, Mask of_second);
  std::span<const TileCell> all() const { return {cells.data(), count}; }
};

/// Finds the cells of what of a triangle with these numbers (TriangleNumbers) lies in that part of
/// a tile. Returns the rows, both of a cell or neither, for which double is not enough, or where a
/// sample is at a vertex; their cells are left out. `area.greatest` has to be that of the tile
/// where the test lets_fall.
Mask find_cells(const KernelSetting& setting, const double* numbers, DepthTest test,
                const TileArea& area, const TilePart& part, TileCells& cells);

/// Where a batch's cells come from.
struct CellSource {
  std::uint32_t triangle = 0;
  std::uint16_t sample = 0;
  int left = 0;  ///< of the tile, in pixels
  int top = 0;
};

/// Adds cells to a batch until it is full, with values, and depths where merging needs_depths;
/// those of which no fragment can pass the depth test any more are passed over. Returns how many
/// are done.
std::size_t evaluate_cells(const KernelSetting& setting, const double* planes,
                           const Merging& merging, const TileArea& area, const CellSource& source,
                           std::span<const TileCell> cells, CellBatch& batch);

// Where colours neither depend on what is there nor are thrown away, only the triangle that is seen
// at a sample in the end has to be shaded there: triangles first leave their depths and marks.

/// A triangle that leaves marks i + 1, where it is number i of a tile's.
struct MarkedTriangle {
  const double* planes = nullptr;
  std::uint32_t triangle = 0;
};

/// Puts depths, if they are written, and `mark` into a tile where fragments of these cells pass the
/// depth test; `marks` as TileArea::depth. Returns whether any does.
bool mark_cells(const KernelSetting& setting, const double* planes, const Merging& merging,
                const TileArea& area, std::span<const TileCell> cells, std::uint32_t mark,
                std::uint32_t* marks);

/// Cells of two rows, each of one mark.
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

/// The cells of the rows `row`, which is even, and row + 1 whose marks are not 0, which they are
/// afterwards.
void take_marked(int row, std::uint32_t* marks, MarkedCells& cells);

/// Adds marked cells to a batch until it is full, with values; `source.triangle` has no say.
/// Returns how many are done.
std::size_t evaluate_marked(const KernelSetting& setting, std::span<const MarkedTriangle> triangles,
                            const TileArea& area, const CellSource& source,
                            std::span<const MarkedCells::Cell> cells, CellBatch& batch);

}  // namespace rastercheck::rasterizer
