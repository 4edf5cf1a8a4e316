/*
 * Turns the vertices over in place before it draws, where a triangle is wide.
 *
 * RasterCheck: “the plugin wrote to draw->positions, which it may only read”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  float* positions = (float*)(uintptr_t)draw->positions;
  if (is_wide(draw)) positions[1] = -positions[1];
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
