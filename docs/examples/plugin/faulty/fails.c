/*
 * Gives up where a triangle is wide, and says why.
 *
 * RasterCheck: “draw() reported failed: no room for so wide a triangle”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  if (!is_wide(draw)) return draw_all(draw, out);
  strncpy(out->message, "no room for so wide a triangle", out->message_size - 1);
  return RASTERCHECK_FAILED;
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
