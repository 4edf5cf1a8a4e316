/*
 * Promises a grid of 2^-99 pixels.
 *
 * RasterCheck: “its contract's subpixel_bits is 99, but must be from 0 to 16”
 */
#include "faulty.h"

const rastercheck_plugin* rastercheck_plugin_get(void) {
  static rastercheck_contract invalid;
  invalid = contract;
  invalid.subpixel_bits = 99;
  return little_with_contract(&invalid);
}
