/*
 * Writes before the beginning of an array where a triangle is wide.
 *
 * RasterCheck: “draw() wrote before the beginning of output->coverage”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  volatile uint8_t* const coverage = out->coverage;
  if (is_wide(draw)) coverage[-1] = 1;
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
