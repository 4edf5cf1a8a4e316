#pragma once

// One triangle of a scene, prepared for questions about its samples.

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "cases/case.h"
#include "oracle/internal/convex_region.h"
#include "oracle/internal/projective_map.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/snapping.h"

namespace rastercheck::oracle {

/// A clip plane as a functional of window positions: inside iff line >= 0, or, of a zero that is a
/// tie, as its normal decides.
struct ClipFunctional {
  Line line;
  /// The same where every point's distance is as far off as the contract lets it be
  /// (cases::Contract::clip_error), outwards and inwards.
  Line outer;
  Line inner;
  bool zero_is_tie = false;  ///< a user clip distance; D3D and the depth planes take zero inside
  bool is_user_distance = false;
  bool is_violated = false;  ///< some vertex lies beyond it
};

/// Which triangle a contract draws (RULES §3).
enum class Shape {
  exact,   ///< the mathematical one
  placed,  ///< that of the snapped vertices, none of which is clipped
  /// Snapped, with new vertices where clip planes cut it, or drawn by any of several viewports:
  /// known to within a tolerance.
  cut,
};

/// More placements than this are not enumerated: three candidates per axis and vertex give 729.
inline constexpr long kMostPlacements = 729;

/// The points that the vertices of a triangle of shape placed may be placed on.
struct Placements {
  /// Else these are the extreme ones only: there are more combinations than kMostPlacements, or
  /// vertices need not be on grid points.
  bool are_all = true;
  std::array<std::vector<std::array<double, 2>>, 3> points;
  /// Which way each combination turns: −1, 0 or 1; vertex 2 counts fastest, then 1.
  std::vector<int> orientations;
};

struct TriangleSetup {
  /// `triangle` is an index into the case's.
  TriangleSetup(const Scene& scene, std::size_t triangle);

  const Scene* scene;
  std::size_t index;  ///< into the case's triangles
  /// Where it is not made, shape is `exact`, and nothing is set up but `ideal`.
  cases::TrianglePromise promise;
  cases::Triangle indices;
  std::array<RingVector3, 3> columns;  ///< (X, Y, w) of each vertex
  ProjectiveMap ideal;                 ///< the map of the exact positions
  /// Whether some clip plane or clip distance has a say in coverage: a vertex lies beyond it, or,
  /// of a user clip distance, on it, so that a tie is possible. All others are positive wherever
  /// the edges are not negative.
  bool is_cut_by_planes = false;
  /// Of all clip planes and clip distances; made when first asked for.
  const std::vector<ClipFunctional>& clip_functionals() const;
  /// Whether some vertex lies beyond a clip plane or clip distance.
  bool has_clipped_vertex = false;
  Shape shape = Shape::exact;
  /// The vertices that lie beyond a clip plane or clip distance; and, in shapes placed and cut,
  /// behind the eye or beyond the guard band.
  std::array<bool, 3> is_clipped{};

  /// Shapes placed and cut: whether no vertex is clipped for a reason of its own. With an open
  /// viewport all of `is_clipped` are set.
  bool is_whole = true;

  /// Shape placed and cut: the grid points of each vertex that is not clipped.
  std::array<std::optional<SnappedVertex>, 3> snapped;
  /// Shape placed: how many extreme placements there are (at most 64); one where there is one
  /// placement.
  std::size_t corner_count() const;
  /// Shape placed: the map of an extreme placement, made when first asked for. The first few are
  /// those that move all vertices the same way, so that among them values differ most.
  const ProjectiveMap& corner(std::size_t number) const;
  /// Shape placed: found when first asked for.
  const Placements& placements() const;

