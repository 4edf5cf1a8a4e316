#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Coverage of the triangle with snapped vertices, computed in whole numbers (grid_polygon.h,
// grid_piece.h).
//
// Values come from the same pieces (Basis::snapped) or from the triangle of the clip positions
// (Basis::ideal); in the latter case, covered samples may lie slightly outside the triangle. If the
// triangle of the clip positions is a line that snapping turns into a triangle, it has no values of
// its own, and values come from the pieces.

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/grid_piece.h"
#include "rasterizer/internal/grid_polygon.h"
#include "rasterizer/internal/grid_position.h"

namespace rastercheck::rasterizer {

class GridCoverage {
 public:
  static constexpr bool kLeavesWeights = false;

  /// The setting's state must have a snapping.
  explicit GridCoverage(const DrawSetting& setting)
      : setting_(setting),
        bits_(unit_bits(*setting.state.snapping)),
        grid_(grid_of(setting.state)),
        frame_(grid_frame(setting.window, bits_)) {}

  Fate locate(const InputTriangle& triangle);
  Fate set_up(const InputTriangle& triangle, std::vector<DrawnPart>& parts);
  const PixelBox& box() const { return box_; }
  PixelRange span(std::size_t sample, int y) const;
  CoveredBlock cover(std::size_t sample, int y, int first, int count, BlockWeights& weights);
  Mask part_mask(const CoveredBlock& block, std::size_t part) const;
  std::size_t part_at(double u, double v) const;
  bool is_front() const { return is_front_face(setting_.state, facing_turn_); }
  const GridPolygon* polygon() const { return &polygon_; }
  PieceCorners corners_at(double u, double v) const;

 private:
  PieceCorners corners_of(const GridPiece& piece) const;
  std::size_t piece_at(double u, double v) const;
  void set_up_pieces(const InputTriangle& triangle, std::vector<DrawnPart>& parts) const;
  void set_up_vertices(const std::array<glm::vec4, 3>& positions);
  Mask samples_at_vertices(const SampleOffset& offset, int y, int first) const;

  const DrawSetting& setting_;
  int bits_;
  Grid grid_;
  SampleFrame frame_;

  // The current triangle.
  int turn_ = 0;         ///< the orientation of the clip positions
  int whole_turn_ = 0;   ///< the orientation of the snapped polygon, as displayed
  int facing_turn_ = 0;  ///< the orientation that faces are told apart by, as displayed
  GridPolygon polygon_;
  std::vector<GridPiece> pieces_;  ///< first those that turn like the whole polygon
  std::size_t drawn_pieces_ = 0;   ///< number of pieces that turn like the whole polygon
  PixelBox box_;
  bool has_parts_of_pieces_ = false;
  /// If values come from the clip positions: the window positions of the vertices with w > 0.
  std::array<SampleOffset, 3> vertices_{};
  std::size_t vertex_count_ = 0;
  std::vector<Mask> piece_masks_;  ///< for the last block
};

}  // namespace rastercheck::rasterizer
