/*
 * Loses 4 KiB in every draw.
 *
 * RasterCheck: “it leaks memory: each time this case is drawn again, memory use grows”
 */
#include <stdlib.h>

#include "faulty.h"

static char* volatile work; /* of the last draw: those before are lost */

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  work = malloc(4096);
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
