// any-floats: clip positions of raw floats, like arbitrary memory. Most positions are not chosen to
// appear in the window. Triangles still draw something: a corner lies on the screen or near it if
// x, y and w have similar magnitudes and w > 0, and some triangles have corners a few floats apart
// around a visible sample.

#include <array>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::any_floats_generator {
namespace {

using Corners = std::array<cases::ClipVertex, 3>;

float magnitude_of(float value) { return value < 0 ? -value : value; }

/// Makes corners of numbers with about the same exponent; one corner in eight is behind the eye. z
/// is positive and about as large as w or smaller, so that not everything is clipped.
Corners of_one_exponent(Draw& draw, int exponent) {
  Corners corners;
  for (cases::ClipVertex& p : corners) {
    const int least = exponent > -149 ? exponent - 1 : exponent;
    p.x = draw.spread(least, exponent);
    p.y = draw.spread(least, exponent);
    p.z = magnitude_of(draw.spread(least > -147 ? least - 2 : least, least));
    p.w = magnitude_of(draw.spread(least, exponent));
    if (draw.one_in(8)) p.w = -p.w;
  }
  return corners;
}

/// Makes corners of any finite floats. Half of the triangles have z = 0, which no depth plane clips
/// where w > 0.
Corners of_any_bits(Draw& draw) {
  const bool has_depth = draw.one_in(2);
  Corners corners;
  for (cases::ClipVertex& p : corners) {
    p.x = float_by_bits(draw);
    p.y = float_by_bits(draw);
    p.z = has_depth ? float_by_bits(draw) : 0.0F;
    p.w = float_by_bits(draw);
    if (!draw.one_in(4)) p.w = magnitude_of(p.w);
  }
  return corners;
}

/// Makes corners near one visible place. Each coordinate is off by a few floats, as if by rounding,
/// or by up to a quarter of its size.
Corners near_each_other(Draw& draw, const cases::Case& c, int exponent) {
  const WindowPoint place = visible_sample(draw, c);
  const float depth = random_depth(draw, c);
  const float w = magnitude_of(draw.spread(exponent, exponent));
  const cases::ClipVertex middle = at_window(c, place, depth, w);
  const bool is_close = draw.one_in(3);
  Corners corners;
  for (cases::ClipVertex& p : corners) {
    const int most = is_close ? 3 : 21;
    p.x = float_near(draw, middle.x, most);
    p.y = float_near(draw, middle.y, most);
    p.z = float_near(draw, middle.z, is_close ? most : 18);
    p.w = float_near(draw, middle.w, most);
  }
  return corners;
}

/// Replaces one coordinate of one corner by any float.
void put_odd_one(Draw& draw, Corners& corners) {
  const int corner = draw.between(0, 2);
  const int coordinate = draw.between(0, 3);
  cases::ClipVertex& p = corners[static_cast<std::size_t>(corner)];
  const std::array numbers{&p.x, &p.y, &p.z, &p.w};
  *numbers[static_cast<std::size_t>(coordinate)] = any_float(draw);
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 32;
  cases::Case c = random_state(draw, request);
  c.depth_clamp = draw.one_in(3);
  // Numbers up to 2^125, and down to where w is subnormal and a coordinate has few bits.
  const int exponent = draw.one_in(4) ? draw.between(-149, 125) : draw.between(-100, 100);
  const int triangles = draw.between(2, 4 + draw.size() / 20);
  for (int i = 0; i < triangles; ++i) {
    Corners corners;
    switch (draw.between(0, 3)) {
      case 0:
        corners = of_any_bits(draw);
        break;
      case 1:
        corners = near_each_other(draw, c, exponent);
        break;
      default:
        corners = of_one_exponent(draw, exponent);
    }
    if (draw.one_in(8)) put_odd_one(draw, corners);
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"any-floats",
     "clip positions of arbitrary finite floats, of one exponent or a few floats apart", &make});

}  // namespace
}  // namespace rastercheck::properties::any_floats_generator
