/*
 * A shared library, but no plugin: the exported function has another name.
 *
 * RasterCheck: “does not export the function rastercheck_plugin_get()”
 */
#define rastercheck_plugin_get rastercheck_plugin_fetch
#include "../little.c"
