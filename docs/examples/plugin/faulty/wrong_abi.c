/*
 * Built for another version of the interface.
 *
 * RasterCheck: “it was compiled for plugin ABI 99, but this RasterCheck has ABI 1”
 */
#include "faulty.h"

const rastercheck_plugin* rastercheck_plugin_get(void) {
  static rastercheck_plugin other;
  other = *little_get();
  other.abi = 99;
  return &other;
}
