/*
 * A plugin whose drawing takes next to no time: it covers the samples above the diagonal, whatever
 * is asked. docs/examples/exec/c/little_exec.c makes it a program, for backend/exec/….
 */
#include <string.h>

#include "rastercheck/plugin.h"

static const rastercheck_contract contract = {.size = sizeof(rastercheck_contract)};

static uint32_t draw_all(const rastercheck_draw* draw, rastercheck_output* out) {
  for (size_t y = 0; y < draw->height; ++y) {
    const size_t begin = y * draw->width, count = y < draw->width ? draw->width - y : 0;
    const size_t attributes = draw->attribute_count;
    memset(out->coverage + begin, 1, count);
    memset(out->depth + begin, 0, count * sizeof(float));
    if (attributes > 0) {
      memset(out->attributes + begin * attributes, 0, count * attributes * sizeof(float));
    }
  }
  return RASTERCHECK_OK;
}

static const rastercheck_plugin plugin = {
    .size = sizeof(rastercheck_plugin),
    .abi = RASTERCHECK_PLUGIN_ABI,
    .name = "ready made",
    .version = "1.0",
    .contract = &contract,
    .draw = draw_all,
};

const rastercheck_plugin* rastercheck_plugin_get(void) { return &plugin; }
