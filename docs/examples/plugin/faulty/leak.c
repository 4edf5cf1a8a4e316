/* Leaks 64 MiB in every draw. */
#include <stdlib.h>

#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  const size_t size = (size_t)64 << 20;
  char* memory = malloc(size);
  if (memory == NULL) abort(); /* as many programs do, for want of anything better */
  memset(memory, 1, size);
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
