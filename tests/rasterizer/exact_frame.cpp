#include "tests/rasterizer/exact_frame.h"

#include "rasterizer/internal/determinant.h"

namespace rastercheck::rasterizer {

FramedDraw random_framed_draw(Random& random) {
  FramedDraw framed;
  while (framed.orientation == 0 || framed.bounds.columns.empty() || framed.bounds.rows.empty() ||
         framed.state.viewport.size.x == 0 || framed.state.viewport.size.y == 0) {
    RandomDraw draw = random_draw(random);
    if (random.one_in(3)) {
      draw.size.width = random.pick({kMaxSize, 1'000});
      draw.size.height = random.pick({kMaxSize, 1'000});
      const auto kind = static_cast<ViewportKind>(random.between(0, 7));
      draw.state.viewport = random_viewport(random, kind, draw.size);
    }
    const auto& p = draw.mesh.positions;
    framed.state = draw.state;
    framed.mesh = draw.mesh;
    framed.samples = draw.size.samples;
    framed.bounds = draw_bounds(draw.state, draw.size);
    framed.frame = sample_frame(draw.state, framed.bounds, draw.size.samples);
    framed.corners = {p[0], p[1], p[2]};
    framed.orientation = determinant_sign(p[0], p[1], p[2]);
  }
  return framed;
}

}  // namespace rastercheck::rasterizer
