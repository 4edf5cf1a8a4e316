#pragma once

// From where a vertex is to appear to the clip position that puts it there. Window positions are in
// pixels; all arithmetic is +, −, ×, / in double and one rounding to float32 (to_float()), so that
// a position comes out the same everywhere.

#include <array>
#include <cstdint>

#include "cases/case.h"
#include "properties/draw.h"
#include "properties/float_numbers.h"

namespace rastercheck::properties {

struct WindowPoint {
  double u = 0;
  double v = 0;
};

/// The clip position of weight `w` (not 0) that appears at `p` in the case's viewport, whose sizes
/// are not 0, with z/w = `depth`. Exact where w and the viewport's sizes are powers of two and the
/// numbers short; beyond float32 it is held at the largest one.
cases::ClipVertex at_window(const cases::Case& c, const WindowPoint& p, float depth, float w);

/// Whether a vertex, w not 0, appears exactly at `p` in the case's viewport, without any rounding.
/// The coordinates of `p` have at most 29 bits, as all samples' have: times a float32 they are a
/// double.
bool is_exactly_at(const cases::Case& c, const cases::ClipVertex& vertex, const WindowPoint& p);

/// Appends a vertex and says its index.
std::uint32_t add_vertex(cases::Case& c, const cases::ClipVertex& position);
/// The same with the attributes and clip distances of another vertex.
std::uint32_t add_vertex_like(cases::Case& c, std::uint32_t like, cases::ClipVertex position);
/// Appends three vertices and a triangle of them.
void add_triangle(cases::Case& c, const cases::ClipVertex& first, const cases::ClipVertex& second,
                  const cases::ClipVertex& third);

/// The middle of the part of the framebuffer that the viewport covers.
WindowPoint visible_middle(const cases::Case& c);
/// A point of the part of the framebuffer that the viewport covers; of the whole framebuffer where
/// it covers none.
WindowPoint visible_point(Draw& draw, const cases::Case& c);
/// Exactly where a sample of such a pixel lies.
WindowPoint visible_sample(Draw& draw, const cases::Case& c);
/// Where one of the samples lies of the pixel that holds `p`, which is not negative.
WindowPoint sample_in_pixel(Draw& draw, const cases::Case& c, const WindowPoint& p);
/// A point of that part made larger by a quarter of its size on every side.
WindowPoint point_about(Draw& draw, const cases::Case& c);

/// Two vertices of different weights, no powers of two, between which exactly `p` lies: an edge on
/// which a sample ties although neither end has window coordinates that a double could hold. `p` is
/// a multiple of 1/16 pixel, the case's viewport one that StateRequest::is_on_grid gives.
std::array<cases::ClipVertex, 2> edge_through(Draw& draw, const cases::Case& c,
                                              const WindowPoint& p, float depth);

/// z/w of a vertex that the depth planes leave alone.
float random_depth(Draw& draw, const cases::Case& c);

}  // namespace rastercheck::properties
