#pragma once

// Clipping a triangle, as a convex polygon, in homogeneous clip space: Sutherland and Hodgman's
// algorithm, one plane after the other.
//
// After it every vertex has w > 0 (clip() says where not), so that it may be divided by. The
// planes, in this order: near and far (not with depth clamp), the user's clip distances, and the
// guard band |x| <= G w, |y| <= G w, G = kClipGuardBand. The guard band is not there to bring the
// polygon into the viewport, which is done per sample, but to bring it in front of the eye: |x| <=
// G w and |y| <= G w leave w = 0 to x = y = 0 only, which no triangle with a determinant other than
// zero contains. It comes last, so that a triangle that the near plane already put in front of the
// eye keeps its edges.
//
// What it does not do: keep a triangle that only touches a clip plane in one point.

#include <array>
#include <cstddef>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Half widths of the viewport, a power of two so that testing a vertex rounds nothing. Edges that
/// stay below it are not moved at all; beyond it their far ends are cut off, a thousand viewports
/// away. Less would move edges without need. More would lose digits at the crossings with the rows:
/// their rounding is relative to the far end (convex_scan.h), here 11 · 2^-53 · 2^10 half widths.
inline constexpr double kClipGuardBand = 1024;

struct ClipVertex {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
  std::array<double, kMaxAttributes> parameters{};
  std::array<double, kMaxClipDistances> distances{};
  /// Whether samples exactly on the edge from here to the next vertex are inside whatever the fill
  /// rule says: so it is where the edge was cut by a plane whose boundary belongs to the inside.
  bool closed = false;
};

struct ClipPolygon {
  /// Each of the 14 planes adds at most one vertex to a convex polygon's; the rest is for polygons
  /// that rounding has left not quite convex.
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

/// The part of the polygon within the volume, boundary included, its parameters linear in clip
/// space. `spare` is working memory. False where nothing is left to draw.
bool clip(const ClipVolume& volume, ClipPolygon& polygon, ClipPolygon& spare);

}  // namespace rastercheck::rasterizer
