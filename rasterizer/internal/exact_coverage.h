#pragma once

// Coverage of the mathematical triangle of the float32 clip positions, sample by sample: no
// snapping, no clip vertices, w <= 0 is ordinary (seed 000, clipless homogeneous scan conversion;
// RULES §6).
//
// A block of samples is evaluated in double (block_kernels.h). Where an edge or a clip functional
// is within its band of doubt, a sum without rounding decides, and of a zero the fill rule. So
// coverage is that of exact arithmetic for every finite input.

#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/clip_functionals.h"
#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/edge_functions.h"

namespace rastercheck::rasterizer {

/// In one part always.
class ExactCoverage {
 public:
  static constexpr bool kLeavesWeights = true;

  explicit ExactCoverage(const DrawSetting& setting) : setting_(setting) {}

  Fate locate(const InputTriangle& triangle);
  Fate set_up(const InputTriangle& triangle, std::vector<DrawnPart>& parts);
  const PixelBox& box() const { return box_; }
  PixelRange span(std::size_t sample, int y) const;
  CoveredBlock cover(std::size_t sample, int y, int first, int count, BlockWeights& weights) const;
  static Mask part_mask(const CoveredBlock& block, std::size_t /*part*/) { return block.covered; }
  static std::size_t part_at(double /*u*/, double /*v*/) { return 0; }
  static const GridPolygon* polygon() { return nullptr; }
  static PieceCorners corners_at(double /*u*/, double /*v*/) { return {}; }

 private:
  void find_box(const InputTriangle& triangle);
  bool is_inside(const BlockWeights& weights, int column, double u, double v) const;
  bool is_visible(const BlockWeights& weights, int column, double u, double v) const;
  bool is_at_vertex(const BlockWeights& weights, int column) const;

  const DrawSetting& setting_;
  int turn_ = 0;  ///< the orientation in clip space
  EdgeFunctions edges_;
  ClipFunctionals clips_;
  PixelBox box_;
};

/// A row of an edge function's samples, as the kernels take it.
EdgeRow edge_row(const EdgeFunctions& edges, const SampleFrame& frame, double v, double offset);

}  // namespace rastercheck::rasterizer
