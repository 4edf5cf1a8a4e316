#pragma once

// Shared by generators: makes a case's state and, after the generator has placed the vertices
// (window_position.h), their attributes and clip distances.

#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

/// A generator's requirements on the state.
struct StateRequest {
  /// Pixels along a side of the framebuffer, which shrinks with more samples per pixel to keep the
  /// number of fragments about equal.
  int least_side = 8;
  int most_side = 64;
  /// If set, viewport origins are multiples of 1/16 pixel and sides are powers of two, unless
  /// clamping to `least_side` or `most_side` changes a side. If the sides and w are powers of two,
  /// window positions on a 2^-8 grid are exact in clip space.
  bool is_on_grid = false;
  /// If set, the framebuffer is 65…200 pixels wide and 4…12 high instead.
  bool is_wide = false;
  /// False if vertices must not have clip distances. Most cases have none anyway.
  bool has_clip_distances = true;
};

/// A case without vertices: rules, framebuffer, viewport, culling, scissor, depth state, the
/// attributes' qualifiers, and in a quarter of the cases snapped coverage. Sets
/// `clip_distance_count` but no distances.
cases::Case random_state(Draw& draw, const StateRequest& request = {});

/// Makes the case snap vertices to a grid of 2^-4 pixels or finer, with values from either basis.
void set_snapped_coverage(Draw& draw, cases::Case& c);

/// Sets a depth format and, mostly, a bias: constant and slope of any size and sign, and sometimes
/// a clamp. random_state() leaves both out.
void set_depth_storage(Draw& draw, cases::Case& c);

/// Gives every vertex its attribute values. Each attribute has one kind of values: constants,
/// zeros, small integers, or huge, tiny or mixed numbers.
void add_attribute_values(Draw& draw, cases::Case& c);

/// Adds an attribute of value 0 if the case has none.
void ensure_attribute(cases::Case& c);
/// Adds an attribute of random values if the case has none.
void ensure_attribute(Draw& draw, cases::Case& c);

/// Makes a triangle from every three consecutive vertices, starting at the first.
void add_separate_triangles(cases::Case& c);

/// Gives every vertex its clip distances: mostly inside, some outside, some exactly zero.
void add_clip_distances(Draw& draw, cases::Case& c);

/// The least z/w inside the clip volume under the case's rules; the greatest is 1.
inline float near_depth(const cases::Case& c) {
  return c.rules == cases::Rules::opengl ? -1.0F : 0.0F;
}

}  // namespace rastercheck::properties
