#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Coverage of the mathematical triangle that the float32 clip positions define, sample by sample,
// without snapping or clip vertices; w <= 0 is allowed (Appendix 5, clipless homogeneous scan
// conversion; RULES §6).
//
// A block of samples is evaluated in double (block_kernels.h). If an edge or a clip functional is
// within its error band, a sum without rounding decides; if that sum is zero, the fill rule
// decides. So coverage equals the result of exact arithmetic for every finite input.

#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/clip_functionals.h"
#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/edge_functions.h"

namespace rastercheck::rasterizer {

/// A coverage mode (coverage.h) that always draws a triangle as one part.
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
  bool is_front() const { return is_front_face(setting_.state, setting_.frame.displayed(turn_)); }
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

/// An edge function on a row of samples, in the kernels' form.
EdgeRow edge_row(const EdgeFunctions& edges, const SampleFrame& frame, double v, double offset);

}  // namespace rastercheck::rasterizer
