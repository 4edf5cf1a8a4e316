// points: of every size, anywhere in the window and a little beyond it, with sides on samples.

#include <array>

#include "properties/generator.h"
#include "properties/primitive_state.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::points_generator {
namespace {

void add_point(Draw& draw, cases::Case& c) {
  WindowPoint p;
  switch (draw.between(0, 2)) {
    case 0:
      p = point_about(draw, c);
      break;
    case 1:
      p = visible_sample(draw, c);
      break;
    default: {  // a multiple of an eighth of a pixel
      const int u = draw.between(-8, 8 * c.framebuffer.width + 8);
      const int v = draw.between(-8, 8 * c.framebuffer.height + 8);
      p = {u / 8.0, v / 8.0};
    }
  }
  const float depth = random_depth(draw, c);
  const float w = draw.one_in(2) ? 1.0F : draw.uniform(0.125F, 4);
  cases::ClipVertex vertex = at_window(c, p, depth, w);
  if (draw.one_in(16)) vertex.w = -vertex.w;
  if (draw.one_in(16)) vertex.z = draw.uniform(-3, 3);
  const std::uint32_t index = add_vertex(c, vertex);
  c.triangles.push_back({index, index, index});
}

cases::Case make(Draw& draw) {
  const bool is_on_grid = draw.one_in(2);
  cases::Case c = random_primitive_state(draw, cases::Primitive::points, is_on_grid);
  set_point_size(draw, c);
  const int points = draw.between(3, 6 + draw.size() / 10);
  for (int i = 0; i < points; ++i) add_point(draw, c);
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration({"points", "points of every size, dropped ones included",
                                           &make, false});

}  // namespace
}  // namespace rastercheck::properties::points_generator
