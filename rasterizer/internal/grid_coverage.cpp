#include "rasterizer/internal/grid_coverage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rasterizer/internal/determinant.h"
#include "rasterizer/internal/discard.h"

namespace rastercheck::rasterizer {

Fate GridCoverage::locate(const InputTriangle& triangle) {
  if (setting_.is_empty()) return Fate::degenerate;
  const State& state = setting_.state;
  grid_polygon(state, grid_, triangle.positions, triangle.distances, polygon_);
  if (polygon_.corners.empty()) return Fate::hidden;
  grid_pieces(polygon_.corners, pieces_);
  if (pieces_.empty()) return Fate::degenerate;

  const auto& p = triangle.positions;
  turn_ = determinant_sign(p[0], p[1], p[2]);
  const int ideal_turn = setting_.frame.displayed(turn_);
  const int snapped_turn = sign(signed_area(pieces_));
  whole_turn_ = snapped_turn != 0 ? snapped_turn : ideal_turn;
  if (whole_turn_ == 0) return Fate::degenerate;
  const bool has_ideal_facing = state.basis == Basis::ideal && ideal_turn != 0;
  facing_turn_ = has_ideal_facing ? ideal_turn : whole_turn_;
  if (is_culled(state, facing_turn_)) return Fate::hidden;

  box_ = touched_pixels(polygon_.corners, bits_, {setting_.bounds.columns, setting_.bounds.rows});
  return box_.columns.empty() || box_.rows.empty() ? Fate::hidden : Fate::drawn;
}

Fate GridCoverage::set_up(const InputTriangle& triangle, std::vector<DrawnPart>& parts) {
  const Fate fate = locate(triangle);
  if (fate != Fate::drawn) return fate;
  const auto& p = triangle.positions;
  // Moves the drawn pieces to the front, in their order.
  drawn_pieces_ = 0;
  for (GridPiece& piece : pieces_) {
    if (piece.turn == whole_turn_) std::swap(piece, pieces_[drawn_pieces_++]);
  }

  has_parts_of_pieces_ = setting_.state.basis == Basis::snapped || turn_ == 0;
  if (has_parts_of_pieces_) {
    set_up_pieces(triangle, parts);
    return Fate::drawn;
  }
  parts.resize(1);
  parts[0].weights.set_ideal(p, edge_functions(p, turn_, setting_.frame, setting_.tie_sign),
                             setting_.frame);
  parts[0].weights.widen_bands();  // samples may lie outside the triangle
  parts[0].source = {p, triangle.attributes, {}};
  set_up_vertices(p);
  return Fate::drawn;
}

void GridCoverage::set_up_vertices(const std::array<glm::vec4, 3>& positions) {
  vertex_count_ = 0;
  for (const glm::vec4& p : positions) {
    if (!(p.w > 0)) continue;
    const auto at = [&p](const GridAxis& axis, float coordinate) {
      return (axis.slope * coordinate / p.w + axis.origin + axis.size) / 2;
    };
    vertices_[vertex_count_++] = {at(grid_.x, p.x), at(grid_.y, p.y)};
  }
}

/// The samples of a row that may lie exactly at a vertex of the clip positions. Positions near
/// samples are below 2^15 pixels, and three roundings in double change them by less than 2^-35.
Mask GridCoverage::samples_at_vertices(const SampleOffset& offset, int y, int first) const {
  constexpr double kNear = 0x1p-20;
  Mask at_vertex = 0;
  for (std::size_t i = 0; i < vertex_count_; ++i) {
    const double column = vertices_[i].x - offset.x - first;
    const bool is_near = std::abs(vertices_[i].y - offset.y - y) <= kNear && column > -kNear &&
                         column < kBlockSize - 1 + kNear &&
                         std::abs(column - std::round(column)) <= kNear;
    if (is_near) at_vertex |= Mask{1} << static_cast<int>(std::round(column));
  }
  return at_vertex;
}

void GridCoverage::set_up_pieces(const InputTriangle& triangle,
                                 std::vector<DrawnPart>& parts) const {
  parts.resize(drawn_pieces_);
  for (std::size_t k = 0; k < drawn_pieces_; ++k) {
    parts[k].weights.set_placed(pieces_[k], polygon_.corners, frame_);
    parts[k].source = {triangle.positions, triangle.attributes, corners_of(pieces_[k])};
  }
}

PixelRange GridCoverage::span(std::size_t sample, int y) const {
  PixelRange span{box_.columns.end, box_.columns.begin};
  for (std::size_t k = 0; k < drawn_pieces_; ++k) {
    const PixelRange covered = covered_pixels(pieces_[k], box_.columns, y, setting_.pattern[sample],
                                              bits_, setting_.tie_sign);
    if (covered.empty()) continue;
    span.begin = std::min(span.begin, covered.begin);
    span.end = std::max(span.end, covered.end);
  }
  return span;
}

CoveredBlock GridCoverage::cover(std::size_t sample, int y, int first, int /*count*/,
                                 BlockWeights& /*weights*/) {
  const SampleOffset& offset = setting_.pattern[sample];
  const Mask wanted = columns_mask(setting_.bounds.sample_columns[sample], first);
  piece_masks_.clear();
  CoveredBlock block;
  block.is_whole_numbers = true;
  for (const GridPiece& piece : pieces_) {
    const PixelRange covered =
        covered_pixels(piece, box_.columns, y, offset, bits_, setting_.tie_sign);
    piece_masks_.push_back(columns_mask(covered, first) & wanted);
    if (piece_masks_.size() <= drawn_pieces_) block.covered |= piece_masks_.back();
  }
  if (pieces_.size() > drawn_pieces_) {  // some pieces have the opposite orientation
    for_each_bit(block.covered, [&](int j) {
      int count = 0;
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const bool owns = (piece_masks_[k] >> j & 1) != 0;
        if (owns) count += k < drawn_pieces_ ? 1 : -1;
      }
      if (count <= 0) block.covered &= ~(Mask{1} << j);
    });
  }
  // A sample that several pieces own is drawn with the first of them.
  Mask taken = 0;
  for (std::size_t k = 0; k < drawn_pieces_; ++k) {
    piece_masks_[k] &= block.covered & ~taken;
    taken |= piece_masks_[k];
  }
  if (!has_parts_of_pieces_) {
    block.at_vertex = samples_at_vertices(offset, y, first) & block.covered;
    return block;
  }
  for (const GridCorner& corner : polygon_.corners) {
    const GridPoint at_first = grid_sample(first, y, offset, bits_);
    const std::int64_t along = corner.at.x - at_first.x;
    const std::int64_t column = along >> bits_;
    if (corner.at.y != at_first.y || column < 0 || column >= kBlockSize) continue;
    if (column << bits_ == along) block.at_vertex |= Mask{1} << column & block.covered;
  }
  return block;
}

