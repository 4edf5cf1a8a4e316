// depth-borders: biased depths, and depths stored in unorm formats. Depths lie at the numbers k of
// a format, midway between two of them, or a float beside either; at the ends of the depth range
// and beyond; on planes that cross a step of the format every few pixels, or all steps within one.
// Biases may be too small to change a stored depth, of a few steps, or far beyond all depths, and
// their clamp cuts nothing, some or all of them.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::depth_borders_generator {
namespace {

/// 2^b − 1 of the case's format; of 16 or 24 bits if it is float32.
double format_steps(Draw& draw, const cases::Case& c) {
  const int bits = cases::unorm_bits(c.depth_format);
  const bool is_coarse = draw.one_in(2);
  return power_of_two(bits != 0 ? bits : (is_coarse ? 16 : 24)) - 1;
}

void set_range(Draw& draw, cases::Case& c) {
  switch (draw.between(0, 5)) {
    case 0: {  // any, also empty or reversed
      const float n = draw.unit();
      const float f = draw.unit();
      c.viewport.min_depth = n;
      c.viewport.max_depth = draw.one_in(16) ? n : f;
      break;
    }
    case 1:  // one that a bias leaves easily
      c.viewport.min_depth = 0.25F;
      c.viewport.max_depth = 0.75F;
      break;
    case 2:  // near 0, where floats are denser than the steps of any format
      c.viewport.min_depth = 0;
      c.viewport.max_depth = draw.one_in(2) ? 0x1p-8F : 0x1p-20F;
      break;
    default:
      c.viewport.min_depth = 0;
      c.viewport.max_depth = 1;
  }
  const bool is_reversed = draw.one_in(4);
  const bool is_d3d = c.rules == cases::Rules::d3d;
  if (is_d3d ? c.viewport.min_depth > c.viewport.max_depth : is_reversed) {
    std::swap(c.viewport.min_depth, c.viewport.max_depth);
  }
}

/// A depth within the range, that lies at a border of the format.
double border_depth(Draw& draw, const cases::Case& c, double steps) {
  const double lo = std::min(c.viewport.min_depth, c.viewport.max_depth);
  const double hi = std::max(c.viewport.min_depth, c.viewport.max_depth);
  const double share = double{draw.unit()};
  const double any = lo + share * (hi - lo);
  const double k = static_cast<double>(static_cast<std::int64_t>(any * steps));
  switch (draw.between(0, 7)) {
    case 0:
      return lo;
    case 1:
      return hi;
    case 2:  // 0.5 of 16 bits is 2^-17 from 32767 and 32768, exactly midway
      return lo <= 0.5 && hi >= 0.5 ? 0.5 : any;
    case 3:
      return any;
    case 4:
      return std::clamp(k / steps, lo, hi);
    default:
      return std::clamp((k + 0.5) / steps, lo, hi);
  }
}

/// z/w of a depth; sometimes a float beside it.
float share_of(Draw& draw, const cases::Case& c, double depth) {
  const double n{c.viewport.min_depth};
  const double f{c.viewport.max_depth};
  const double share = n == f ? 0.5 : (depth - n) / (f - n);
  const bool is_opengl = c.rules == cases::Rules::opengl;
  const float exact = to_float(is_opengl ? 2 * share - 1 : share);
  return draw.one_in(3) ? nudged(draw, exact) : exact;
}

/// How the depths of a triangle's vertices are related.
enum class Plane {
  level,   ///< all equal
  gentle,  ///< a step of the format every few pixels
  steep,   ///< from one end of the range to the other, within a pixel or some
  free,    ///< anywhere at borders
  beyond,  ///< partly outside the depth range, so that clipping or depth clamp cuts it
};

WindowPoint corner_point(Draw& draw, const cases::Case& c) {
  if (draw.one_in(3)) return visible_sample(draw, c);
  return point_about(draw, c);
}

std::array<cases::ClipVertex, 3> random_corners(Draw& draw, const cases::Case& c) {
  const Plane plane = draw.pick(std::array{Plane::level, Plane::level, Plane::gentle, Plane::gentle,
                                           Plane::steep, Plane::free, Plane::free, Plane::beyond});
  const double steps = format_steps(draw, c);
  const double first = border_depth(draw, c, steps);
  const float level = share_of(draw, c, first);
  const bool has_unit_weights = draw.one_in(2);
  const WindowPoint centre = visible_point(draw, c);
  std::array<cases::ClipVertex, 3> corners;
  for (cases::ClipVertex& corner : corners) {
    WindowPoint at = corner_point(draw, c);
    float depth = level;
    if (plane == Plane::gentle) {
      const int halves = draw.between(-8, 8);
      depth = share_of(draw, c, first + halves / 2.0 / steps);
    } else if (plane == Plane::steep) {
      depth = share_of(
          draw, c, draw.one_in(2) ? double{c.viewport.min_depth} : double{c.viewport.max_depth});
      const double aside = double{draw.uniform(-0.75F, 0.75F)};
      if (!draw.one_in(3)) at.u = centre.u + aside;
    } else if (plane == Plane::free) {
      depth = share_of(draw, c, border_depth(draw, c, steps));
    } else if (plane == Plane::beyond) {
      depth = draw.uniform(near_depth(c) - 1, 2);
    }
    // Products of powers of two leave depths at borders there, and others move them by a rounding.
    float w = draw.pick(std::array{1.0F, 1.0F, 0.5F, 4.0F});
    if (!has_unit_weights && draw.one_in(2)) w = draw.uniform(0.25F, 4);
    if (plane == Plane::beyond && draw.one_in(8)) w = draw.uniform(-1, 0);
    corner = at_window(c, at, depth, has_unit_weights ? 1.0F : w);
  }
  return corners;
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 24;
  request.is_on_grid = draw.one_in(2);
  cases::Case c = random_state(draw, request);
  set_range(draw, c);
  set_depth_storage(draw, c);
  c.depth_clamp = draw.one_in(6);
  const double steps = format_steps(draw, c);
  if (draw.one_in(3)) {
    c.depth_test = cases::DepthTest::less;
    const double clear = border_depth(draw, c, steps);
    if (draw.one_in(3)) c.depth_clear = to_float(std::clamp(clear, 0.0, 1.0));
  }
  const int triangles = draw.between(1, 2 + draw.size() / 50);
  for (int i = 0; i < triangles; ++i) {
    const auto corners = random_corners(draw, c);
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
  if (draw.one_in(3)) {  // the same triangle in another order, whose depths tie
    const cases::Triangle triangle = c.triangles.front();
    c.triangles.push_back({triangle[1], triangle[2], triangle[0]});
  }
  add_attribute_values(draw, c);
  if (c.clip_distance_count > 0) add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"depth-borders", "biased depths, and depths at the borders of what unorm formats store", &make,
     false});

}  // namespace
}  // namespace rastercheck::properties::depth_borders_generator
