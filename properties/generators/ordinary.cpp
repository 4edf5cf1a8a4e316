// ordinary: everyday drawing, with triangles mostly on screen, separate or in a strip, and w within
// [1/8, 8]: arbitrary, all equal, or powers of two. A failure here affects everybody.

#include <array>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::ordinary_generator {
namespace {

/// How the weights of a case's vertices are made.
enum class WeightSort { free, equal, powers_of_two };

float random_weight(Draw& draw, WeightSort kind, float equal) {
  switch (kind) {
    case WeightSort::equal:
      return equal;
    case WeightSort::powers_of_two:
      return draw.pick(std::array{0.125F, 0.25F, 0.5F, 1.0F, 2.0F, 4.0F, 8.0F});
    default:
      // Weights below 1 are as likely as weights above 1.
      return draw.one_in(2) ? draw.uniform(0.125F, 1) : draw.uniform(1, 8);
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.least_side = 24;
  cases::Case c = random_state(draw, request);
  const auto weights = draw.pick(
      std::array{WeightSort::free, WeightSort::free, WeightSort::equal, WeightSort::powers_of_two});
  const float equal = draw.pick(std::array{1.0F, 0.333F, 3.0F});
  const int triangles = draw.between(1, 1 + draw.size() / 30);
  const bool is_strip = draw.one_in(4);
  const int vertices = is_strip ? triangles + 2 : 3 * triangles;
  for (int i = 0; i < vertices; ++i) {
    const WindowPoint p = point_about(draw, c);
    const float depth = random_depth(draw, c);
    const float w = random_weight(draw, weights, equal);
    add_vertex(c, at_window(c, p, depth, w));
  }
  for (int i = 0; i < triangles; ++i) {
    const auto first = static_cast<std::uint32_t>(is_strip ? i : 3 * i);
    c.triangles.push_back({first, first + 1, first + 2});
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"ordinary", "one to four triangles mostly on screen, w within [1/8, 8]", &make});

}  // namespace
}  // namespace rastercheck::properties::ordinary_generator
