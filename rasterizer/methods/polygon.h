#pragma once

// Convex polygons of any number of sides, drawn whole by the methods that scan-convert (seed 002
// §2, §3.5), without triangles.
//
// A polygon is convex as seen from the eye: with columns (x, y, w), det(p_i, p_j, p_k) has one
// sign, or is 0, for all corners i < j < k. Where all w > 0 that is: convex in the window, its
// corners in order. It needs no w > 0, as it says the same of the rays from the eye, which lie on
// the surface of a convex cone then; w <= 0 is ordinary, as the polygon is clipped before it is
// divided by w. The corners need not lie in one plane.
//
// Values of rational-linear and its kin are those of a plane where the corners and their values lie
// in one (seed 002: where parameters are object-affine). Otherwise, as with scanline-linear, what
// is inside depends on how the polygon is turned in the window.

#include <cstddef>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Corners of a polygon, inclusive.
inline constexpr std::size_t kMaxPolygonCorners = 16;

struct PolygonVertex {
  glm::vec4 position{0, 0, 0, 1};          ///< clip space
  std::vector<float> attributes = {};      ///< as many as State::attributes
  std::vector<float> clip_distances = {};  ///< as many as State::clip_distance_count
};

/// Why a polygon was refused; nothing is drawn then.
enum class PolygonError {
  draw,                  ///< PolygonFault::refused says what
  no_polygons,           ///< a method that does not scan-convert polygons
  corner_count,          ///< fewer than 3 or more than kMaxPolygonCorners
  attribute_values,      ///< not one value for each attribute
  clip_distance_values,  ///< not one value for each distance
  not_finite,            ///< a position, an attribute or a distance
  /// An attribute that is not flat and not at samples: a centre that is not covered has no value,
  /// as no plane is known.
  location,
  degenerate,  ///< no area as seen from the eye
  not_convex,
};

/// One sentence about an error.
std::string_view to_string(PolygonError error);

struct PolygonFault {
  PolygonError error = PolygonError::draw;
  /// The first corner of which it is true, or the attribute for PolygonError::location; 0 of what
  /// is true of the whole.
  std::size_t index = 0;
  std::optional<Error> refused = {};  ///< of PolygonError::draw
};

/// Appends the fragments of one polygon by the method of this name, as those of triangle 0. The
/// provoking vertex is the first corner, of Convention::opengl the last.
std::optional<PolygonFault> draw_polygon(std::string_view method, const State& state,
                                         std::span<const PolygonVertex> polygon,
                                         const TargetSize& size, Fragments& fragments);

}  // namespace rastercheck::rasterizer
