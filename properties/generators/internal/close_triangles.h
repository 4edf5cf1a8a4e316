#pragma once

// Triangles that are decided by the last bits of floats: an edge through a sample or next to it, as
// thin as floats are close, in one plane with the eye or next to that. Viewports are those for
// which ray_through() is exact.

#include <array>
#include <span>

#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

using Corners = std::array<cases::ClipVertex, 3>;
using Distances = std::array<float, 3>;  ///< of each corner, where the case has clip distances

/// Adds a triangle with any of its vertices first, and its clip distances where the case has any.
void add_with_distances(Draw& draw, cases::Case& c, const Corners& corners,
                        const Distances& distances);

/// z of all corners on one plane, which no depth plane cuts where D is not close to 0.
void set_level_depths(Draw& draw, const cases::Case& c, Corners& corners);

/// The same exactly, where w has up to 23 bits.
void set_exact_depths(Draw& draw, Corners& corners);

/// Of powers of two, both included.
struct Exponents {
  int least = 0;
  int most = 0;
};
inline constexpr Exponents kTiny{-58, -18};

/// A tiny number in the place of a 0: a float's breadth there is less than any double shows beside
/// the others.
float tiny_float(Draw& draw);

/// One of the numbers moved by a float, a 0 become tiny, or none: then what was exact stays so.
void nudge_any(Draw& draw, std::span<float* const> numbers);

/// What a sample's homogeneous position is multiplied by before it is split: short, so that ends of
/// about the same size exist, or long.
double short_factor(Draw& draw);

/// A triangle with an edge through a sample or next to it. One end's coordinates may be tiny, so
/// that the edge's coefficients need more than 53 bits, and w may have either sign.
void add_close_edge(Draw& draw, cases::Case& c);

/// A triangle as thin as floats are close, with a sample strictly inside, of weights 1 : 1 : 1: two
/// corners appear at one point but for ±t, of such an exponent, in x or in y, and the third is what
/// they leave of the sample. The values there are means of the corners', which no double shows.
void add_needle(Draw& draw, cases::Case& c, const Exponents& thickness = kTiny);

/// Three corners in one plane with the eye: the third is m a + n b of small whole m and n. With
/// both negative, all the edges have the same line with the inside on one side of it, and the sign
/// of a determinant next to 0 says on which: half the screen or the other half, or nothing.
void add_edge_on(Draw& draw, cases::Case& c);

}  // namespace rastercheck::properties
