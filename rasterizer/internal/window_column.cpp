#include "rasterizer/internal/window_column.h"

#include <cmath>

#include "rasterizer/internal/grid_position.h"

namespace rastercheck::rasterizer {

HalfPixels WindowColumn::near() const {
  ExactSum x = at[0];
  ExactSum y = at[1];
  ExactSum divisor = w;
  const double by = divisor.nearest();
  return {x.nearest() / by, y.nearest() / by};
}

WindowColumn window_column(const State& state, const glm::vec4& position) {
  const std::array<GridAxis, 2> axes = window_axes(state);
  WindowColumn column;
  add_window_numerator(column.at[0], axes[0], position.x, position.w, 1);
  add_window_numerator(column.at[1], axes[1], position.y, position.w, 1);
  column.w.add(position.w);
  return column;
}

WindowColumn snapped_column(const State& state, const glm::vec4& position) {
  const Grid grid = grid_of(state);
  const GridPoint point = snapped(grid, position);
  const double half_pixels = std::ldexp(2.0, -grid.unit_bits);
  WindowColumn column;
  column.at[0].add(static_cast<double>(point.x) * half_pixels);
  column.at[1].add(static_cast<double>(point.y) * half_pixels);
  column.w.add(1);
  return column;
}

}  // namespace rastercheck::rasterizer
