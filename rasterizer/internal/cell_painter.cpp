#include "rasterizer/internal/cell_painter.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rastercheck::rasterizer {
namespace {

/// The sample of a cell's lane (shading.h).
LanePlace place_of(const FragmentBatch::Cell& cell, std::size_t lane) {
  return {cell.sample, cell.x + static_cast<int>(lane % FragmentBatch::kCellWidth),
          cell.y + static_cast<int>(lane / FragmentBatch::kCellWidth)};
}

}  // namespace

PaintSetting paint_setting(const ShaderView& shader, const State& state, const Mesh& mesh,
                           const Picture& framebuffer) {
  PaintSetting paint{
      shader,
      {state.depth_test, state.depth_write, state.blend, framebuffer.format == ColorFormat::rgba8},
      std::vector<double>(state.attributes.size())};
  const std::size_t count = paint.errors.size();
  for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
    const double size = std::abs(mesh.attributes[i]);
    double& most = paint.errors[i % count];
    if (std::isfinite(size)) most = std::max(most, size);
  }
  for (double& error : paint.errors) error *= FragmentBatch::kErrorShare;  // certificates.h
  return paint;
}

CellPainter::CellPainter(const DrawSetting& setting, const PaintSetting& paint,
                         FallbackDrawing& fallback)
    : setting_(setting),
      paint_(paint),
      fallback_(fallback),
      cells_(std::make_unique<TileCells>()),
      batch_(setting.state.attributes.size(), paint.shader.outputs, paint.shader.uses_derivatives),
      marks_all_(paint.merging.blend == Blend::off && !paint.shader.discards) {
  if (marks_all_) marks_.resize(setting.pattern.size() * kTileSize * kTileSize);
}

void CellPainter::begin(Tile& tile, std::span<const TileArea> areas) {
  tile_ = &tile;
  areas_ = areas;
  marked_.clear();
}

void CellPainter::end() {
  if (!marked_.empty()) {
    for (std::size_t s = 0; s < areas_.size(); ++s) {
      for (int row = 0; row < kTileSize; row += 2) draw_marked(s, row);
    }
  }
  flush(marks_all_ ? merging_of_marked() : paint_.merging);
}

void CellPainter::draw(const KernelSetting& kernel, const double* numbers, std::uint32_t triangle,
                       const TilePart& part) {
  const DepthTest test = paint_.merging.test;
  for (std::size_t s = 0; s < kernel.samples; ++s) {
    const TileArea& area = areas_[s];
    cells_->count = 0;
    const Mask left_out = find_cells(kernel, numbers, test, area, part, *cells_);
    draw_cells(kernel, numbers + TriangleNumbers::kPlanes, triangle, s);
    draw_rows(triangle, s, left_out);
  }
}

void CellPainter::draw_covered(const KernelSetting& kernel, const BinnedTriangle& binned) {
  const int left = binned.box.columns.begin - tile_->columns().begin;
  const int top = binned.box.rows.begin - tile_->rows().begin;
  const int end = std::min(binned.box.rows.end - tile_->rows().begin, kTileSize);
  for (std::size_t s = 0; s < kernel.samples; ++s) {
    const auto covered = std::bit_cast<Mask>(binned.covered[s]);
    const auto of_row = [&](int row) -> Mask {
      if (row < top || row >= top + kSmallBox) return 0;
      const Mask columns = covered >> kSmallBox * (row - top) & 0xff;
      return left < 0 ? columns >> -left : columns << left;
    };
    cells_->count = 0;
    for (int row = std::max(top, 0) & ~1; row < end; row += 2) {
      cells_->add_rows(row, of_row(row), of_row(row + 1));
    }
    draw_cells(kernel, binned.planes, binned.triangle, s);
  }
}

void CellPainter::draw_cells(const KernelSetting& kernel, const double* planes,
                             std::uint32_t triangle, std::size_t sample) {
  if (marks_all_) return mark(kernel, planes, triangle, sample);
  const CellSource source = source_of(triangle, sample);
  for (std::span<const TileCell> rest = cells_->all(); !rest.empty();) {
    rest = rest.subspan(
        evaluate_cells(kernel, planes, paint_.merging, areas_[sample], source, rest, batch_));
    if (batch_.is_full()) flush(paint_.merging);
  }
}

void CellPainter::mark(const KernelSetting& kernel, const double* planes, std::uint32_t triangle,
                       std::size_t sample) {
  if (cells_->count == 0) return;
  kernel_ = &kernel;
  const auto next = static_cast<std::uint32_t>(marked_.size() + 1);
  if (mark_cells(kernel, planes, paint_.merging, areas_[sample], cells_->all(), next,
                 marks_of(sample))) {
    marked_.push_back({planes, triangle});
  }
}

void CellPainter::draw_marked(std::size_t sample, int row) {
  take_marked(row, marks_of(sample), marked_cells_);
  const CellSource source = source_of(0, sample);
  for (std::span<const MarkedCells::Cell> rest = marked_cells_.all(); !rest.empty();) {
    rest = rest.subspan(evaluate_marked(*kernel_, marked_, areas_[sample], source, rest, batch_));
    if (batch_.is_full()) flush(merging_of_marked());
  }
}

