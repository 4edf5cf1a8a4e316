/*
 * Writes one sample too many.
 *
 * RasterCheck: “the plugin touched output->coverage beyond its end, by 1 byte”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  const uint32_t result = draw_all(draw, out);
  out->coverage[sample_count(draw)] = 1;
  return result;
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
