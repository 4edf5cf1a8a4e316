#pragma once

// One triangle of a scene, prepared for questions about its samples.

#include <array>
#include <optional>
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
  bool zero_is_tie = false;  ///< a user clip distance; D3D and the depth planes take zero inside
  bool is_user_distance = false;
  bool is_violated = false;  ///< some vertex lies beyond it
};

/// Which triangle a contract draws (RULES §3).
enum class Shape {
  exact,   ///< the mathematical one
  placed,  ///< that of the snapped vertices, none of which is clipped
  cut,     ///< snapped, with new vertices where clip planes cut it: known to within a tolerance
};

/// More placements than this are not enumerated: three candidates per axis and vertex give 729.
inline constexpr long kMostPlacements = 729;

struct TriangleSetup {
  TriangleSetup(const Scene& scene, const cases::Triangle& indices);

  const Scene* scene;
  cases::Triangle indices;
  std::array<RingVector3, 3> columns;  ///< (X, Y, w) of each vertex
  ProjectiveMap ideal;                 ///< the map of the exact positions
  std::vector<ClipFunctional> clip_functionals;
  Shape shape = Shape::exact;
  std::array<bool, 3> is_clipped{};

  /// Shape placed and cut: the grid points of each vertex that is not clipped.
  std::array<std::optional<SnappedVertex>, 3> snapped;
  /// Shape placed: the maps of the extreme placements (at most 64); one where there is one
  /// placement.
  std::vector<ProjectiveMap> corner_placements;
  /// Shape placed: the maps of all placements, made when first asked for; nullptr where they are
  /// more than kMostPlacements.
  const std::vector<ProjectiveMap>* placements() const;

  /// Shape cut: how far a boundary that was cut may be off, per axis, in pixels.
  Ring tolerance;
  /// Shape placed and cut: how far any vertex may have been moved, per axis, in pixels.
  Field reach;
  bool has_nonpositive_w = false;
  /// Shape cut: no point of the polygon is farther than `reach` from all its sides, so that moving
  /// its corners may turn it round.
  bool may_turn = false;

  /// The least and the greatest of the exact vertex positions along an axis (0: u, 1: v), in
  /// pixels, widened by `reach`. Only where all w > 0.
  FieldRange extent(Eigen::Index axis) const;

  /// The pixels whose samples may be required or permitted; all others are forbidden.
  PixelBox pixels() const;

  /// `region` cut down to the closed ideal triangle and its clip functionals.
  ConvexRegion clipped_to_triangle(ConvexRegion region) const;

 private:
  void set_up_clipping();
  void set_up_snapping(const cases::Snapping& snapping);
  bool is_deeper_than_reach() const;
  std::vector<ProjectiveMap> placed(bool corners_only) const;

  mutable std::optional<std::vector<ProjectiveMap>> placements_;
  bool is_vertex_clipped(std::size_t corner) const;
};

/// The closed square of half-width `reach` around a point.
ConvexRegion box_around(const Point& p, const Field& reach);

}  // namespace rastercheck::oracle
