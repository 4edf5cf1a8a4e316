/*
 * Prints a sentence, and ends itself where a triangle is wide.
 *
 * RasterCheck: “its process was killed by signal Aborted while drawing; its last output:
 * assertion failed: the triangle is narrow”
 */
#include <stdio.h>
#include <stdlib.h>

#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  if (is_wide(draw)) {
    printf("assertion failed: the triangle is narrow");
    abort();
  }
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
