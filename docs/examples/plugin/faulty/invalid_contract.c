/* Promises a grid of 2^-99 pixels. */
#include "faulty.h"

const rastercheck_plugin* rastercheck_plugin_get(void) {
  static rastercheck_contract invalid;
  invalid = contract;
  invalid.subpixel_bits = 99;
  return little_with_contract(&invalid);
}
