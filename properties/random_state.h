#pragma once

// What generators share: the state around the triangles, and attributes and clip distances once the
// vertices stand. Positions are each generator's own business (internal/window_position.h).

#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

/// What a generator needs of the state.
struct StateRequest {
  /// Pixels of the framebuffer along a side; with more samples a pixel it gets smaller, so that a
  /// case has about as many fragments.
  int least_side = 8;
  int most_side = 64;
  /// Only viewports whose sizes are powers of two and whose origins are multiples of 1/16 pixel:
  /// window positions on a 2^-8 grid are then exact in clip space wherever w is a power of two.
  bool is_on_grid = false;
  /// 65…200 pixels wide and 4…12 high instead.
  bool is_wide = false;
  /// Clip distances per vertex, 0 in most cases.
  bool has_clip_distances = true;
};

/// A case without vertices: rules, framebuffer, viewport, culling, scissor, depth state, the
/// attributes' qualifiers, and in a quarter of the cases snapped coverage. `clip_distance_count` is
/// set, the distances are not.
cases::Case random_state(Draw& draw, const StateRequest& request = {});

/// Snaps vertices to a grid of 2^-4 pixels or finer; values come from either basis.
void set_snapped_coverage(Draw& draw, cases::Case& c);

/// Gives every vertex its attribute values: of each attribute of one kind, as constants, zeros,
/// small integers, huge or tiny or mixed numbers.
void add_attribute_values(Draw& draw, cases::Case& c);

/// Gives a case that has no attribute one, of value 0.
void ensure_attribute(cases::Case& c);
/// The same, of random values.
void ensure_attribute(Draw& draw, cases::Case& c);

/// Makes every three vertices in succession a triangle, from the first vertex on.
void add_separate_triangles(cases::Case& c);

/// Gives every vertex its clip distances: mostly inside, some outside, some exactly zero.
void add_clip_distances(Draw& draw, cases::Case& c);

/// The least z/w that is drawn under the case's rules; the greatest is 1.
inline float near_depth(const cases::Case& c) {
  return c.rules == cases::Rules::opengl ? -1.0F : 0.0F;
}

}  // namespace rastercheck::properties
