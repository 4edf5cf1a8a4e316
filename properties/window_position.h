#pragma once

// Computes clip positions from intended window positions, in pixels. All arithmetic is +, −, ×, /
// in double and one rounding to float32 (to_float()), so results are the same everywhere.

#include <array>
#include <cstdint>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "properties/draw.h"
#include "properties/float_numbers.h"

namespace rastercheck::properties {

struct WindowPoint {
  double u = 0;
  double v = 0;
};

/// Returns the clip position with weight `w` and z/w = `depth` that appears at `p` in the case's
/// viewport. `w` and the viewport's sizes must not be 0. The result is exact if w and the
/// viewport's sizes are powers of two and the numbers have few bits; coordinates are clamped to
/// finite floats.
cases::ClipVertex at_window(const cases::Case& c, const WindowPoint& p, float depth, float w);

/// The positions of a pixel's samples, in pixels from its corner of least window x and y. Exact
/// unless the contract names a sample position that is no double; then the nearest doubles, which
/// lie on the same side of every float32.
std::vector<WindowPoint> sample_points(const cases::Case& c, const cases::Contract& contract);

/// True if a vertex (w not 0) appears exactly at `p` in the case's viewport; decided without
/// rounding. The coordinates of `p` must have at most 29 bits, as those of samples do, so that
/// their products with a float32 are exact in double.
bool is_exactly_at(const cases::Case& c, const cases::ClipVertex& vertex, const WindowPoint& p);

/// The window position of a vertex, w not 0, in double.
WindowPoint window_point(const cases::Case& c, const cases::ClipVertex& vertex);

/// Appends a vertex and returns its index.
std::uint32_t add_vertex(cases::Case& c, const cases::ClipVertex& position);
/// Appends a vertex with the attributes and clip distances of vertex `like` and returns its index.
std::uint32_t add_vertex_like(cases::Case& c, std::uint32_t like, cases::ClipVertex position);
/// Appends three vertices and their triangle.
void add_triangle(cases::Case& c, const cases::ClipVertex& first, const cases::ClipVertex& second,
                  const cases::ClipVertex& third);

/// The middle of the part of the framebuffer that the viewport covers.
WindowPoint visible_middle(const cases::Case& c);
/// A random point in the part of the framebuffer that the viewport covers; in the whole framebuffer
/// if it covers none.
WindowPoint visible_point(Draw& draw, const cases::Case& c);
/// The exact position of a random sample in the same part as visible_point().
WindowPoint visible_sample(Draw& draw, const cases::Case& c);
/// The exact position of a random sample in the pixel that contains `p`, which must not be
/// negative.
WindowPoint sample_in_pixel(Draw& draw, const cases::Case& c, const WindowPoint& p);
/// A random point in the same part as visible_point(), extended by a quarter of its size on every
/// side.
WindowPoint point_about(Draw& draw, const cases::Case& c);

/// Makes two vertices with `p` exactly on the line through them. The weights differ and are not
/// powers of two, so a sample ties on the edge although no double holds the window coordinates of
/// either end. `p` must be a multiple of 1/16 pixel, and the viewport must be made with
/// StateRequest::is_on_grid.
std::array<cases::ClipVertex, 2> edge_through(Draw& draw, const cases::Case& c,
                                              const WindowPoint& p, float depth);

/// A random z/w that the depth planes do not clip.
float random_depth(Draw& draw, const cases::Case& c);

}  // namespace rastercheck::properties
