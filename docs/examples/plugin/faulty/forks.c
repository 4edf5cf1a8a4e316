/*
 * Starts a process that does not end, and crashes, where a triangle is wide.
 *
 * RasterCheck: “its process was killed by signal Aborted while drawing”
 */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <unistd.h>

#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  if (is_wide(draw)) {
    if (fork() == 0) {
      for (;;) pause();
    }
    abort();
  }
  return draw_all(draw, out);
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
