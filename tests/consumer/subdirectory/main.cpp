#include "rasterizer/rasterizer.h"

int main() {
  rastercheck::rasterizer::Picture frame;
  const double side = 8.5;
  const int pixels = side;  // a conversion that -Wconversion refuses
  return clear(frame, {pixels, pixels, 1}, 1, 1) ? 1 : 0;
}
