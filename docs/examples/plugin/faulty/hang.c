/*
 * Hangs where a triangle is wide.
 *
 * RasterCheck: “its process did not answer within 10 s (--timeout) while drawing”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  volatile bool is_waiting = is_wide(draw);
  while (is_waiting) {
  }
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
