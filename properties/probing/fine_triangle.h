#pragma once

// Triangles whose window positions are whole numbers of 2^-18 pixels ("fine units"), so that their
// edges at samples are exact in integers, and drawings of such triangles in 64×64 pixels.
//
// Once rounded to a grid of 1/12 pixel, positions are no whole numbers of fine units. A triangle
// therefore says how many units a pixel has.

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "properties/probing/subject.h"

namespace rastercheck::properties {

/// Positions in 2^-kFineBits pixels.
inline constexpr int kFineBits = 18;
/// A pixel, in fine units.
inline constexpr std::int64_t kFinePixel = std::int64_t{1} << kFineBits;
/// Width and height of the cases that show fine triangles, in pixels.
inline constexpr int kFineSide = 64;

/// The unit of positions, and each pixel's sample, from the pixel's corner of least x and y.
struct FineScale {
  std::int64_t pixel = kFinePixel;         ///< units per pixel
  std::int64_t sample_x = kFinePixel / 2;  ///< in units
  std::int64_t sample_y = kFinePixel / 2;
};
/// Returns the scale of `parts` units per fine unit; the sample is rounded to a unit.
FineScale scale_of(const cases::PixelFraction& sample, std::int64_t parts = 1);

/// Window positions, in units of the scale.
struct FineTriangle {
  std::array<std::int64_t, 3> x{};
  std::array<std::int64_t, 3> y{};
  FineScale scale;
};
/// Returns twice the area in window coordinates, with its sign.
std::int64_t area_of(const FineTriangle& triangle);

/// An edge function over samples, oriented inwards.
struct FineEdge {
  std::int64_t a = 0;  ///< change per unit of x
  std::int64_t b = 0;  ///< change per unit of y
  std::int64_t x = 0;  ///< a point on the edge, from the first pixel's sample
  std::int64_t y = 0;
  std::int64_t pixel = kFinePixel;  ///< units per pixel
  std::int64_t at(int pixel_x, int pixel_y) const {
    return a * (pixel_x * pixel - x) + b * (pixel_y * pixel - y);
  }
  /// The distance by which the edge must move along both axes to reach a sample, in pixels, with
  /// the sign of at(); 0 for an edge without length.
  double distance(int pixel_x, int pixel_y) const;
};
/// Edge i runs from vertex i to vertex i + 1.
using FineEdges = std::array<FineEdge, 3>;
FineEdges edges_of(const FineTriangle& triangle);

/// Returns how far inside the triangle a sample lies, as the least distance of an edge; negative
/// outside.
double depth_inside(const FineEdges& edges, int x, int y);

/// The columns or lines of pixels whose samples may be inside: begin and end.
std::pair<int, int> columns_of(const FineTriangle& triangle);
std::pair<int, int> lines_of(const FineTriangle& triangle);

/// A sample's place relative to a triangle's edges.
struct FinePlace {
  bool is_inside = false;     ///< inside or on every edge
  int zero_edges = 0;         ///< number of edges through the sample
  std::int64_t normal_x = 0;  ///< inward normal of the last zero edge
  std::int64_t normal_y = 0;
};
FinePlace place_in(const FineTriangle& triangle, int x, int y);

/// Samples of a 64×64 case: bit x of row y.
using FineRows = std::array<std::uint64_t, kFineSide>;

inline bool has(const FineRows& rows, int x, int y) {
  return ((rows[static_cast<std::size_t>(y)] >> static_cast<unsigned>(x)) & 1U) != 0;
}
/// True if no sample is set.
bool is_empty(const FineRows& rows);

/// Drawings whose positions are known in fine units.
struct FineDrawing {
  std::vector<FineTriangle> triangles;
  std::vector<FineRows> rows;  ///< [triangle] the samples drawn
  DrawnCase drawn;
};

/// Moves a triangle by as much as the backend's samples lie off the centres of pixels, rounded to a
/// fine unit.
FineTriangle about_samples(const Subject& subject, FineTriangle triangle);

/// Draws the triangles in a 64×64 case; empty if the backend does not draw it.
std::optional<FineDrawing> draw_fine(Subject& subject, const std::vector<FineTriangle>& triangles);

/// Draws a 64×64 case that shows these triangles in this order.
std::optional<FineDrawing> draw_fine(Subject& subject, std::vector<FineTriangle> triangles,
                                     cases::Case source);

/// Returns the clip position of a window position in fine units in a base() case.
cases::ClipVertex fine_vertex(const cases::Case& c, std::int64_t x, std::int64_t y, float depth);

}  // namespace rastercheck::properties