Mask GridCoverage::part_mask(const CoveredBlock& block, std::size_t part) const {
  return has_parts_of_pieces_ ? piece_masks_[part] : block.covered;
}

std::size_t GridCoverage::part_at(double u, double v) const {
  return has_parts_of_pieces_ ? piece_at(u, v) : 0;
}

PieceCorners GridCoverage::corners_at(double u, double v) const {
  return corners_of(pieces_[piece_at(u, v)]);
}

PieceCorners GridCoverage::corners_of(const GridPiece& piece) const {
  PieceCorners corners{};
  for (std::size_t i = 0; i < 3; ++i) corners[i] = &polygon_.corners[piece.corners[i]];
  return corners;
}

/// The piece at a window position. For a pixel centre that no piece contains, this is the first
/// piece, whose planes are then extrapolated.
std::size_t GridCoverage::piece_at(double u, double v) const {
  const GridPoint p{static_cast<std::int64_t>(frame_.u.at(u)),
                    static_cast<std::int64_t>(frame_.v.at(v))};
  for (std::size_t k = 0; k < drawn_pieces_; ++k) {
    const auto& edges = pieces_[k].edges;
    if (std::all_of(edges.begin(), edges.end(),
                    [&p](const GridLine& edge) { return edge.at(p) >= 0; })) {
      return k;
    }
  }
  return 0;
}

}  // namespace rastercheck::rasterizer
