// constants: planes with the same weight, depth or attribute values everywhere, or with one vertex
// off by one float. Rasterizers have shortcuts for equal numbers, which must give the same values.

#include <array>
#include <cstddef>
#include <cstdint>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::constants_generator {
namespace {

/// Says which numbers are the same at all vertices of a triangle.
struct Equal {
  bool weight = false;
  bool depth = false;
};

/// A weight of at most 12 bits, so that its product with a short_depth() is exact.
float short_weight(Draw& draw) {
  const int units = draw.between(1, 4095);
  const int exponent = draw.between(-4, 4);
  float w = static_cast<float>(units) / 1024;
  for (int e = 0; e < exponent; ++e) w *= 2;
  for (int e = exponent; e < 0; ++e) w /= 2;
  return w;
}

/// A depth on or between the depth planes, of 11 bits.
float short_depth(Draw& draw, const cases::Case& c) {
  const int least = near_depth(c) < 0 ? -1024 : 0;
  const int units =
      draw.one_in(6) ? draw.pick(std::array{least, 0, 1024}) : draw.between(least, 1024);
  return static_cast<float>(units) / 1024;
}

/// Adds a strip of triangles whose vertices share the numbers that `equal` names.
void add_plane(Draw& draw, cases::Case& c, const Equal& equal) {
  const float weight = draw.one_in(2) ? short_weight(draw) : draw.uniform(0.01F, 8);
  const float depth = short_depth(draw, c);
  const int vertices = draw.between(3, 5);
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (int i = 0; i < vertices; ++i) {
    const float w = equal.weight ? weight : short_weight(draw);
    const WindowPoint p = point_about(draw, c);
    cases::ClipVertex vertex = at_window(c, p, 0, w);
    const float of_vertex = equal.depth ? depth : random_depth(draw, c);
    vertex.z = to_float(double{of_vertex} * double{w});
    add_vertex(c, vertex);
  }
  for (std::uint32_t i = first; i + 2 < first + static_cast<std::uint32_t>(vertices); ++i) {
    c.triangles.push_back({i, i + 1, i + 2});
  }
}

/// Moves w or z of one vertex by one float.
void nudge_one(Draw& draw, cases::Case& c) {
  const int vertex = draw.between(0, static_cast<int>(c.positions.size()) - 1);
  cases::ClipVertex& p = c.positions[static_cast<std::size_t>(vertex)];
  float& number = draw.one_in(2) ? p.w : p.z;
  number = stepped(number, draw.one_in(2) ? 1 : -1);
}

/// Gives most attributes the same value, of any magnitude, at all vertices. In some cases one
/// vertex is off by a float, or its zero has the other sign.
void set_constant_values(Draw& draw, cases::Case& c) {
  const std::size_t count = c.attributes.size();
  for (std::size_t a = 0; a < count; ++a) {
    if (draw.one_in(4)) continue;
    const float value = draw.one_in(2) ? any_float(draw) : draw.uniform(-1, 1);
    for (std::size_t v = 0; v < c.positions.size(); ++v) c.attribute_values[v * count + a] = value;
    if (!draw.one_in(4)) continue;
    const int vertex = draw.between(0, static_cast<int>(c.positions.size()) - 1);
    float& one = c.attribute_values[static_cast<std::size_t>(vertex) * count + a];
    one = one == 0 ? -one : stepped(one, draw.one_in(2) ? 1 : -1);
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.least_side = 16;
  request.most_side = 48;
  cases::Case c = random_state(draw, request);
  const int planes = draw.between(1, 2 + draw.size() / 50);
  for (int i = 0; i < planes; ++i) {
    const auto equal = draw.pick(
        std::array{Equal{true, true}, Equal{true, false}, Equal{false, true}, Equal{false, true}});
    add_plane(draw, c, equal);
  }
  if (draw.one_in(3)) nudge_one(draw, c);
  add_attribute_values(draw, c);
  set_constant_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"constants", "equal weights, equal depths, constant attributes, or one float away from that",
     &make});

}  // namespace
}  // namespace rastercheck::properties::constants_generator
