/*
 * Says that all went well, and draws nothing.
 *
 * RasterCheck: “the sample is not drawn and must be”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  (void)draw;
  (void)out;
  return RASTERCHECK_OK;
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
