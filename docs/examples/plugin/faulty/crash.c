/*
 * Crashes: reads address 0 where a triangle is wide.
 *
 * RasterCheck: “its process was killed by signal Segmentation fault while drawing; its last
 * output: the plugin touched address 0x0, which is in none of its arrays”
 */
#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  const int* volatile nowhere = NULL;
  if (is_wide(draw)) return (uint32_t)*nowhere;
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
