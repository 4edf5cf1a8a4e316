/*
 * Has no plugin to give.
 *
 * RasterCheck: “rastercheck_plugin_get() returned a null pointer”
 */
#include "faulty.h"

const rastercheck_plugin* rastercheck_plugin_get(void) { return NULL; }