std::uint32_t* CellPainter::marks_of(std::size_t sample) {
  return marks_.data() + sample * kTileSize * kTileSize;
}

CellSource CellPainter::source_of(std::uint32_t triangle, std::size_t sample) const {
  return {triangle, static_cast<std::uint16_t>(sample), tile_->columns().begin,
          tile_->rows().begin};
}

/// Marked fragments have passed the depth test, and their depths are in the tile already.
Merging CellPainter::merging_of_marked() const {
  return {DepthTest::always, false, Blend::off, paint_.merging.has_words};
}

void CellPainter::draw_lanes(std::uint32_t triangle, Mask rows) {
  for (std::size_t s = 0; s < setting_.pattern.size(); ++s) draw_rows(triangle, s, rows);
}

void CellPainter::draw_rows(std::uint32_t triangle, std::size_t sample, Mask rows) {
  for (int row = 0; row < kTileSize; row += 2) {
    if ((rows >> row & 3) != 0) draw_two_rows(triangle, sample, row, rows);
  }
}

/// Draws `row`, which must be even, and the row after it. Skips rows that are not in `rows`.
void CellPainter::draw_two_rows(std::uint32_t triangle, std::size_t sample, int row, Mask rows) {
  if (!fallback_.begin(triangle)) return;
  if (marks_all_) {  // earlier triangles must be drawn first
    if (!marked_.empty()) draw_marked(sample, row);
    flush(merging_of_marked());
    fallback_.begin(triangle);  // the shader may have begun another triangle
  }
  const auto cover = [&](int of_tile) {
    const int y = tile_->rows().begin + of_tile;
    const bool is_wanted = (rows >> of_tile & 1) != 0 && y < tile_->rows().end;
    return is_wanted ? fallback_.cover(sample, y, tile_->columns().begin) : Mask{0};
  };
  cells_->count = 0;
  cells_->add_rows(row, cover(row), cover(row + 1));
  for (const TileCell& cell : cells_->all()) add_lanes(triangle, sample, cell);
  if (marks_all_) flush(paint_.merging);
}

void CellPainter::add_lanes(std::uint32_t triangle, std::size_t sample, const TileCell& cell) {
  const std::size_t first = batch_.count * FragmentBatch::kCellLanes;
  FragmentBatch::Cell& added = batch_.cells[batch_.count++];
  added = {triangle, cell.covered, static_cast<std::uint16_t>(tile_->columns().begin + cell.column),
           static_cast<std::uint16_t>(tile_->rows().begin + cell.row),
           static_cast<std::uint16_t>(sample)};
  fallback_.begin(triangle);  // the shader may have begun another triangle
  for (std::size_t lane = 0; lane < FragmentBatch::kCellLanes; ++lane) {
    fallback_.evaluate(place_of(added, lane),
                       {batch_.depth, batch_.values, batch_.along_u, batch_.along_v, first + lane});
  }
  if (batch_.is_full()) flush(paint_.merging);
}

void CellPainter::flush(const Merging& merging) {
  if (batch_.count == 0) return;
  batch_.discarded.fill(0);
  FragmentBatch in;
  in.lanes = batch_.count * FragmentBatch::kCellLanes;
  in.cells = std::span(batch_.cells).first(batch_.count);
  in.values = batch_.values;
  in.along_u = batch_.along_u;
  in.along_v = batch_.along_v;
  in.errors = paint_.errors;
  in.exact = this;
  ShadedBatch out{batch_.color, std::span(batch_.discarded).first(batch_.count)};
  paint_.shader.shade(paint_.shader.shader, in, out);
  if (!paint_.shader.discards) batch_.discarded.fill(0);
  merge_cells(merging, batch_, tile_->columns().begin, tile_->rows().begin, areas_);
  batch_.count = 0;
}

std::optional<LanePlace> CellPainter::begin_lane(std::size_t lane) {
  const FragmentBatch::Cell& cell = batch_.cells[lane / FragmentBatch::kCellLanes];
  if (!fallback_.begin(cell.triangle)) return std::nullopt;
  return place_of(cell, lane % FragmentBatch::kCellLanes);
}

double CellPainter::floor(std::size_t attribute, std::size_t lane, double scale, double period) {
  const std::optional<LanePlace> place = begin_lane(lane);
  return place ? fallback_.floor(*place, attribute, scale, period) : 0;
}

bool CellPainter::is_front(std::size_t lane) {
  const bool is_drawn = begin_lane(lane).has_value();
  return is_drawn && fallback_.is_front();
}

float CellPainter::depth(std::size_t lane) {
  const std::optional<LanePlace> place = begin_lane(lane);
  return place ? fallback_.depth(*place) : 0;
}

double CellPainter::reciprocal_w(std::size_t lane) {
  const std::optional<LanePlace> place = begin_lane(lane);
  return place ? fallback_.reciprocal_w(*place) : 0;
}

}  // namespace rastercheck::rasterizer
