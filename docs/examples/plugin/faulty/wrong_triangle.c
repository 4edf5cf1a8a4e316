/*
 * Says of every sample that triangle 7 is seen there; there are not that many.
 *
 * RasterCheck: “draw() wrote 7 to output->triangle, which must be below 1”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  const uint32_t result = draw_all(draw, out);
  for (size_t i = 0; i < sample_count(draw); ++i) out->triangle[i] = 7;
  return result;
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
