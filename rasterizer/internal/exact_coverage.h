#pragma once

// Coverage of the mathematical triangle of the float32 clip positions, sample by sample: no
// snapping, no clip vertices, w <= 0 is ordinary (seed 000, clipless homogeneous scan conversion;
// RULES §6).
//
// A block of samples is evaluated in double (block_kernels.h). Where an edge or a clip functional
// is within its band of doubt, a sum without rounding decides, and of a zero the fill rule. So
// coverage is that of exact arithmetic for every finite input.

#include <array>
#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/clip_functionals.h"
#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/edge_functions.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/grid_piece.h"
#include "rasterizer/internal/masks.h"

namespace rastercheck::rasterizer {

/// What of a block is covered.
struct CoveredBlock {
  Mask covered = 0;
  Mask in_doubt = 0;  ///< of these, the samples that double alone did not decide
  /// Of these, the samples that may lie exactly at a vertex, whose value is then to come back as it
  /// is: two edges are within their bands, or 0.
  Mask at_vertex = 0;
  bool is_whole_numbers = false;  ///< decided on the grid

  void keep(Mask wanted) {
    covered &= wanted;
    in_doubt &= wanted;
    at_vertex &= wanted;
  }
};

/// One part of what is drawn of a triangle, with weights of its own.
struct DrawnPart {
  Weights weights;
  ValueSource source;
  TriangleValues values;
  TriangleDerivatives derivatives;  ///< set up where State::derivatives
};

class ExactCoverage {
 public:
  /// Covering a block leaves its weights behind.
  static constexpr bool kLeavesWeights = true;

  explicit ExactCoverage(const DrawSetting& setting) : setting_(setting) {}

  /// Whether a triangle is drawn, and if so where: sets box() alone.
  Fate locate(const InputTriangle& triangle);
  /// Prepares a triangle, and the one part that it is drawn in (its values are not set up).
  Fate set_up(const InputTriangle& triangle, std::vector<DrawnPart>& parts);

  /// The pixels that it may touch.
  const PixelBox& box() const { return box_; }
  /// Those of a row that it may touch.
  PixelRange span(std::size_t sample, int y) const;
  CoveredBlock cover(std::size_t sample, int y, int first, int count, BlockWeights& weights) const;
  /// The samples of the last block covered that belong to a part.
  static Mask part_mask(const CoveredBlock& block, std::size_t /*part*/) { return block.covered; }
  /// The part that a window position belongs to.
  static std::size_t part_at(double /*u*/, double /*v*/) { return 0; }

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
