#pragma once

// Clips a triangle, as a convex polygon, in homogeneous clip space: Sutherland and Hodgman's
// algorithm, one plane after the other.
//
// After clipping every vertex has w > 0 (unless clip() returns false), so division by w is safe.
// The planes, in order: near and far (not with depth clamp), the user's clip distances, and the
// guard band |x| <= G w, |y| <= G w, G = kClipGuardBand. The guard band does not confine the
// polygon to the viewport; samples outside the viewport are excluded later. It brings the polygon
// in front of the eye: |x| <= G w and |y| <= G w allow w = 0 only with x = y = 0, and no triangle
// with a nonzero determinant contains that point. The guard band comes last, so that a triangle
// keeps its edges if the near plane has already put it in front of the eye.
//
// A triangle that touches the volume only in one point is dropped.

#include <array>
#include <cstddef>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Guard band in half widths of the viewport: a power of two, so that testing a vertex is exact.
/// Edges within it are not moved at all; edges beyond it lose their far ends, about 500 viewports
/// away. A smaller band would move edges without need. A larger band would lose digits where edges
/// cross rows: the error of a crossing is proportional to the coordinate of the far end
/// (convex_scan.h), here at most 11 · 2^-53 · 2^10 half widths.
inline constexpr double kClipGuardBand = 1024;

struct ClipVertex {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
  std::array<double, kMaxAttributes> parameters{};
  std::array<double, kMaxClipDistances> distances{};
  /// True if samples exactly on the edge from this vertex to the next are inside whatever the fill
  /// rule, because the edge was cut by a plane whose boundary counts as inside.
  bool closed = false;
};

struct ClipPolygon {
  /// Each of the 14 planes adds at most one vertex to a convex polygon. The spare capacity is for
  /// polygons that rounding made slightly non-convex.
  static constexpr std::size_t kCapacity = 32;
  std::array<ClipVertex, kCapacity> vertices;
  std::size_t size = 0;
};

struct ClipVolume {
  Convention convention = Convention::vulkan;
  bool depth_clamp = false;
  std::size_t parameter_count = 0;
  std::size_t distance_count = 0;
};

/// Clips the polygon to the volume, boundary included; parameters are linear in clip space. `spare`
/// is working memory. Returns false if nothing is left to draw.
bool clip(const ClipVolume& volume, ClipPolygon& polygon, ClipPolygon& spare);

}  // namespace rastercheck::rasterizer
