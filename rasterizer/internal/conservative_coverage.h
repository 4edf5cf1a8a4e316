#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Conservative coverage of the mathematical triangle (Conservative in rasterizer.h), pixel by
// pixel, as exact arithmetic decides.
//
// Inner. A pixel lies in the triangle iff each edge, and each functional that may cut it, is >= 0
// at all corners of the pixel; for an edge, at the corner where it is least.
//
// Outer, uncut. The visible triangle T is convex and closed, with an area; it is the convex hull of
// its corners with w > 0 and, if some w <= 0, of the directions in which it reaches infinity: for
// w_a > 0 >= w_b, along a to b, (x_b w_a − x_a w_b, y_b w_a − y_a w_b) w.r.t. NDC. The open square
// S of a pixel misses T iff a normal of a side of either separates the two (the sides of their
// Minkowski difference have no other normals):
//
//   edges of T   E_i > 0 nowhere in S: E_i <= 0 at the corner of S where it is greatest
//   sides of S   i + 1 <= least u of T, or greatest u of T <= i; likewise v
//
// So S meets T iff all E_i are positive at their greatest corners, and pixel i is one from
// ⌊least u⌋ to ⌈greatest u⌉ − 1.
//
// Outer, cut. Where a clip plane, or a side of the viewport that is no pixel's border, may cut the
// part of T in a pixel, and for triangles without area, PixelCut decides (pixel_cut.h).
//
// Error at corners, with u = 2^-53 and S_i of edge_functions.h. The frame's bounds hold for the
// corners of pixels, too, which the ends of its pixel ranges are. A row's E_i is evaluated at the
// left corners; the right ones add a_i dU to the row, dU = 2 scale, |dU| <= 2 U_max. First-order
// errors: 3u S for coefficients (the one of a_i dU is 2u S), 3u S for products, u S for b V + c T,
// 3u S for adding a_i dU, 4u S for adding a_i U: together 14u S. The errors of U and V enter once.
// So twice the band bounds the error. If a band is 0, all terms are multiples of one power of two,
// and their sums stay below 4 S, which needs no more than 53 bits (is_exact() in
// edge_functions.cpp): nothing is rounded here either.

#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/clip_functionals.h"
#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/edge_functions.h"
#include "rasterizer/internal/pixel_cut.h"

namespace rastercheck::rasterizer {

/// A coverage mode (coverage.h) that always draws a triangle as one part.
class ConservativeCoverage {
 public:
  static constexpr bool kLeavesWeights = false;

  explicit ConservativeCoverage(const DrawSetting& setting)
      : setting_(setting),
        is_outer_(setting.state.conservative == Conservative::outer),
        cut_(setting) {}

  Fate locate(const InputTriangle& triangle);
  Fate set_up(const InputTriangle& triangle, std::vector<DrawnPart>& parts);
  const PixelBox& box() const { return box_; }
  PixelRange span(std::size_t sample, int y) const;
  /// All samples of a covered pixel are covered, so the answer is kept for the next sample.
  CoveredBlock cover(std::size_t sample, int y, int first, int count, BlockWeights& weights);
  static Mask part_mask(const CoveredBlock& block, std::size_t /*part*/) { return block.covered; }
  static std::size_t part_at(double /*u*/, double /*v*/) { return 0; }
  /// Triangles without area count as back faces, as they do for culling.
  bool is_front() const {
    return !is_flat_ && is_front_face(setting_.state, setting_.frame.displayed(turn_));
  }
  static const GridPolygon* polygon() { return nullptr; }
  static PieceCorners corners_at(double /*u*/, double /*v*/) { return {}; }

 private:
  /// The corner of a pixel where an edge decides: its greatest for outer, its least for inner.
  struct DecisiveCorner {
    int x = 0;  ///< 0: the pixel's left corner, 1: the right one
    int y = 0;
    double step = 0;  ///< added to the row for x = 1
  };

  void find_box(const InputTriangle& triangle);
  void set_corners();
  double row_of(std::size_t edge, int y) const;
  Mask pixels_of_edges(int y, int first, int count, BlockWeights& weights) const;
  bool is_on_the_right_side(std::size_t edge, int x, int y) const;
  bool is_visible(int x, int y);
  bool is_inside_planes(int x, int y) const;
  int side_of_plane(const ClipFunctional& functional, int x, int y) const;
  Mask pixels_at_vertices(std::size_t sample, int y, int first) const;

  const DrawSetting& setting_;
  bool is_outer_;
  PixelCut cut_;
  bool is_cut_set_up_ = false;
  bool can_meet_ = true;  ///< PixelCut::set_up()
  std::array<glm::vec4, 3> positions_;
  bool is_flat_ = false;  ///< the triangle has no area
  int turn_ = 0;          ///< the orientation in clip space
  EdgeFunctions edges_;
  std::array<DecisiveCorner, 3> decisive_;
  ClipFunctionals clips_;  ///< those with a negative distance
  PixelBox box_;
  /// A window coordinate of a vertex, within `error` of the exact one.
  struct NearPosition {
    double at = 0;
    double error = 0;
  };
  /// The visible vertices.
  std::array<std::array<NearPosition, 2>, 3> vertices_{};
  std::size_t vertex_count_ = 0;
  // The last answer.
  int y_ = -1;
  int first_ = 0;
  int count_ = 0;
  Mask covered_ = 0;
};

}  // namespace rastercheck::rasterizer
