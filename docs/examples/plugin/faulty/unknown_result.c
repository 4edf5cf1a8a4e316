/*
 * Returns something that draw() cannot return.
 *
 * RasterCheck: “draw() returned 99, which is not RASTERCHECK_OK”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  (void)draw_all(draw, out);
  return 99;
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
