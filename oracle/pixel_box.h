#pragma once

namespace rastercheck::oracle {

/// Pixels x0 <= x < x1, y0 <= y < y1 of a framebuffer; empty if x1 <= x0 or y1 <= y0.
struct PixelBox {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  bool holds(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

}  // namespace rastercheck::oracle
