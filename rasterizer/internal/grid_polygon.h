#pragma once

// What snapped coverage draws of a triangle: a polygon whose corners lie on the grid. It is the
// triangle of the snapped vertices where no vertex is clipped. Otherwise clip planes cut it, and
// its new corners are snapped as vertices are.
//
// Clipping. A plane has the values g_i at the vertices: depth planes, user distances, and the four
// sides of the guard band, G w ∓ X and G w ∓ Y. Only planes that some vertex lies beyond can cut. A
// corner is an original vertex, or lies on an edge and a plane, or on two planes; whichever, it is
// computed from the vertices alone, as weights β (on an edge |g_k| and |g_j|, on two planes the
// cross product of their values), and never from other new corners. All signs are exact.
//
// Neighbours. Where an edge is cut depends on its two ends, the planes' values there and nothing
// else, and the arithmetic goes through the ends in an order of their own, so that the triangle on
// the other side has the very same corners. A new corner is rounded from a quotient of two sums
// that are exact but for one rounding each: within 1/2 + 2^-18 grid units of where it belongs.
//
// The eye. The guard band's planes leave w > 0: X and Y are within G w of 0 on what is kept, and a
// corner with w = 0 would make the triangle one that is seen edge-on; such a one is not drawn.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "rasterizer/internal/grid_position.h"

namespace rastercheck::rasterizer {

struct GridCorner {
  GridPoint at;
  double w = 0;                   ///< > 0, to a relative 2^-50
  double z = 0;                   ///< likewise
  std::array<double, 3> share{};  ///< of the triangle's vertices in clip space; sum to 1
  bool is_new = false;            ///< made by clipping, no vertex, even where a share rounds to 1
};

struct GridPolygon {
  std::vector<GridCorner> corners;  ///< in the order of the triangle's vertices; none: not drawn
  bool is_cut = false;
  /// Of a polygon that is cut where its corners belong, pixels: before they were put on the grid.
  std::vector<glm::dvec2> window;
};

/// `distances[i]` are vertex i's clip distances. All numbers are finite.
void grid_polygon(const State& state, const Grid& grid, const std::array<glm::vec4, 3>& positions,
                  const std::array<std::span<const float>, 3>& distances, GridPolygon& out);

}  // namespace rastercheck::rasterizer
