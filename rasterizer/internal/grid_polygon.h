#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The polygon, with corners on the grid, that snapped coverage draws for a triangle. If no vertex
// is clipped, it is the triangle of the snapped vertices. Otherwise clip planes cut the triangle,
// and new corners are snapped like vertices.
//
// Clipping. A plane has the values g_i at the vertices. The planes are the depth planes, the user
// distances, and the four sides of the guard band, G w ∓ X and G w ∓ Y. Only planes with some
// vertex beyond them can cut. A corner is an original vertex, or lies on an edge and a plane, or on
// two planes. In each case the corner is computed from the vertices alone, with weights β (on an
// edge, |g_k| and |g_j|; on two planes, the cross product of their values), and never from other
// new corners. All signs are exact.
//
// Neighbours. The cut of an edge depends only on its two ends and the planes' values there. The
// arithmetic takes the ends in a canonical order, so the triangle on the other side gets identical
// corners. A new corner is rounded from a quotient of two sums, each exact but for one rounding, so
// the corner is within 1/2 + 2^-18 grid units of its true place.
//
// The eye. The guard band's planes leave only w > 0: X and Y are within G w of 0 on the kept part,
// so w >= 0; a corner with w = 0 would mean a triangle seen edge-on, which is not drawn.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "rasterizer/internal/grid_position.h"

namespace rastercheck::rasterizer {

struct GridCorner {
  GridPoint at;
  double w = 0;                   ///< > 0, with a relative error of 2^-50
  double z = 0;                   ///< with a relative error of 2^-50
  std::array<double, 3> share{};  ///< weights of the triangle's vertices in clip space; sum to 1
  bool is_new = false;            ///< made by clipping: not a vertex, even if a share rounds to 1
};

struct GridPolygon {
  std::vector<GridCorner> corners;  ///< in the order of the triangle's vertices; empty: not drawn
  bool is_cut = false;
  /// If the polygon is cut, its corners before snapping, in pixels.
  std::vector<glm::dvec2> window;
};

/// Computes the polygon. `distances[i]` are vertex i's clip distances. All numbers must be finite.
void grid_polygon(const State& state, const Grid& grid, const std::array<glm::vec4, 3>& positions,
                  const std::array<std::span<const float>, 3>& distances, GridPolygon& out);

}  // namespace rastercheck::rasterizer
