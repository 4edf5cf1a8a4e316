#pragma once

// One triangle, line or point of a scene, prepared for questions about its samples. What is said of
// three vertices is true of lines and points as well, whose last vertex is there more than once
// (cases::Triangle); what is said of edges and orientations is not (primitive_coverage.h).

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cases/case.h"
#include "oracle/internal/convex_region.h"
#include "oracle/internal/depth_offset.h"
#include "oracle/internal/projective_map.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/snapping.h"

namespace rastercheck::oracle {

/// A clip plane as a functional of window positions. A point is inside iff line >= 0; if a zero
/// counts as a tie, the line's normal decides.
struct ClipFunctional {
  Line line;
  /// The line with every point's distance increased (`outer`) or decreased (`inner`) by the largest
  /// error that the contract allows (cases::Contract::clip_error).
  Line outer;
  Line inner;
  bool zero_is_tie =
      false;  ///< true for user clip distances, except under D3D; a zero on a depth plane is inside
  bool is_user_distance = false;
  bool is_violated = false;  ///< some vertex lies beyond the plane
};

/// The kind of triangle that a contract draws (RULES §3).
enum class Shape {
  exact,   ///< the mathematical triangle
  placed,  ///< the triangle of the snapped vertices, none of which is clipped
  /// A snapped triangle with new vertices where clip planes cut it, or a triangle drawn under any
  /// of several viewports. It is known only to within a tolerance.
  cut,
};

/// The most placements that are enumerated: three candidates per axis and vertex give 729.
inline constexpr long kMostPlacements = 729;

/// The points at which the vertices of a triangle of shape placed may be placed.
struct Placements {
  /// If false, `points` has only the extreme placements, because there are more combinations than
  /// kMostPlacements, or because vertices need not be on grid points.
  bool are_all = true;
  std::array<std::vector<std::array<double, 2>>, 3> points;
  /// The orientation of each combination: −1, 0 or 1; vertex 2 varies fastest, then vertex 1.
  std::vector<int> orientations;
};

class DiamondLine;

struct TriangleSetup {
  /// `triangle` is an index into the case's triangles.
  TriangleSetup(const Scene& scene, std::size_t triangle);

  const Scene* scene;
  std::size_t index;  ///< into the case's triangles
  /// If no promise is made, shape is `exact` and only `ideal` is set up.
  cases::TrianglePromise promise;
  /// True if the contract lets the triangle be missing (Contract::least_area). What is required
  /// otherwise is permitted then.
  bool may_be_left_out = false;
  /// True if the contract has the triangle left out instead of clipped.
  bool is_left_out = false;
  cases::Triangle indices;
  std::array<RingVector3, 3> columns;  ///< (X, Y, w) of each vertex
  ProjectiveMap ideal;                 ///< the map of the exact positions
  /// The map of a triangle, line or point with these columns.
  ProjectiveMap map_of(const std::array<RingVector3, 3>& at) const;
  bool is_triangle() const { return scene->source().primitive == cases::Primitive::triangles; }
  /// The width of lines or the size of points, in window units.
  Ring primitive_size() const;
  /// True if some clip plane or clip distance affects coverage: a vertex lies beyond it or, for a
  /// user clip distance, on it, so that a tie is possible. If false, all planes and distances are
  /// positive wherever no edge function is negative.
  bool is_cut_by_planes = false;
  /// The functionals of all clip planes and clip distances; made when first asked for.
  const std::vector<ClipFunctional>& clip_functionals() const;
  /// The values, at the vertices and times w, of the functionals of all clip planes and clip
  /// distances, in the same order.
  std::vector<std::array<Ring, 3>> clip_values() const;
  /// True if some vertex lies beyond a clip plane or clip distance.
  bool has_clipped_vertex = false;
  Shape shape = Shape::exact;
  /// The vertices beyond a clip plane or clip distance; in shapes placed and cut also those behind
  /// the eye or beyond the guard band.
  std::array<bool, 3> is_clipped{};

  /// Shapes placed and cut: true if no vertex lies beyond a clip plane or clip distance, behind the
  /// eye or beyond the guard band. `is_clipped` cannot tell, because its three members are true if
  /// the viewport is open.
  bool is_whole = true;

  /// Shapes placed and cut: the grid points of each vertex that is not clipped.
  std::array<std::optional<SnappedVertex>, 3> snapped;
  /// Shape placed: the number of extreme placements (at most 64); 1 if only one placement exists.
  /// 0 for other shapes.
  std::size_t corner_count() const { return corner_count_; }
  /// Shape placed: the map of an extreme placement, made when first asked for. The first few move
  /// all vertices the same way, so their values differ most.
  const ProjectiveMap& corner(std::size_t number) const;
  /// Shape placed: found when first asked for.
  const Placements& placements() const;
  /// Shape placed with one placement: the columns of the vertices there.
  std::array<RingVector3, 3> placed_columns_of_all() const;
  /// One of Bresenham's lines, made when first asked for (diamond_line.h).
  const DiamondLine& diamond_line() const;

