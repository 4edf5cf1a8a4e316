#pragma once

// Serves the route “shaded frames” (docs/rasterizer.md, Routes).
//
// Draws triangles into a tile through a shader. Finds the cells that the triangles touch, fills a
// batch with those cells, shades each full batch and merges it into the tile. If only finally
// visible fragments need shading, triangles first leave marks, and the cells are made from the
// marks. Each thread has its own painter.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/internal/binning.h"
#include "rasterizer/internal/cell_batch.h"
#include "rasterizer/internal/cell_kernels.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/fallback_drawing.h"
#include "rasterizer/internal/kernel_setting.h"
#include "rasterizer/internal/merge_kernels.h"
#include "rasterizer/internal/tile.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// Data shared by all painters of a draw.
struct PaintSetting {
  ShaderView shader;
  Merging merging;
  std::vector<double> errors;  ///< FragmentBatch::errors
};

/// Makes the setting. The arguments must have been checked.
PaintSetting paint_setting(const ShaderView& shader, const State& state, const Mesh& mesh,
                           const Picture& framebuffer);

class CellPainter : public ExactAttributes {
 public:
  /// The arguments must outlive the painter. `fallback` must compute derivatives if the shader uses
  /// them.
  CellPainter(const DrawSetting& setting, const PaintSetting& paint, FallbackDrawing& fallback);

  /// Starts drawing into this tile. `areas` holds the tile's area for each sample index.
  void begin(Tile& tile, std::span<const TileArea> areas);
  /// Draws the part of a triangle (given by its numbers) that lies inside `part`.
  void draw(const KernelSetting& kernel, const double* numbers, std::uint32_t triangle,
            const TilePart& part);
  /// Draws the part of a small triangle that lies in the tile, from the triangle's covered samples.
  void draw_covered(const KernelSetting& kernel, const BinnedTriangle& binned);
  /// Draws any triangle in these rows of the tile, lane by lane, with the fallback drawing.
  void draw_lanes(std::uint32_t triangle, Mask rows);
  /// Shades and merges everything that is still pending.
  void end();

  double floor(std::size_t attribute, std::size_t lane, double scale, double period) override;
  bool is_front(std::size_t lane) override;
  float depth(std::size_t lane) override;
  double reciprocal_w(std::size_t lane) override;

 private:
  /// Makes the lane's triangle the fallback's current one; returns the lane's sample. Empty if the
  /// fallback does not draw the triangle. Only drawn triangles have lanes, so this takes a defect
  /// (tests/mutants) in one of the two.
  std::optional<LanePlace> begin_lane(std::size_t lane);
  /// Draws the cells in `cells_` or, if `marks_all_`, marks their samples.
  void draw_cells(const KernelSetting& kernel, const double* planes, std::uint32_t triangle,
                  std::size_t sample);
  void mark(const KernelSetting& kernel, const double* planes, std::uint32_t triangle,
            std::size_t sample);
  /// Draws the marked samples of `row`, which must be even, and row + 1.
  void draw_marked(std::size_t sample, int row);
  std::uint32_t* marks_of(std::size_t sample);
  Merging merging_of_marked() const;
  CellSource source_of(std::uint32_t triangle, std::size_t sample) const;
  void draw_rows(std::uint32_t triangle, std::size_t sample, Mask rows);
  void draw_two_rows(std::uint32_t triangle, std::size_t sample, int row, Mask rows);
  void add_lanes(std::uint32_t triangle, std::size_t sample, const TileCell& cell);
  void flush(const Merging& merging);

  const DrawSetting& setting_;
  const PaintSetting& paint_;
  FallbackDrawing& fallback_;
  std::unique_ptr<TileCells> cells_;
  CellBatch batch_;
  bool marks_all_;                         ///< true if all triangles with numbers leave marks
  const KernelSetting* kernel_ = nullptr;  ///< kernel of the marked triangles
  std::vector<MarkedTriangle> marked_;
  std::vector<std::uint32_t> marks_;  ///< [sample][row][column]
  MarkedCells marked_cells_;
  Tile* tile_ = nullptr;
  std::span<const TileArea> areas_;
};

}  // namespace rastercheck::rasterizer
