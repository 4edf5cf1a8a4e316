/*
 * Takes memory without end where a triangle is wide.
 *
 * RasterCheck: “its process was killed by signal Aborted while drawing”
 */
#include <stdlib.h>

#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  const size_t size = (size_t)1 << 30;
  while (is_wide(draw)) {
    if (malloc(size) == NULL) abort(); /* as many programs do, for want of anything better */
  }
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