  /// Shape cut: how far a boundary that was cut may be off, per axis, in pixels.
  Ring tolerance;
  /// Shape placed and cut: how far any vertex may have been moved, per axis, in pixels.
  Ring reach;
  /// Shape cut: the part of `reach` that is each vertex's own. The rest is the viewport's, and the
  /// same for all.
  Ring moved_alone;
  /// Shape placed and cut: E_i changes by at most this where a point moves by `reach` along both
  /// axes: reach · (|A_i| + |B_i|). A point that is deeper inside every edge is inside however the
  /// vertices are placed, and they run round it the same way; one that is farther outside some edge
  /// is outside.
  std::array<Ring, 3> edge_bands;
  /// Whether samples near the viewport's sides may be missing, so near that there may be some, or
  /// drawn beyond them.
  bool has_open_sides = false;
  /// How near, in pixels.
  Ring side_reach;
  bool has_nonpositive_w = false;
  /// Shape cut: no point of the polygon is farther than `reach` from all its sides, so that moving
  /// its corners may turn it round.
  bool may_turn = false;

  /// An edge both of whose ends are snapped, as one pair of their candidates has it. `is_turned`:
  /// some other corner of the clipped polygon may come to lie on it or beyond, so that its sides
  /// say nothing of the polygon.
  struct SnappedEdge {
    Line line;
    bool is_turned = false;
  };
  /// Shape cut: the edge opposite a vertex, whose ends are not clipped, for all pairs of candidates
  /// or, where they are more than kMostPlacements, the extreme ones.
  const std::vector<SnappedEdge>& snapped_edge(std::size_t edge) const;

  /// Whether the contract leaves no doubt which way the triangle turns: no vertex is clipped, and
  /// all placements turn the same way.
  bool has_certain_orientation() const;

  /// The least and the greatest of the exact vertex positions along an axis (0: u, 1: v), in
  /// pixels, widened by `reach`. Only where all w > 0.
  FieldRange extent(Eigen::Index axis) const;

  /// The vertices' w and window positions in doubles, each within 2^-48 of itself; only where all
  /// w > 0.
  struct NearPositions {
    std::array<double, 3> w;
    std::array<double, 3> u;
    std::array<double, 3> v;
  };
  const NearPositions& near_positions() const;

  /// The map that the contract's basis evaluates; nullptr where it leaves several.
  const ProjectiveMap* value_map() const;

  /// A box of pixels that holds all whose samples may be required or permitted; it may hold others
  /// at its sides.
  PixelBox pixels() const;

  /// The places of the viewport that was asked for which an open one may show at p, as far as moved
  /// vertices may cover them; they may lie outside the ideal triangle.
  ConvexRegion shown_at(const Point& p) const;

  /// `region` cut down to the closed ideal triangle and its clip functionals.
  ConvexRegion clipped_to_triangle(ConvexRegion region) const;

 private:
  /// Calls `take(values, zero_is_tie, is_user_distance)` with a functional's values, times w, at
  /// the vertices.
  template <typename Take>
  void for_each_clip_plane(const Take& take) const;
  Ring clip_size(const std::array<Ring, 3>& distances, bool is_user_distance) const;
  Line widened(const Line& line, const Ring& more) const;
  PixelBox pixels_of_clipped(const PixelBox& all) const;
  void set_up_clipping();
  void set_up_snapping(const cases::Snapping& snapping);
  void open_viewport();
  bool has_points_deeper_than(const Ring& distance) const;
  bool is_beyond_guard_band(std::size_t vertex) const;
  /// The corners of the clipped triangle within the guard band, without the ends of an edge.
  std::vector<HomogeneousPoint> corners_beside(std::size_t edge) const;

  std::array<std::vector<RingVector3>, 3> extreme_columns_;
  mutable std::optional<NearPositions> near_positions_;
  mutable std::optional<std::vector<ClipFunctional>> clip_functionals_;
  mutable std::vector<std::optional<ProjectiveMap>> corners_;
  mutable std::optional<Placements> placements_;
  mutable std::array<std::optional<std::vector<SnappedEdge>>, 3> snapped_edges_;
};

/// The closed square of half-width `reach` around a point.
ConvexRegion box_around(const Point& p, const Ring& reach);
/// Corners of the closed box in which a contract leaves vertices unclipped: its guard band, and the
/// viewport wherever that lies, as its sides clip nothing within it.
std::pair<Point, Point> guard_band_box(const Scene& scene);
ConvexRegion guard_band_of(const Scene& scene);

}  // namespace rastercheck::oracle
