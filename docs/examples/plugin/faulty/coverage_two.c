/*
 * Counts how often a sample is drawn, where 1 is asked for.
 *
 * RasterCheck: “draw() wrote 2 to output->coverage, which must be 0 or 1”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  const uint32_t result = draw_all(draw, out);
  for (size_t i = 0; i < sample_count(draw); ++i) out->coverage[i] *= 2;
  return result;
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
