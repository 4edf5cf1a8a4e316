#include "properties/primitive_state.h"

#include <array>

#include "properties/random_state.h"

namespace rastercheck::properties {

cases::Case random_primitive_state(Draw& draw, cases::Primitive primitive, bool is_on_grid) {
  StateRequest request;
  request.most_side = 32;
  request.is_on_grid = is_on_grid;
  cases::Case c = random_state(draw, request);
  c.cull = cases::Cull::none;
  c.primitive = primitive;
  return c;
}

void set_line_mode(Draw& draw, cases::Case& c) {
  using cases::LineMode;
  c.line_mode = cases::default_line_mode(c.rules, c.framebuffer.samples);
  if (draw.one_in(2)) {
    c.line_mode =
        draw.pick(std::array{LineMode::rectangular, LineMode::parallelogram, LineMode::bresenham});
  }
  switch (draw.between(0, 5)) {
    case 0: {
      const int eighths = draw.between(4, 80);
      c.line_width = static_cast<float>(eighths) / 8;
      break;
    }
    case 1: {
      const int width = draw.between(2, 10);
      c.line_width = static_cast<float>(width);
      break;
    }
    default:
      c.line_width = 1;
  }
}

void set_point_size(Draw& draw, cases::Case& c) {
  switch (draw.between(0, 3)) {
    case 0: {
      const int eighths = draw.between(4, 64);
      c.point_size = static_cast<float>(eighths) / 8;
      break;
    }
    case 1: {
      const int size = draw.between(2, 16);
      c.point_size = static_cast<float>(size);
      break;
    }
    default:
      c.point_size = 1;
  }
}

}  // namespace rastercheck::properties
