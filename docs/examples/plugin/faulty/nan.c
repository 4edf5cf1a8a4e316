/*
 * Divides 0 by 0 where a triangle is wide: all of its depths are no numbers.
 *
 * RasterCheck: “depth was drawn as NaN”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  const uint32_t result = draw_all(draw, out);
  for (size_t i = 0; is_wide(draw) && i < sample_count(draw); ++i) {
    if (out->coverage[i]) out->depth[i] = NAN;
  }
  return result;
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