  /// Shape cut: the largest error of a cut boundary, per axis, in window units.
  Ring tolerance;
  /// Shapes placed and cut: the largest move of any vertex, per axis, in window units. Of a line of
  /// shape cut: of any point that it covers (moved_line_reach() in primitive_setup.cpp).
  Ring reach;
  /// Shape cut: the part of `reach` by which each vertex may move on its own. The rest comes from
  /// the viewport and is the same for all vertices.
  Ring moved_alone;
  /// Shapes placed and cut: the largest change of E_i when a point moves by `reach` along both
  /// axes, reach · (|A_i| + |B_i|). A point deeper than this inside every edge is inside for every
  /// placement of the vertices, and the vertices keep their orientation around it. A point farther
  /// than this outside some edge is outside.
  std::array<Ring, 3> edge_bands;
  /// True if samples near the viewport's sides may be missing, or samples beyond the sides may be
  /// drawn, and some sample may be that close to a side.
  bool has_open_sides = false;
  /// How near to a side of the viewport inner samples may be missing, and how far beyond it outer
  /// samples may be drawn, in window units.
  Ring side_reach;
  bool has_nonpositive_w = false;
  /// Shape cut: no point of the polygon is farther than `reach` from all its sides, so moving its
  /// corners may turn it round.
  bool may_turn = false;

  /// An edge with two snapped ends, for one pair of their candidates. `is_turned`: some other
  /// corner of the clipped polygon may come to lie on the edge or beyond, so that the edge's sides
  /// say nothing about the polygon.
  struct SnappedEdge {
    Line line;
    bool is_turned = false;
  };
  /// Shape cut: the edge opposite vertex `edge`, for all pairs of candidates of its two ends or, if
  /// these are more than kMostPlacements, for the extreme pairs. The ends must not be clipped.
  const std::vector<SnappedEdge>& snapped_edge(std::size_t edge) const;

  /// True if the triangle's orientation is certain: no vertex is clipped, and all placements have
  /// the same orientation.
  bool has_certain_orientation() const;

  /// The range of the exact vertex positions along an axis (0: u, 1: v), in window units, widened
  /// by `reach`. Only if all w > 0.
  FieldRange extent(Eigen::Index axis) const;

  /// The vertices' w and window positions in doubles, each within 2^-48 relative; only if all w >
  /// 0.
  struct NearPositions {
    std::array<double, 3> w;
    std::array<double, 3> u;
    std::array<double, 3> v;
  };
  const NearPositions& near_positions() const;

  /// The map that the contract's basis evaluates; nullptr if the contract allows several.
  const ProjectiveMap* value_map() const;

  /// The offsets of the case's depth bias, found when first asked for. Empty if the case has none
  /// or nothing bounds them.
  const std::optional<DepthOffset>& depth_offset() const;
  /// True if the case has a bias and nothing bounds what it adds.
  bool has_unbounded_depths() const { return scene->has_depth_bias() && !depth_offset(); }

  /// A box of pixels that contains all required or permitted samples; may be larger than necessary.
  PixelBox pixels() const;

  /// The places in the requested viewport that an open viewport may show at p, limited to places
  /// that moved vertices may cover. They may lie outside the ideal triangle.
  ConvexRegion shown_at(const Point& p) const;

  /// `region` cut down to the closed ideal triangle and its clip functionals.
  ConvexRegion clipped_to_triangle(ConvexRegion region) const;

 private:
  /// Calls `take(values, zero_is_tie, is_user_distance)` for each functional, with its values times
  /// w at the vertices.
  template <typename Take>
  void for_each_clip_plane(const Take& take) const;
  Ring clip_size(const std::array<Ring, 3>& distances, bool is_user_distance) const;
  Line widened(const Line& line, const Ring& more) const;
  PixelBox pixels_of_clipped(const PixelBox& all, const Ring& moved) const;
  PixelBox pixels_of_primitive() const;
  void set_up_clipping();
  void set_up_leaving_out();
  bool has_less_area_than(double area) const;
  void set_up_snapping(const cases::Snapping& snapping);
  void set_up_snapped_primitive(const cases::Snapping& snapping);
  bool is_surely_unclipped() const;
  std::optional<Ring> reach_of_line(double vertex_reach) const;
  void open_viewport();
  bool has_points_deeper_than(const Ring& distance) const;
  bool is_beyond_guard_band(std::size_t vertex) const;
  /// The corners of the clipped triangle within the guard band, except the ends of the edge.
  std::vector<HomogeneousPoint> corners_beside(std::size_t edge) const;

  std::size_t corner_count_ = 0;
  mutable std::optional<NearPositions> near_positions_;
  mutable std::optional<std::optional<DepthOffset>> depth_offset_;
  mutable std::optional<std::vector<ClipFunctional>> clip_functionals_;
  // Doubles answer for most triangles without any corner, and 64 maps take 100 KB.
  mutable std::array<std::vector<RingVector3>, 3>
      extreme_columns_;  ///< of each vertex, by corner()
  mutable std::vector<std::unique_ptr<const ProjectiveMap>> corners_;
  mutable std::optional<Placements> placements_;
  mutable std::array<std::optional<std::vector<SnappedEdge>>, 3> snapped_edges_;
  mutable std::shared_ptr<const DiamondLine> diamond_line_;
};

/// The closed square of half-width `reach` around a point.
ConvexRegion box_around(const Point& p, const Ring& reach);
/// The box of Scene::guard_band_lo() and guard_band_hi().
ConvexRegion guard_band_of(const Scene& scene);

}  // namespace rastercheck::oracle
