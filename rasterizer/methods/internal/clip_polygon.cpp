// The mathematics. A plane is an affine functional d of the clip position, inside where d >= 0. On
// an edge from a (inside, d_a >= 0) to b (outside, d_b < 0) it vanishes at
//
//   p = (d_a b − d_b a) / (d_a − d_b),
//
// which serves for the position and for every parameter. The formula always takes the inside end
// first, whichever way the polygon runs, so that two triangles that share the edge get the same p,
// bit for bit. It is preferred to a + t (b − a) because on coarse grids, where the products and
// their difference are exact, it rounds only once, at the division.
//
// Afterwards one coordinate of p is recomputed from the plane's own equation, which has no
// cancellation: z for a depth plane, w for the guard band. On the guard band w may be G times
// smaller than at the ends, so the formula above would give w a relative error G times larger.

#include "rasterizer/methods/internal/clip_polygon.h"

#include <utility>

namespace rastercheck::rasterizer {
namespace {

/// Interpolates between a and b to the place where the functional is 0. If a and b are equal,
/// returns exactly that value.
double between(double a, double b, double d_a, double d_b) {
  if (a == b) return a;
  return (d_a * b - d_b * a) / (d_a - d_b);
}

ClipVertex cut(const ClipVolume& volume, const ClipVertex& a, const ClipVertex& b, double d_a,
               double d_b) {
  ClipVertex p;
  p.x = between(a.x, b.x, d_a, d_b);
  p.y = between(a.y, b.y, d_a, d_b);
  p.z = between(a.z, b.z, d_a, d_b);
  p.w = between(a.w, b.w, d_a, d_b);
  for (std::size_t i = 0; i < volume.parameter_count; ++i) {
    p.parameters[i] = between(a.parameters[i], b.parameters[i], d_a, d_b);
  }
  for (std::size_t i = 0; i < volume.distance_count; ++i) {
    p.distances[i] = between(a.distances[i], b.distances[i], d_a, d_b);
  }
  return p;
}

/// Clips by one plane. distance(vertex) is its functional; settle(p, same_w) moves a vertex p, cut
/// from an edge, exactly onto the plane; same_w is true if both ends of the edge have the same w.
template <class Distance, class Settle>
class ClipPlane {
 public:
  ClipPlane(const ClipVolume& volume, bool closed, Distance distance, Settle settle)
      : volume_(volume), closed_(closed), distance_(distance), settle_(settle) {}

  /// Leaves the result in `polygon`; `spare` is working memory.
  void clip(ClipPolygon*& polygon, ClipPolygon*& spare) const {
    if (contains(*polygon)) return;
    spare->size = 0;
    for (std::size_t i = 0; i < polygon->size; ++i) {
      const std::size_t next = i + 1 == polygon->size ? 0 : i + 1;
      clip_edge(polygon->vertices[i], polygon->vertices[next], *spare);
    }
    std::swap(polygon, spare);
  }

 private:
  bool contains(const ClipPolygon& polygon) const {
    for (std::size_t i = 0; i < polygon.size; ++i) {
      if (!(distance_(polygon.vertices[i]) >= 0)) return false;
    }
    return true;
  }

  /// Appends the vertices that the edge contributes: `a` if it is inside, and the point where the
  /// plane cuts the edge, if any.
  void clip_edge(const ClipVertex& a, const ClipVertex& b, ClipPolygon& result) const {
    const double d_a = distance_(a);
    const double d_b = distance_(b);
    if (d_a >= 0) {
      append(result, a);
      if (d_b >= 0) return;
      // Leaving: from here the plane itself is the edge.
      if (d_a > 0) append(result, settled(a, b, d_a, d_b));
      result.vertices[result.size - 1].closed = closed_;
    } else if (d_b > 0) {
      // Entering: from here the edge continues as the old edge. (If d_b = 0, only b is inside, and
      // the next edge adds b.)
      ClipVertex p = settled(b, a, d_b, d_a);
      p.closed = a.closed;
      append(result, p);
    }
  }

  ClipVertex settled(const ClipVertex& inside, const ClipVertex& outside, double d_inside,
                     double d_outside) const {
    ClipVertex p = cut(volume_, inside, outside, d_inside, d_outside);
    settle_(p, inside.w == outside.w);
    return p;
  }

  static void append(ClipPolygon& result, const ClipVertex& vertex) {
    if (result.size < ClipPolygon::kCapacity) result.vertices[result.size++] = vertex;
  }

  const ClipVolume& volume_;
  bool closed_;
  Distance distance_;
  Settle settle_;
};

/// Clips to −w <= z <= w (OpenGL) or 0 <= z <= w, boundary included.
void clip_depth(const ClipVolume& volume, ClipPolygon*& polygon, ClipPolygon*& spare) {
  // In units of w: the least depth in the clip volume.
  const double least = volume.convention == Convention::opengl ? -1.0 : 0.0;
  ClipPlane(
      volume, true, [least](const ClipVertex& p) { return p.z - least * p.w; },
      [least](ClipVertex& p, bool) { p.z = least * p.w; })
      .clip(polygon, spare);
  ClipPlane(
      volume, true, [](const ClipVertex& p) { return p.w - p.z; },
      [](ClipVertex& p, bool) { p.z = p.w; })
      .clip(polygon, spare);
}

/// Clips to distances >= 0. In D3D samples at distance 0 are inside. In the other APIs the fill
/// rule decides, so that a sample is never drawn both with a distance and with its negative.
void clip_distances(const ClipVolume& volume, ClipPolygon*& polygon, ClipPolygon*& spare) {
  for (std::size_t i = 0; i < volume.distance_count; ++i) {
    ClipPlane(
        volume, volume.convention == Convention::d3d,
        [i](const ClipVertex& p) { return p.distances[i]; },
        [i](ClipVertex& p, bool) { p.distances[i] = 0; })
        .clip(polygon, spare);
  }
}

/// Clips to −axis <= G w and axis <= G w: the guard band on both sides of the viewport.
void clip_guard_band(const ClipVolume& volume, double ClipVertex::*axis, ClipPolygon*& polygon,
                     ClipPolygon*& spare) {
  for (const double side : {-1.0, 1.0}) {
    ClipPlane(
        volume, false,
        [side, axis](const ClipVertex& p) { return kClipGuardBand * p.w - side * p.*axis; },
        [side, axis](ClipVertex& p, bool same_w) {
          if (same_w) {
            p.*axis = side * kClipGuardBand * p.w;
          } else {
            p.w = side * p.*axis / kClipGuardBand;
          }
        })
        .clip(polygon, spare);
  }
}

}  // namespace

bool clip(const ClipVolume& volume, ClipPolygon& polygon, ClipPolygon& spare) {
  ClipPolygon* current = &polygon;
  ClipPolygon* other = &spare;
  if (!volume.depth_clamp) clip_depth(volume, current, other);
  clip_distances(volume, current, other);
  clip_guard_band(volume, &ClipVertex::x, current, other);
  clip_guard_band(volume, &ClipVertex::y, current, other);
  if (current != &polygon) polygon = *current;
  if (polygon.size < 2) return false;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    // Happens only if x, y and w almost vanish together and rounding has removed the rest of w.
    if (!(polygon.vertices[i].w > 0)) return false;
  }
  return true;
}

}  // namespace rastercheck::rasterizer
