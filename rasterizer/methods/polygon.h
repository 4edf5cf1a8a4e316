#pragma once

// Draws convex polygons without splitting them into triangles, by the methods that scan-convert
// (Heckbert & Moreton 1991, §2, §3.5).
//
// A polygon is convex as seen from the eye: with columns (x, y, w), det(p_i, p_j, p_k) has one
// sign, or is 0, for all corners i < j < k. If all w > 0 this means convex in the window, with
// corners in order. The definition does not need w > 0: in general it means that the rays from the
// eye to the corners lie, in order, on the surface of a convex cone. w <= 0 is allowed, because the
// polygon is clipped before the division by w. The corners need not lie in one plane.
//
// If the corners and their values lie in one plane (Heckbert & Moreton 1991: if parameters are
// object-affine), rational-linear and related methods compute that plane's values. Otherwise, as
// with scanline-linear, values inside depend on the polygon's rotation in the window.

#include <cstddef>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Maximum number of corners of a polygon, inclusive.
inline constexpr std::size_t kMaxPolygonCorners = 16;

struct PolygonVertex {
  glm::vec4 position{0, 0, 0, 1};          ///< clip space
  std::vector<float> attributes = {};      ///< as many as State::attributes
  std::vector<float> clip_distances = {};  ///< as many as State::clip_distance_count
};

/// Why a polygon was refused; nothing is drawn then.
enum class PolygonError {
  draw,                  ///< the draw itself was refused; see PolygonFault::refused
  no_polygons,           ///< the method does not scan-convert polygons
  corner_count,          ///< fewer than 3 or more than kMaxPolygonCorners
  attribute_values,      ///< a corner has too few or too many values of attributes
  clip_distance_values,  ///< a corner has too few or too many clip distances
  not_finite,            ///< a position, an attribute or a distance is not finite
  /// An attribute is neither flat nor evaluated at samples. A centre that the polygon does not
  /// cover would need a plane for its value, and none is known.
  location,
  degenerate,  ///< no area as seen from the eye
  not_convex,
};

/// One sentence that explains the error.
std::string_view to_string(PolygonError error);

struct PolygonFault {
  PolygonError error = PolygonError::draw;
  /// The first corner that has the error, or the attribute for PolygonError::location; 0 if the
  /// error concerns the whole polygon.
  std::size_t index = 0;
  std::optional<Error> refused = {};  ///< set for PolygonError::draw
};

/// Appends the fragments of one polygon, drawn by the named method, as those of triangle 0. The
/// provoking vertex is the first corner; with Convention::opengl the last.
std::optional<PolygonFault> draw_polygon(std::string_view method, const State& state,
                                         std::span<const PolygonVertex> polygon,
                                         const TargetSize& size, Fragments& fragments);

}  // namespace rastercheck::rasterizer
