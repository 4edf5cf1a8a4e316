#pragma once

// Triangles whose coverage depends on the last bits of floats: with an edge through a sample or
// next to it, as thin as the spacing of floats, or in a plane through the eye or next to it.
// ray_through() must be exact for the viewport.

#include <array>
#include <span>

#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

using Corners = std::array<cases::ClipVertex, 3>;
using Distances = std::array<float, 3>;  ///< one per corner; used if the case has clip distances

/// Adds a triangle, starting with a random corner, and its clip distances if the case has any.
void add_with_distances(Draw& draw, cases::Case& c, const Corners& corners,
                        const Distances& distances);

/// Gives all corners about the same z/w, so that no depth plane cuts the triangle unless its
/// determinant is close to 0.
void set_level_depths(Draw& draw, const cases::Case& c, Corners& corners);

/// Gives all corners the same z/w; exact if w has at most 23 bits.
void set_exact_depths(Draw& draw, Corners& corners);

/// A range of powers of two, both ends included.
struct Exponents {
  int least = 0;
  int most = 0;
};
inline constexpr Exponents kTiny{-58, -18};

/// Returns a tiny number to replace 0. Its last bits are lost if a double adds it to the other
/// numbers.
float tiny_float(Draw& draw);

/// Moves one of the numbers by one float, or replaces zeros by tiny numbers, or changes nothing, so
/// that exact cases stay exact.
void nudge_any(Draw& draw, std::span<float* const> numbers);

/// Returns a whole number of up to 4, 10 or 16 bits by which to multiply a sample's homogeneous
/// position before it is split. If the factor has few bits, exact parts of about the same size
/// exist.
double short_factor(Draw& draw);

/// Adds a triangle with an edge through a sample or next to it. One end's coordinates may be tiny,
/// so that the edge's coefficients need more than 53 bits. w may have either sign.
void add_close_edge(Draw& draw, cases::Case& c);

/// Adds a triangle as thin as the spacing of floats, with a sample strictly inside, at weights 1 :
/// 1 : 1. Two corners appear at points that differ only in x or in y: the clip coordinate is t and
/// −t, with an exponent of t from `thickness`. The third corner is the sample's homogeneous
/// position, times a factor, minus the other two corners. At the sample, values are means of the
/// corners' values, but arithmetic in double cannot show this.
void add_needle(Draw& draw, cases::Case& c, const Exponents& thickness = kTiny);

/// Adds three corners in one plane with the eye: the third is m a + n b with small integers m and
/// n. If both are negative, all edges lie on one line with the inside on the same side, and the
/// sign of a determinant next to 0 decides whether the triangle covers one half of the screen, the
/// other half, or nothing.
void add_edge_on(Draw& draw, cases::Case& c);

}  // namespace rastercheck::properties
